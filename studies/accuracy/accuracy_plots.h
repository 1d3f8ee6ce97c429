// accuracy_plots.h — error against processor time, of the motion and of figures; model error against numerical error.
#pragma once

#include <vector>

#include "studies/accuracy/accuracy.h"
#include "studies/findings/report.h"

namespace kurbel {

// Model and numerical error together over time, and which of the two dominates.
std::vector<Plot> total_plots(const AccuracyStudy& study);
// For every model with more than one setting.
std::vector<Plot> motion_cost_plots(const AccuracyStudy& study);
std::vector<Plot> figure_cost_plots(const AccuracyStudy& study);

}  // namespace kurbel
