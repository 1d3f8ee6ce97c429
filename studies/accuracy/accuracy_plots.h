// accuracy_plots.h — error against processor time, of the motion and of figures; error of the model against the numbers'.
#pragma once

#include <vector>

#include "studies/accuracy/accuracy.h"
#include "studies/findings/report.h"

namespace kurbel {

// Model and numbers together: what is bought per time, and which of the two is the coarser.
std::vector<Plot> total_plots(const AccuracyStudy& study);
// Of every model with more than one setting.
std::vector<Plot> motion_cost_plots(const AccuracyStudy& study);
std::vector<Plot> figure_cost_plots(const AccuracyStudy& study);

}  // namespace kurbel
