// sweep_plots.h — plots of a sweep: response over each parameter, maps of two parameters, bars of influence, scatter matrix.
#pragma once

#include <vector>

#include "studies/findings/report.h"
#include "studies/sweep/sweep_findings.h"

namespace kurbel {

// A figure over its most influential parameters; for one parameter with an error band.
std::vector<Plot> response_plots(const SweepStudyResult& study);
// Two parameters: variants that meet the limit and those that do not. On a grid the figure is shown by colours;
// otherwise, without a limit, by fifths of its range.
std::vector<Plot> limit_maps(const SweepStudyResult& study);
std::vector<Plot> influence_plots(const SweepStudyResult& study);
// Pairs of parameters and figures, coloured by the limits; one plot, or none for too few.
std::vector<Plot> scatter_matrix(const SweepStudyResult& study);

// A random sample of many rows.
std::vector<const SweepRow*> some_rows(const SweepStudyResult& study, std::size_t most);
// Figures to draw, at most four: those with limits come first.
std::vector<std::size_t> figures_drawn(const SweepStudyResult& study);
// Parameters by their influence on a figure; in the given order if unknown.
std::vector<std::size_t> parameters_for(const SweepStudyResult& study, std::size_t figure);

}  // namespace kurbel
