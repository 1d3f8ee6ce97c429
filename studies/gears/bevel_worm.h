// bevel_worm.h — findings of `kurbel gears` for a bevel or a worm pair.
#pragma once

#include <optional>

#include "drivetrain/gears/bevel_worm.h"
#include "studies/findings/output.h"

namespace kurbel {

// Both throw std::invalid_argument with the reason.
Findings findings_of(const BevelPair& pair);
Findings findings_of(const WormPair& pair, std::optional<double> worm_speed = {});  // [rad/s]

}  // namespace kurbel
