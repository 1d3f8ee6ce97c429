// flexible_kinds.cpp — couplings beyond spring and damper: progressive by a table, rubber that relaxes, universal
// joint.
#include <fmt/format.h>

#include <stdexcept>

#include "drivetrain/couplings/coupling_keys.h"
#include "drivetrain/couplings/kinds.h"
#include "drivetrain/couplings/progressive_coupling.h"
#include "drivetrain/couplings/rubber_coupling.h"
#include "drivetrain/couplings/universal_joint.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"
#include "engine/scene/effects.h"

namespace kurbel {

ConnectionForm rubber_under(const StaticRubberData& without_relaxation, const Effects& effects) {
  return effects.relaxation ? nullptr : connection_form(without_relaxation);
}
namespace {

std::array<int, 2> halves(const Section& s, Network& net) {
  const int in = net.add_node(s.name, "in", s.number("inertia_in"));
  const int out = net.add_node(s.name, "out", s.number("inertia_out"));
  net.ports[s.name] = {in, out, {}};
  return {in, out};
}

void build_progressive(const Section& s, Network& net, Messages& messages) {
  const auto [in, out] = halves(s, net);
  const CurveData& table = s["table"].curve;
  const Damping damping = damping_of(s, messages);
  if (table.period > 0)
    messages.add(s.where("table"), fmt::format("progressive coupling \"{}\": a table over the twist has no period; "
                                               "drop it",
                                               s.name));
  try {
    net.connect(in, out, 1, s.name, ProgressiveCouplingData{{table.x, table.y, table.form}, damping});
  } catch (const std::invalid_argument& error) {
    messages.add(s.where("table"), fmt::format("progressive coupling \"{}\": {}", s.name, error.what()));
  }
}

const std::vector<Kind>& branch_kinds() {
  static const std::vector<Kind> kinds = {{
      .name = "branch",
      .doc = "Maxwell branch: a spring in series with a damper",
      .placement = Placement::nested,
      .keys = {{.name = "stiffness",
                .unit = "N*m/rad",
                .domain = positive,
                .doc = "k_j, in fast motion on top of the static stiffness",
                .required = true},
               {.name = "relaxation_time",
                .unit = "s",
                .domain = positive,
                .doc = "T_j in which its torque falls to 1/e",
                .required = true}},
  }};
  return kinds;
}

constexpr int most_branches = 4;

template <int branches>
void connect_rubber(const Section& s, Network& net, int in, int out, const CouplingData& spring) {
  RubberCouplingData<branches> data{.spring = spring};
  const std::vector<Section>& given = s["branches"].sections;
  for (std::size_t j = 0; j < branches; ++j)
    data.branch[j] = {given[j].number("stiffness"), given[j].number("relaxation_time")};
  net.connect(in, out, 1, s.name, data);
}

void build_rubber(const Section& s, Network& net, Messages& messages) {
  const auto [in, out] = halves(s, net);
  const CouplingData spring{s.number("stiffness"), damping_of(s, messages)};
  if (!s.has("branches")) return net.connect(in, out, 1, s.name, spring);
  const std::vector<Section>& branches = s["branches"].sections;
  for (const Section& branch : branches)
    if (!branch.sound) return;
  switch (branches.size()) {
    case 1:
      return connect_rubber<1>(s, net, in, out, spring);
    case 2:
      return connect_rubber<2>(s, net, in, out, spring);
    case 3:
      return connect_rubber<3>(s, net, in, out, spring);
    case 4:
      return connect_rubber<most_branches>(s, net, in, out, spring);
    default:
      messages.add(s.where("branches"), fmt::format("rubber coupling \"{}\": {} branches; must be 1 … {}", s.name,
                                                    branches.size(), most_branches));
  }
}

void build_universal_joint(const Section& s, Network& net, Messages& messages) {
  const auto [in, out] = halves(s, net);
  net.connect(
      in, out, 1, s.name,
      UniversalJointData{{s.number("stiffness"), damping_of(s, messages)}, {s.number("angle")}, s.number("phase")});
}

Key stiffness_key(const char* doc) {
  return {.name = "stiffness", .unit = "N*m/rad", .domain = positive, .doc = doc, .required = true};
}

}  // namespace

std::vector<Kind> flexible_kinds() {
  return {
      {.name = "progressive coupling",
       .doc = "spring by a table of torque over twist, and damper; rigid when its elasticity is off",
       .placement = Placement::inline_two,
       .keys =
           joined({{.name = "table",
                    .type = KeyType::curve,
                    .unit = "N*m",
                    .doc = "torque over twist through [0, 0], rising; points of positive twist alone count for both "
                           "senses; beyond the last one it goes on straight",
                    .required = true,
                    .choices = {"twist"}}},
                  joined(joined(side_inertia_keys(), damping_keys()), coupling_limit_keys())),
       .build = build_progressive,
       .elastic = true},
      {.name = "rubber coupling",
       .doc = "static spring and damper, with Maxwell branches that relax; rigid when its elasticity is off",
       .placement = Placement::inline_two,
       .keys = joined({stiffness_key("static torsional stiffness k"),
                       {.name = "branches",
                        .type = KeyType::sections,
                        .doc = "1 … 4 Maxwell branches; with relaxation off their loss at ω_ref counts as viscous",
                        .nested = &branch_kinds(),
                        .effect = "relaxation"}},
                      joined(joined(side_inertia_keys(), damping_keys()), coupling_limit_keys())),
       .build = build_rubber,
       .elastic = true},
      {.name = "universal joint",
       .doc = "Hooke's joint at an angle, on an elastic shaft; when its elasticity is off its ratio is the mean, 1",
       .placement = Placement::inline_two,
       .keys = joined({stiffness_key("torsional stiffness k of the joint and its shaft"),
                       {.name = "angle",
                        .unit = "rad",
                        .domain = {.low = 0, .high = 1.4},
                        .doc = "angle β between the shafts, up to 80 deg",
                        .required = true},
                       {.name = "phase",
                        .unit = "rad",
                        .fallback = "\"0 deg\"",
                        .doc = "angle of the driving fork past its position in the plane of the shafts, at φ = 0"}},
                      joined(side_inertia_keys(), joined(damping_keys(), coupling_limit_keys()))),
       .build = build_universal_joint,
       .elastic = true},
  };
}

}  // namespace kurbel
