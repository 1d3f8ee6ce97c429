// steady_ratings.h — does the machine bear its steady motion? Ratings of components against the cycle's own figures.
#pragma once

#include <vector>

#include "studies/limits/verdicts.h"
#include "studies/steady/steady.h"

namespace kurbel {

// Belts, shafts, rims and motors in continuous or intermittent duty, by the cycle's largest and RMS torques and largest
// speeds. Heat of engagements and short-time duty are of a run: `kurbel run` judges them. Empty: nothing is rated, or no
// cycle was found.
std::vector<Verdict> steady_ratings(const SteadyCycle& cycle);

}  // namespace kurbel
