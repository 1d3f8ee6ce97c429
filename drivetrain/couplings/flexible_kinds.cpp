// flexible_kinds.cpp — couplings beyond spring and damper: progressive by a table, rubber that relaxes, universal
// joint.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "drivetrain/couplings/coupling_keys.h"
#include "drivetrain/couplings/progressive_coupling.h"
#include "drivetrain/couplings/rubber_coupling.h"
#include "drivetrain/couplings/universal_joint.h"
#include "drivetrain/shared/kinds.h"
#include "engine/model/network.h"
#include "engine/scene/effects.h"

namespace kurbel {

ConnectionForm rubber_under(const StaticRubberData& without_relaxation, const Effects& effects) {
  return effects.relaxation ? nullptr : connection_form(without_relaxation);
}
namespace {

Key stiffness_key(const char* doc) { return required("stiffness", "N*m/rad", positive, doc); }

// --- progressive coupling ---

struct ProgressiveKeys {
  CurveData table;  // torque over twist [N·m, rad]
  SideInertias inertia;
  Damping damping;
  CouplingLimits limits;
};

Fields<ProgressiveKeys> progressive_fields() {
  using Keys = ProgressiveKeys;
  return Fields<Keys>()
      .add(required_curve("table", {"twist"}, "N*m",
                          "torque over twist through [0, 0], rising; points of positive twist alone count for both "
                          "senses; beyond the last one it goes on straight"),
           &Keys::table)
      .add(side_inertia_fields(), &Keys::inertia)
      .add(damping_fields(), &Keys::damping)
      .add(coupling_limit_fields(), &Keys::limits);
}

void build_progressive(const Section& s, const Reading<ProgressiveKeys>& coupling, Network& net) {
  const auto [in, out] = two_shafts(s, coupling.inertia, net);
  net.data.add(s.name, coupling.limits);
  const CurveData& table = coupling.table;
  if (table.period > 0) coupling.refuse(&ProgressiveKeys::table, "a table over the twist has no period; drop it");
  if (table.beyond == Beyond::hold)
    coupling.refuse(&ProgressiveKeys::table, "beyond = \"hold\" makes no spring, whose torque rises; give \"line\"");
  try {
    net.limit({.component = s.name,
               .of = "table",
               .over = Network::DataRange::Over::channel,
               .node = in,
               .channel = "twist." + s.name,
               .unit = "rad"},
              table.curve(), table.x.front() >= 0);
    net.connect(in, out, 1, s.name,
                ProgressiveCouplingData{table.by_formula.empty() ? ProgressiveCoupling(table.x, table.y, table.form)
                                                                 : ProgressiveCoupling(table.by_formula),
                                        coupling.damping});
  } catch (const std::invalid_argument& error) {
    coupling.refuse(&ProgressiveKeys::table, error.what());
  }
}

// --- rubber coupling ---

constexpr int most_branches = 4;

struct RubberKeys : CouplingData {
  std::vector<MaxwellBranch> branches;
  SideInertias inertia;
  CouplingLimits limits;
};

const Tables<MaxwellBranch>& branches() {
  static const auto made = Tables<MaxwellBranch>().add(
      "branch", "Maxwell branch: a spring in series with a damper",
      Fields<MaxwellBranch>()
          .add(required("stiffness", "N*m/rad", positive, "k_j, in fast motion on top of the static stiffness"),
               &MaxwellBranch::stiffness)
          .add(required("relaxation_time", "s", positive, "T_j in which its torque falls to 1/e"),
               &MaxwellBranch::relaxation_time));
  return made;
}

Fields<RubberKeys> rubber_fields() {
  using Keys = RubberKeys;
  return Fields<Keys>()
      .add(stiffness_key("static torsional stiffness k"), &Keys::stiffness)
      .add({.name = "branches",
            .doc = "1 … 4 Maxwell branches; with relaxation off their loss at ω_ref counts as viscous",
            .effect = "relaxation"},
           &Keys::branches, branches())
      .add(side_inertia_fields(), &Keys::inertia)
      .add(damping_fields(), &Keys::damping)
      .add(coupling_limit_fields(), &Keys::limits);
}

template <int branches>
void connect_rubber(const std::string& name, Network& net, int in, int out, const RubberKeys& coupling) {
  RubberCouplingData<branches> data{.spring = coupling};
  std::copy_n(coupling.branches.begin(), branches, data.branch.begin());
  net.connect(in, out, 1, name, data);
}

void build_rubber(const Section& s, const Reading<RubberKeys>& coupling, Network& net) {
  const auto [in, out] = two_shafts(s, coupling.inertia, net);
  net.data.add(s.name, coupling.limits);
  if (!coupling.given(&RubberKeys::branches))
    return net.connect(in, out, 1, s.name, static_cast<const CouplingData&>(coupling));
  switch (coupling.branches.size()) {
    case 1:
      return connect_rubber<1>(s.name, net, in, out, coupling);
    case 2:
      return connect_rubber<2>(s.name, net, in, out, coupling);
    case 3:
      return connect_rubber<3>(s.name, net, in, out, coupling);
    case 4:
      return connect_rubber<most_branches>(s.name, net, in, out, coupling);
    default:
      coupling.refuse(&RubberKeys::branches,
                      fmt::format("{} branches; must be 1 … {}", coupling.branches.size(), most_branches));
  }
}

// --- universal joint ---

struct UniversalJointKeys : CouplingData, HookeJoint {
  double phase = 0;  // [rad]
  SideInertias inertia;
  CouplingLimits limits;
};

Fields<UniversalJointKeys> universal_joint_fields() {
  using Keys = UniversalJointKeys;
  return Fields<Keys>()
      .add(stiffness_key("torsional stiffness k of the joint and its shaft"), &Keys::stiffness)
      .add(required("angle", "rad", {.low = 0, .high = 1.4}, "angle β between the shafts, up to 80 deg"), &Keys::angle)
      .add(defaulted("phase", "rad", "0 deg", any_number,
                     "angle of the driving fork past its position in the plane of the shafts, at φ = 0"),
           &Keys::phase)
      .add(side_inertia_fields(), &Keys::inertia)
      .add(damping_fields(), &Keys::damping)
      .add(coupling_limit_fields(), &Keys::limits);
}

void build_universal_joint(const Section& s, const Reading<UniversalJointKeys>& coupling, Network& net) {
  const auto [in, out] = two_shafts(s, coupling.inertia, net);
  net.data.add(s.name, coupling.limits);
  net.connect(in, out, 1, s.name, UniversalJointData{coupling, coupling, coupling.phase});
}

}  // namespace

std::vector<Kind> flexible_kinds() {
  return {
      kind_of<progressive_fields, build_progressive>(
          elastic_between_shafts, "progressive coupling",
          "spring by a table of torque over twist, and damper; rigid when its elasticity is off"),
      kind_of<rubber_fields, build_rubber>(
          elastic_between_shafts, "rubber coupling",
          "static spring and damper, with Maxwell branches that relax; rigid when its elasticity is off"),
      kind_of<universal_joint_fields, build_universal_joint>(
          elastic_between_shafts, "universal joint",
          "Hooke's joint at an angle, on an elastic shaft; when its elasticity is off its ratio is the mean, 1"),
  };
}

}  // namespace kurbel
