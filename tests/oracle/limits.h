// limits.h — limits that a scene states, and the greatest values that the samples of its run show.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/oracle/observed.h"

namespace kurbel::oracle {

// A list of {component, what, value, limit, unit}. `what`: "heat", "heat power" (per time), "tension", "reserve", "maximum
// torque", "shear stress", "rim speed", "rim stress", "rms torque". Greatest of the sampled points: no more than the truth.
nlohmann::json limits_of(const Observed& seen);

}  // namespace kurbel::oracle
