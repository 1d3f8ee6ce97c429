// sweep_plots.h — a sweep drawn: response over each parameter, maps of two parameters, bars of influence, a scatter matrix.
#pragma once

#include <vector>

#include "studies/findings/report.h"
#include "studies/sweep/sweep_findings.h"

namespace kurbel {

// A figure over the parameters that move it most; of one parameter with the band of its errors.
std::vector<Plot> response_plots(const SweepStudyResult& study);
// Two parameters: which variants hold the limit, which not. Variants in rows and columns have their figure as colours, others
// that have no limit stand in fifths of it.
std::vector<Plot> limit_maps(const SweepStudyResult& study);
std::vector<Plot> influence_plots(const SweepStudyResult& study);
// Parameters and figures against one another in pairs, coloured by the limits; one picture, or none of too few.
std::vector<Plot> scatter_matrix(const SweepStudyResult& study);

// Of many rows so many, drawn by chance.
std::vector<const SweepRow*> some_rows(const SweepStudyResult& study, std::size_t most);
// What is drawn, at most four: figures that a limit is on come first.
std::vector<std::size_t> figures_drawn(const SweepStudyResult& study);
// Parameters by their influence on a figure; as they were given where none is known.
std::vector<std::size_t> parameters_for(const SweepStudyResult& study, std::size_t figure);

}  // namespace kurbel
