// starter_claims.h — does the starter of a motor come to its last stage?
#pragma once

#include <vector>

#include "engine/events/equations.h"
#include "studies/claims/claim.h"

namespace kurbel {

// Of a steady motion: star-delta starters that wait for a speed, and rheostats that wait for a current, which it does not
// reach. `equations`: in the modes of (t, y); `mean_speed`: of the link [rad/s].
Claims starter_claims(Equations& equations, double t, const std::vector<double>& y, double mean_speed);

}  // namespace kurbel
