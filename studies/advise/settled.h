// settled.h — figures of the steady motion, for judging models: the greatest peak of a run is often that of its start
// and hides differences of the later motion.
#pragma once

#include <string>
#include <vector>

#include "studies/advise/deviation.h"
#include "studies/variants/variant_runs.h"

namespace kurbel {

// One period of the steady motion after the scene's own start (studies/steady): figures only, with their errors.
VariantRun settled(const Scene& scene, const Effects& effects, const Watch& watch);

// Speeds, δ, peaks and RMS of torques over the period, against the full model. `figures`: names or their beginnings,
// as in runs ("peak_torque" includes cycle_peak_torque); empty: all of these.
Deviation settled_deviation(const Result& full, const Result& lean, const std::vector<std::string>& figures,
                            double tolerance);

// Both combined: the greater change, and an error that bounds both.
Deviation worse_of(const Deviation& a, const Deviation& b);

}  // namespace kurbel
