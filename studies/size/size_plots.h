// size_plots.h — the classical diagrams of flywheel synthesis, and its formulas with their numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/findings/report.h"
#include "studies/size/size.h"

namespace kurbel {

// Assumption of the classical methods about the torques.
std::string basis_of(const Sizing& sizing);

std::vector<Plot> cycle_diagrams(const Sizing& sizing);
std::vector<Plot> energy_mass_plots(const Sizing& sizing);
std::optional<Plot> speed_plot(const Sizing& sizing);

Formulas cycle_formulas(const Sizing& sizing);
Formulas method_formulas(const Sizing& sizing);
Formulas flywheel_formulas(const Sizing& sizing);
Formulas motor_formulas(const Sizing& sizing);
Formulas dimension_formulas(const FlywheelDimensions& dimensions);

}  // namespace kurbel
