// critical_speeds.h — at which speeds orders meet modes or their inertia excites them, and at which a machine can run.
#pragma once

#include <functional>
#include <vector>

#include "studies/modes/modes.h"

namespace kurbel {

// At which an order meets a mode, r Ω = ω_n [rad/s]: undamped, as is usual; where joints that the mode twists have states of
// their own, which stiffen them, |λ| of the damped swing.
double frequency_of_resonance(const LinearDrive& drive, const Mode& mode);

// Fills `critical`: where an order that has any strength meets a mode within the range, by speed.
void find_critical_speeds(ModesStudy& found);

// Speeds of the sweep, ascending: over the range evenly, about the critical ones closely, the operating one. A large drive
// has fewer, which is noted.
std::vector<double> sweep_speeds(ModesStudy& found);

// Fills `zones`: where the inertia's orders excite a mode parametrically within the range, by speed.
void find_zones(ModesStudy& found);

// The amplitudes of `critical`, in the joint that their mode twists most, by the sweep, which has points at and beside
// every one of them unless it was thinned. The peaks are located further by `at`, which responds at any speed, to some 1e-3
// of the resonance's width, and become points of the sweep. No peak is told of a mode that hardly swings (ζ ≥ 0.5), nor
// where speeds that are not kept lie before it, nor farther off than damping takes a peak from r Ω = |λ|.
void measure_critical_speeds(const std::function<SpeedResponse(double speed)>& at, ModesStudy& found);

// Whether small motions about a mean speed that is held grow (Re λ > 0): beyond its breakdown an induction motor pulls
// the less the slower it turns. Only of drives that a dense solver takes (160 coordinates); of larger ones never.
bool grows(const LinearDrive& drive);

// A speed is kept where nothing grows and the link's speed would swing by less than itself if all were rigid: what swings
// much by resonance alone is barred, not left out. What the linear response says of any other speed is of no motion that
// lasts. Where the operating point is none that is kept, nothing is told of the others.
void judge_kept_speeds(const ModesStudy& found, const LinearDrive& drive, SpeedResponse& response);

// Puts the critical speeds that are not kept into `not_kept`, and notes what is left out.
void leave_out_what_is_not_kept(ModesStudy& found);

// Fills `margins` from the operating speeds, modes, excitations and critical speeds that are there; for tolerances by the
// modes of the scene with other values, at the same speed, all as geared.
void find_margins(const Scene& scene, const Effects& effects, const ModesOptions& options, ModesStudy& found);

// A stretch of the sweep whose speeds are all kept, or all not.
struct SpeedStretch {
  std::size_t begin = 0, end = 0;  // of the sweep's entries
  bool kept = true;
};
std::vector<SpeedStretch> stretches(const std::vector<SpeedResponse>& sweep);

}  // namespace kurbel
