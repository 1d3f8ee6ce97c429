// deformation_keys.h — keys of clearance in a slider-crank's joints and of its rod's flexibility.
#pragma once

#include <optional>
#include <vector>

#include "engine/scene/fields.h"
#include "mechanisms/deforming/deforming_mechanism.h"

namespace kurbel {

struct DeformationKeys {
  std::vector<Reading<JointClearance>> clearances;
  std::optional<RodFlexibility> flexibility;
};
Fields<DeformationKeys> deformation_fields();

// Null: nothing deforms. Faults other than those of the slider-crank's data go into the messages.
std::shared_ptr<const DeformingParts> deforming_parts(const DeformationKeys& keys, const SliderCrankData& data,
                                                      const Section& section, Messages& messages);

}  // namespace kurbel
