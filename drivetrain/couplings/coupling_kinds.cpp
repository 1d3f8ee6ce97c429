// coupling_kinds.cpp — what joins two shafts elastically: coupling and shaft.
#include "drivetrain/couplings/coupling_keys.h"
#include "drivetrain/couplings/kinds.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "drivetrain/couplings/backlash.h"
#include "drivetrain/couplings/coupling.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

std::vector<Key> backlash_keys() {
  return {{.name = "backlash",
           .unit = "rad",
           .domain = not_negative,
           .doc = "whole gap b between the flanks",
           .effect = "backlash"},
          {.name = "contact",
           .type = KeyType::text,
           .fallback = "\"no pulling\"",
           .doc = "law of contact of the flanks (backlash.h)",
           .choices = {"no pulling", "Hunt-Crossley", "clipped"}},
          {.name = "contact_exponent",
           .fallback = "1.5",
           .domain = {.low = 1, .high = 3},
           .doc = "n of Hunt–Crossley; the stiffness then counts per rad^n"},
          {.name = "contact_damping", .unit = "s/rad", .domain = not_negative, .doc = "d of Hunt–Crossley"}};
}

BacklashData backlash_of(const Section& s, Messages& messages) {
  BacklashData data;
  data.contact.stiffness = s.number("stiffness");
  data.contact.gap = s.number("backlash");
  data.given = damping_of(s, messages);
  const std::string& law = s.text("contact");
  const bool hunt = law == "Hunt-Crossley";
  data.contact.law = hunt ? ContactLaw::hunt_crossley : law == "clipped" ? ContactLaw::clipped : ContactLaw::no_pulling;
  if (hunt) {
    data.contact.exponent = s.number("contact_exponent");
    data.contact.damping = s.number_or("contact_damping", 0);
    for (const char* key : {"damping", "damping_ratio", "relative_damping", "loss_factor"})
      if (s.given(key))
        messages.add(s.where(key), fmt::format("coupling \"{}\": \"{}\" does not apply to Hunt–Crossley contact; give "
                                               "contact_damping",
                                               s.name, key));
  } else {
    for (const char* key : {"contact_damping", "contact_exponent"})
      if (s.given(key))
        messages.add(
            s.where(key),
            fmt::format("coupling \"{}\": \"{}\" belongs to contact = \"Hunt-Crossley\"; drop it", s.name, key));
  }
  return data;
}

void build_coupling(const Section& s, Network& net, Messages& messages) {
  const int in = net.add_node(s.name, "in", s.number("inertia_in"));
  const int out = net.add_node(s.name, "out", s.number("inertia_out"));
  net.ports[s.name] = {in, out};
  if (s.given("backlash"))
    net.connect(in, out, 1, s.name, backlash_of(s, messages));
  else
    net.connect(in, out, 1, s.name, CouplingData{s.number("stiffness"), damping_of(s, messages)});
}

// k = G J_p/L, J = ρ J_p L, J_p = π (D⁴ − d⁴)/32; cut into n equal springs with the inertia between and at the ends.
void build_shaft(const Section& s, Network& net, Messages& messages) {
  const auto refuse = [&](const char* key, const std::string& text) {
    messages.add(s.where(key), fmt::format("shaft \"{}\": {}", s.name, text));
  };
  double stiffness = s.number_or("stiffness", 0), inertia = s.number_or("inertia", 0);
  if (s.given("stiffness") == s.given("length"))
    return refuse("stiffness", s.given("length") ? "\"stiffness\" and \"length\" both given; keep one"
                                                 : "\"stiffness\" is missing; give it, or \"length\" and \"diameter\"");
  if (s.given("stiffness"))
    for (const char* key : {"diameter", "bore"})
      if (s.given(key))
        return refuse(key, fmt::format("\"{}\" belongs to \"length\", which is not given; drop it", key));
  if (s.given("allowable_shear_stress") && !s.given("diameter"))
    return refuse("allowable_shear_stress",
                  "\"allowable_shear_stress\" needs \"diameter\"; give the shaft by \"length\" and \"diameter\"");
  if (s.given("length")) {
    if (!s.given("diameter")) return refuse("length", "\"diameter\" is missing beside \"length\"");
    const double length = s.number("length"), outer = s.number("diameter"), bore = s.number("bore");
    if (bore >= outer)
      return refuse("bore", fmt::format("bore = {:g} mm; must be < diameter = {:g} mm", bore * 1e3, outer * 1e3));
    const double polar = std::numbers::pi / 32 * (std::pow(outer, 4) - std::pow(bore, 4));
    stiffness = s.number("shear_modulus") * polar / length;
    if (!s.given("inertia")) inertia = s.number("density") * polar * length;
  }
  const int segments = static_cast<int>(s.number("segments"));
  const Damping damping = damping_of(s, messages);
  // Springs and dampers in series: n of them, each n times as stiff and as damped.
  int before = net.add_node(s.name, "in", inertia / (2 * segments));
  net.ports[s.name].in = before;
  for (int i = 1; i <= segments; ++i) {
    const bool last = i == segments;
    const int node = net.add_node(s.name, last ? "out" : fmt::format("{}", i), inertia / segments * (last ? 0.5 : 1));
    Damping part = damping;
    if (part.as == Damping::As::viscous) part.value *= segments;
    net.connect(before, node, 1, s.name, CouplingData{stiffness * segments, part});
    before = node;
  }
  net.ports[s.name].out = before;
}

}  // namespace

std::vector<Kind> coupling_kinds() {
  return {
      {.name = "coupling",
       .doc = "spring and damper between two half inertias; rigid when its elasticity is off",
       .placement = Placement::inline_two,
       .keys =
           joined({{.name = "stiffness",
                    .unit = "N*m/rad",
                    .domain = positive,
                    .doc = "torsional stiffness k",
                    .required = true}},
                  joined(joined(side_inertia_keys(), damping_keys()), joined(backlash_keys(), coupling_limit_keys()))),
       .build = build_coupling,
       .elastic = true},
      {.name = "shaft",
       .doc = "elastic shaft by stiffness, or by length, diameters and material",
       .placement = Placement::inline_two,
       .keys = joined(
           {{.name = "stiffness",
             .unit = "N*m/rad",
             .domain = positive,
             .doc = "torsional stiffness k of the whole shaft"},
            {.name = "length", .unit = "m", .domain = positive, .doc = "length, in place of the stiffness"},
            {.name = "diameter", .unit = "m", .domain = positive, .doc = "outer diameter"},
            {.name = "bore", .unit = "m", .fallback = "\"0 m\"", .domain = not_negative, .doc = "inner diameter"},
            {.name = "shear_modulus",
             .unit = "Pa",
             .fallback = "\"79.3 GPa\"",
             .domain = positive,
             .doc = "G; steel unless given"},
            {.name = "density",
             .unit = "kg/m3",
             .fallback = "\"7850 kg/m3\"",
             .domain = positive,
             .doc = "ρ; steel unless given"},
            {.name = "inertia",
             .unit = "kg*m2",
             .domain = not_negative,
             .doc = "of the whole shaft; default: from its dimensions, else 0"},
            {.name = "segments",
             .type = KeyType::integer,
             .fallback = "1",
             .domain = {.low = 1, .high = 100000},
             .doc = "number of equal springs that it is cut into"},
            {.name = "allowable_shear_stress",
             .unit = "Pa",
             .domain = positive,
             .doc = "limit for kurbel modes; needs the diameter"}},
           joined(damping_keys(), {application_factor_key()})),
       .build = build_shaft,
       .elastic = true},
  };
}

}  // namespace kurbel
