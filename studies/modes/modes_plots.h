// modes_plots.h — plots of mode shapes, forced response and a torque's spectrum.
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
// Up to a little above the highest mode that still shows [Hz].
double end_of_spectrum(const ModesStudy& study, const AmplitudeSpectrum& spectrum);

std::vector<Plot> mode_plots(const ModesStudy& study);
std::vector<Plot> response_plots(const ModesStudy& study);
std::vector<Plot> history_plots(const ModesStudy& study, const TorqueHistory& history);

}  // namespace kurbel::modes
