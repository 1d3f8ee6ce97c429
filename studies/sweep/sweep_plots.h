// sweep_plots.h — a sweep drawn: response over each parameter, maps of two parameters, bars of influence.
#pragma once

#include <vector>

#include "studies/findings/report.h"
#include "studies/sweep/sweep_findings.h"

namespace kurbel {

// A figure over the parameters that move it most; of one parameter with the band of its errors.
std::vector<Plot> response_plots(const SweepStudyResult& study);
// Two parameters: which variants hold all limits, which none; without limits by fifths of the figure.
std::vector<Plot> limit_maps(const SweepStudyResult& study);
std::vector<Plot> influence_plots(const SweepStudyResult& study);

}  // namespace kurbel
