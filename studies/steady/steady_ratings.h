// steady_ratings.h — assesses the steady motion: ratings of components against the cycle's own figures.
#pragma once

#include <vector>

#include "studies/limits/verdicts.h"
#include "studies/steady/steady.h"

namespace kurbel {

// Belts, shafts, rims and motors in continuous or intermittent duty, by the cycle's largest and RMS torques and
// largest speeds. Heat of engagements and short-time duty need a run: `kurbel run` assesses them. Empty: no ratings,
// or no cycle was found.
std::vector<Verdict> steady_ratings(const SteadyCycle& cycle);

}  // namespace kurbel
