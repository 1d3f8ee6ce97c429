// reduce_plots.h — the reduced machine over the cycle, its harmonics, and the drive drawn as an elastic chain.
#pragma once

#include <string>
#include <vector>

#include "studies/findings/report.h"
#include "studies/reduce/reduce.h"

namespace kurbel {

// Symbols and units of the positions' values: for a mass on a slider, or an inertia on a shaft.
struct ReducedNames {
  std::string inertia, inertia_unit, slope_unit, torque, torque_unit;
};
ReducedNames names_of(const MachineReduction& reduction);
// Accounts with a share above `least` times the largest one: by default with any, for people above rounding.
inline constexpr double above_rounding = 1e-12;
std::vector<std::size_t> acting(const MachineReduction& reduction, double least = 0);
// Whether it is a rounding error of the sums.
bool is_dust(const Harmonic& harmonic, const Spectrum& spectrum);
// The speed at which the torques are taken.
std::string speed_text(const MachineReduction& reduction);

std::vector<Plot> motion_plots(const MachineReduction& reduction);
std::vector<Plot> harmonics_plots(const MachineReduction& reduction);
// The paths of each linkage's moving points.
std::vector<Plot> path_plots(const MachineReduction& reduction);

}  // namespace kurbel
