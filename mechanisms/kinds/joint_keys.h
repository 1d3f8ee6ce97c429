// joint_keys.h — joints of a mechanism in a scene: journals, pins, guides and slides with their friction.
#pragma once

#include <memory>
#include <vector>

#include "engine/scene/fields.h"
#include "mechanisms/joints/reaction_table.h"

namespace kurbel {

// Joints of a slider-crank: main_bearing, crank_pin, slider_pin, guide; one table each, without friction by default.
struct SliderCrankJointKeys {
  struct Guide : RubbingJoint {
    OffThePin off;
  };
  RubbingJoint main_bearing, crank_pin, slider_pin;
  Guide guide;

  bool rub() const {
    return main_bearing.rubs(false) || crank_pin.rubs(false) || slider_pin.rubs(false) || guide.rubs(true);
  }
};
Fields<SliderCrankJointKeys> joint_fields();
MechanismJoints joints_of(const SliderCrankJointKeys& joints);
// Null if no joint has friction.
std::shared_ptr<const JointFrictionSource> friction_of(const MechanismData& data, const MechanismJoints& joints,
                                                       const std::vector<ActsWithin>& within = {});

// Joints of any other mechanism: tables by joint names, "crank_pin" or "crank pin"; for a linkage by the point of a pin or
// the sliding link.
const Tables<Reading<RubbingJoint>>& rubbing_tables();
// Empty, with messages, if a name is no joint or a value belongs to another type of joint.
MechanismJoints joints_of(const MechanismData& data, const std::vector<Reading<RubbingJoint>>& joints);

}  // namespace kurbel
