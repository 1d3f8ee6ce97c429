// deviation.h — whether the figures of a reduced model stay within a tolerance of those of the full model.
//
// For every figure the change d (of the model) and its error e (of the two runs) are assessed separately, at tolerance τ:
//     within      d + e ≤ τ
//     not judged  e > τ and d − e ≤ τ: runs of this accuracy cannot decide
//     outside     all else
#pragma once

#include <string>
#include <vector>

#include "studies/findings/figure_changes.h"

namespace kurbel {

struct Deviation {
  double deviation = 0;  // greatest change of a figure that can be judged, over its own size
  double error = 0;      // of the runs: no judged figure deviates by more than deviation + error
  std::string figure = {};
  bool within = true;
  std::vector<std::string> not_judged = {};  // "peak_torque.pump (known to 3 %)"
};

Deviation deviation_of(const std::vector<FigureChange>& changes, double tolerance);

}  // namespace kurbel
