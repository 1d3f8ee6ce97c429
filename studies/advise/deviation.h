// deviation.h — whether the figures of a reduced model stay within a tolerance of those of the full model, in a run
// and in the steady motion.
//
// For every figure the change d (of the model) and its error e (of the two runs) are assessed separately, at tolerance τ:
//     within      d + e ≤ τ
//     not judged  e > τ and d − e ≤ τ: runs of this accuracy cannot decide
//     outside     all else
#pragma once

#include <string>
#include <vector>

#include "studies/findings/figure_changes.h"
#include "studies/variants/variant_runs.h"

namespace kurbel {

struct Deviation {
  double deviation = 0;  // greatest change of a figure that can be judged, over its own size
  double error = 0;      // of the runs: no judged figure deviates by more than deviation + error
  std::string figure = {};
  bool within = true;
  std::vector<std::string> not_judged = {};  // "peak_torque.pump (known to 3 %)"
};

Deviation deviation_of(const std::vector<FigureChange>& changes, double tolerance);

// One period of the steady motion after the scene's own start (studies/steady): figures only, with their errors.
VariantRun settled(const Scene& scene, const Effects& effects, const Watch& watch);

// Speeds, δ, peaks and RMS of torques over the period, against the full model. `figures`: names or their beginnings,
// as in runs ("peak_torque" includes cycle_peak_torque); empty: all of these.
Deviation settled_deviation(const Result& full, const Result& lean, const std::vector<std::string>& figures,
                            double tolerance);

// Both combined: the greater change, and an error that bounds both.
Deviation worse_of(const Deviation& a, const Deviation& b);

}  // namespace kurbel
