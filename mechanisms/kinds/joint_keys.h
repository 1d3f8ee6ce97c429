// joint_keys.h — joints of a mechanism in a scene: journals, pins, guides and slides with their friction.
#pragma once

#include <memory>
#include <vector>

#include "engine/scene/fields.h"
#include "mechanisms/joints/reaction_table.h"
#include "mechanisms/slider_crank/slider_crank_forces.h"

namespace kurbel {

// Of a slider-crank: main_bearing, crank_pin, slider_pin, guide: a table each, all without friction by default.
Fields<SliderCrankJoints> joint_fields();
// Null where none rubs.
std::shared_ptr<const JointFrictionSource> friction_of(const SliderCrankData& data, const SliderCrankJoints& joints);

// Of any other mechanism: tables by the joints' names, "crank_pin" or "crank pin"; of a linkage by the point of a pin and
// the link that slides.
const Tables<Reading<RubbingJoint>>& rubbing_tables();
// Null where none rubs, and with messages where a name is no joint's or a value belongs to another sort of joint.
std::shared_ptr<const JointFrictionSource> friction_of(const MechanismData& data,
                                                       const std::vector<Reading<RubbingJoint>>& joints,
                                                       std::vector<ActsWithin> within = {});

}  // namespace kurbel
