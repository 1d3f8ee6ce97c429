// settled.h — figures of the motion that a machine keeps, for models to be judged by: a run's greatest peak is often
// that of its start, and hides what differs afterwards.
#pragma once

#include <string>
#include <vector>

#include "studies/advise/deviation.h"
#include "studies/variants/variant_runs.h"

namespace kurbel {

// One round of the motion that the scene's own start leads to (studies/steady): figures alone, with their errors.
VariantRun settled(const Scene& scene, const Effects& effects, const Watch& watch);

// Speeds, δ, peaks and RMS of torques over the round, against the fullest model's. `figures`: names or their beginnings,
// as runs call them ("peak_torque" is cycle_peak_torque as well); empty: all of those.
Deviation settled_deviation(const Result& full, const Result& lean, const std::vector<std::string>& figures,
                            double tolerance);

// Both together: the greater change, and an error that bounds them both.
Deviation worse_of(const Deviation& a, const Deviation& b);

}  // namespace kurbel
