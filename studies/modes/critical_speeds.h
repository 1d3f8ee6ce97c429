// critical_speeds.h — critical and parametrically excited speeds, and speeds that the machine can hold.
#pragma once

#include <functional>
#include <vector>

#include "studies/modes/modes.h"

namespace kurbel {

// Frequency at which an order coincides with a mode, r Ω = ω_n [rad/s]: undamped, as usual; |λ| of the damped
// vibration if joints twisted by the mode have internal states, which stiffen them.
double frequency_of_resonance(const LinearDrive& drive, const Mode& mode);

// Fills `critical`: intersections of orders of non-zero strength with modes within the range, by speed.
void find_critical_speeds(ModesStudy& found);

// Speeds of the sweep, ascending: equidistant over the range, dense about the critical ones, and the operating speed.
// Fewer for a large drive, with a note.
std::vector<double> sweep_speeds(ModesStudy& found);

// Fills `zones`: speeds in the range at which orders of the inertia excite a mode parametrically.
void find_zones(ModesStudy& found);

// Fills the amplitudes of `critical` for the joint that the mode twists most, from the sweep, which has points at and
// beside every one of them unless it was thinned. The peaks are refined by `at`, the response at any speed, to some
// 1e-3 of the resonance's width, and become points of the sweep. No peak is given for a strongly damped mode (ζ ≥
// 0.5), nor beyond speeds that are not held, nor farther from r Ω = |λ| than damping can shift it.
void measure_critical_speeds(const std::function<SpeedResponse(double speed)>& at,
                             const std::function<void(double part)>& progress, ModesStudy& found);

// Whether small deviations from a held mean speed grow (Re λ > 0): beyond its breakdown torque an induction motor drives
// less the slower it turns. Only for drives within reach of a dense solver (160 coordinates); false for larger ones.
bool grows(const LinearDrive& drive);

// A speed is kept if nothing grows there and the link's speed variation would be smaller than the mean speed if all
// were rigid; large resonant vibration makes a speed barred, not omitted. At other speeds the linear response belongs
// to no lasting motion. If the operating speed itself is not kept, the others are not marked.
void judge_operating_speeds(const ModesStudy& found, const LinearDrive& drive, SpeedResponse& response);

// Moves critical speeds that are not kept into `not_kept`, and notes what is omitted.
void omit_speeds_not_held(ModesStudy& found);

// Fills `margins` from the operating speeds, modes, excitations and critical speeds; for tolerances by the modes of
// the scene with other values, at the same speed, with all shafts turning as geared.
void find_margins(const Scene& scene, const Effects& effects, const ModesOptions& options, ModesStudy& found);

// A range of the sweep whose speeds are all kept, or all not.
struct SpeedStretch {
  std::size_t begin = 0, end = 0;  // of the sweep's entries
  bool kept = true;
};
std::vector<SpeedStretch> stretches(const std::vector<SpeedResponse>& sweep);

}  // namespace kurbel
