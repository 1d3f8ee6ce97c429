// deformation_keys.h — keys of clearance in a slider-crank's joints and of its rod's flexibility.
#pragma once

#include <optional>
#include <vector>

#include "engine/scene/fields.h"
#include "mechanisms/slider_crank/joint_contact.h"
#include "mechanisms/slider_crank/rod_flexibility.h"
#include "mechanisms/slider_crank/slider_crank_dynamics.h"

namespace kurbel {

// Clearances and flexibility of a slider-crank.
struct Deformation {
  std::vector<JointClearance> clearances = {};
  std::optional<RodFlexibility> flexibility = {};
};
struct DeformationKeys {
  std::vector<Reading<JointClearance>> clearances;
  std::optional<RodFlexibility> flexibility;
};
Fields<DeformationKeys> deformation_fields();

// Faults other than those of the slider-crank's data go into the messages.
Deformation deformation_of(const DeformationKeys& keys, const SliderCrankData& data, const Section& section,
                           Messages& messages);

}  // namespace kurbel
