// drive_limits.cpp — limits as couplings and shafts state them.
#include "studies/limits/drive_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "drivetrain/couplings/coupling_keys.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

DriveLimits stated_limits(const ComponentData& data, const std::string& component) {
  if (const auto* given = data.find<CouplingLimits>(component)) return {*given};
  const auto* shaft = data.find<ShaftKeys>(component);
  if (!shaft) return {};
  DriveLimits limits{{.application_factor = shaft->application_factor}};
  if (!shaft->judges_stress()) return limits;
  limits.shear_stress = shaft->allowable_shear_stress.value_or(0);
  limits.polar_modulus = shaft->polar_modulus(), limits.diameter = *shaft->diameter;
  limits.shaft = shaft->rating;
  return limits;
}

}  // namespace

std::vector<LimitedJoint> limited_joints(const Model& model) {
  const std::vector<std::string> names = model.joint_names();
  std::vector<LimitedJoint> joints;
  for (const ElasticJoint& e : model.elastic) {
    const Network::Joint& joint = model.network.joints[at(e.joint)];
    LimitedJoint one{.name = names[joints.size()], .component = joint.component, .joint = e.joint};
    for (const TorqueJoint& known : model.torque_joints)
      if (known.joint == e.joint) one.told = known.told;
    one.stands = model.node_ratio[at(joint.a)] == 0;
    one.rated = model.torque_scale / model.scale_ratio[at(joint.a)];
    one.turns = std::abs(model.node_ratio[at(joint.a)]);
    one.loss_account = e.loss_account;
    const bool beside = joint.element->row && one.name != one.component;  // a continuous shaft is judged in its middle
    if (!beside) {
      one.limits = stated_limits(model.network.data, joint.component);
      one.has_play = model.network.data.find<StatedPlay>(joint.component) != nullptr;
    }
    joints.push_back(std::move(one));
  }
  return joints;
}

std::vector<LimitedJoint> joints_of(const Model& other, const std::vector<LimitedJoint>& joints) {
  const std::vector<LimitedJoint> known = limited_joints(other);
  std::vector<LimitedJoint> found;
  for (const LimitedJoint& joint : joints) {
    const auto same =
        std::find_if(known.begin(), known.end(), [&](const LimitedJoint& k) { return k.name == joint.name; });
    if (same == known.end())
      throw std::logic_error(fmt::format("\"{}\" is elastic with some effects, and with others not", joint.name));
    found.push_back(*same);
  }
  return found;
}

bool any_limits(const std::vector<LimitedJoint>& joints) {
  return std::any_of(joints.begin(), joints.end(), [](const LimitedJoint& j) { return j.limits.any(); });
}

}  // namespace kurbel
