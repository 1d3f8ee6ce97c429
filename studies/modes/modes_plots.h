// modes_plots.h — plots of mode shapes, forced response and a torque's spectrum; conclusion; results of spot checks.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "studies/findings/findings.h"
#include "studies/findings/report.h"
#include "studies/modes/modes.h"

namespace kurbel::modes {

inline double hertz(double omega) { return omega / (2 * std::numbers::pi); }
// "12.3 kN·m"
std::string torque_text(double value);
std::size_t joint_with_largest_amplitude(const SpeedResponse& response);
// One joint per component, that with the largest amplitude in the range: a continuous shaft has "shaft.1", "shaft.2", …
std::vector<std::size_t> joints_drawn(const ModesStudy& study);
// A little above the highest visible mode [Hz].
double end_of_spectrum(const ModesStudy& study, const AmplitudeSpectrum& spectrum);

bool is_forced(const ModesStudy& study);
// "First mode at 9.78 Hz (ζ = 0.126), second at 482 Hz; at 1500 rpm the torque in "coupling" oscillates by ± 9.9 N·m"
std::string conclusion_of(const ModesStudy& study);
// Of a machine that leaves the speed at which it was linearised: it comes to rest or runs away.
std::optional<Claim> motion_claim(const ModesStudy& study);
// Where misfiring, a case of the scene or another speed exceeds a limit: limits that hold are those of the drive as it is.
void name_condition_of_limits(Claims& claims);

// Distribution of a mode's energy, the largest share first; empty if unknown. Internal states of a component count as one.
struct EnergyStore {
  enum class Kind { mechanical, electrical, control };
  std::string name;  // "springs", "inertias", "current of motor"
  Kind kind = Kind::mechanical;
  double share = 0;
};
std::vector<EnergyStore> energy_stores(const ModesStudy& study, const Mode& mode);
// "inertias 50 %, current of motor 49 %, springs 1 %"
std::string energy_text(const ModesStudy& study, const Mode& mode);
// "torsional", "electrical", "mechanical and electrical": every kind that has a tenth of the energy.
std::string nature_of(const ModesStudy& study, const Mode& mode);

// ", raised by the lagging torque of motor": the internal state that holds nearly all of the mode's energy in such states, if the
// mode's damping alone does not explain the frequency f [rad/s]; else empty.
std::string why_shifted(const ModesStudy& study, const Mode& mode, double f);

std::vector<Plot> mode_plots(const ModesStudy& study);
std::vector<Plot> response_plots(const ModesStudy& study);
std::vector<Plot> history_plots(const ModesStudy& study, const TorqueHistory& history);

// Effect of each case on natural frequencies, margins, amplitudes and limits (cases.cpp): tables, curves of every
// joint, claims that do not hold for the unchanged drive.
void say_cases(Findings& findings, Chapter in, const ModesStudy& study);
// Spot checks (spot_findings.cpp): one line each and a table; marks on the curves for peaks of a joint in the nonlinear cycles.
void say_spots(Findings& findings, Chapter in, const ModesStudy& study);
void mark_spots(const ModesStudy& study, std::size_t joint, Plot& plot);

}  // namespace kurbel::modes
