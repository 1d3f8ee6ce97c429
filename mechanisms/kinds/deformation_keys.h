// deformation_keys.h — keys of clearance in a slider-crank's joints and of its rod's flexibility.
#pragma once

#include <optional>
#include <vector>

#include "engine/scene/keys.h"
#include "mechanisms/slider_crank/joint_contact.h"
#include "mechanisms/slider_crank/rod_flexibility.h"
#include "mechanisms/slider_crank/slider_crank_dynamics.h"

namespace kurbel {

std::vector<Key> slider_crank_deformation_keys();

// What of a slider-crank is not ideal.
struct Deformation {
  std::vector<JointClearance> clearances = {};
  std::optional<RodFlexibility> flexibility = {};
};
// What is wrong goes into the messages.
Deformation read_deformation(const Section& section, const SliderCrankData& data, Messages& messages);

}  // namespace kurbel
