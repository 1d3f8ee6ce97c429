// modes_plots.h — plots of modes, critical speeds, forced response and a torque's spectrum.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "studies/findings/report.h"
#include "studies/modes/modes.h"

namespace kurbel::modes {

inline double hertz(double omega) { return omega / (2 * std::numbers::pi); }
// "12.3 kN·m"
std::string torque_text(double value);
std::size_t joint_with_largest_swing(const SpeedResponse& response);
// The `count` critical speeds with the largest amplitudes, by their places in the list, in its order: by speed.
std::vector<std::size_t> strongest_critical(const ModesStudy& study, std::size_t count);

std::vector<Plot> mode_plots(const ModesStudy& study);
Plot campbell_plot(const ModesStudy& study);
std::vector<Plot> response_plots(const ModesStudy& study);
std::vector<Plot> history_plots(const ModesStudy& study, const TorqueHistory& history);

}  // namespace kurbel::modes
