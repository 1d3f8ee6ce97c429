// size_plots.h — the classical diagrams of flywheel synthesis, and its formulas with their numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/findings/report.h"
#include "studies/size/size.h"

namespace kurbel {

// What the classical methods take the torques for.
std::string basis_of(const Sizing& sizing);

std::vector<Plot> cycle_diagrams(const Sizing& sizing);
std::vector<Plot> energy_mass_plots(const Sizing& sizing);
std::optional<Plot> speed_plot(const Sizing& sizing);

std::vector<FormulaCard> cycle_formulas(const Sizing& sizing);
std::vector<FormulaCard> method_formulas(const Sizing& sizing);
std::vector<FormulaCard> flywheel_formulas(const Sizing& sizing);
std::vector<FormulaCard> motor_formulas(const Sizing& sizing);
std::vector<FormulaCard> dimension_formulas(const FlywheelDimensions& dimensions);

}  // namespace kurbel
