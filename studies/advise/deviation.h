// deviation.h — whether the figures of a leaner model stay within a tolerance of the fullest one's.
//
// Of every figure the change d (of the model) and its error e (of the two runs) are judged apart, at tolerance τ:
//     within      d + e ≤ τ
//     not judged  e > τ and d − e ≤ τ: no run at this accuracy could show that it is within, nor is it surely outside
//     outside     all else
#pragma once

#include <string>
#include <vector>

#include "studies/findings/figure_changes.h"

namespace kurbel {

struct Deviation {
  double deviation = 0;  // the greatest change of a figure that can be judged, over its own size
  double error = 0;      // of the runs: no figure that is judged deviates by more than deviation + error
  std::string figure = {};
  bool within = true;
  std::vector<std::string> not_judged = {};  // "peak_torque.pump (known to 3 %)"
};

Deviation deviation_of(const std::vector<FigureChange>& changes, double tolerance);

}  // namespace kurbel
