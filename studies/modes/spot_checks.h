// spot_checks.h — comparison of the linear response over a speed range with the nonlinear cycle at the most important speeds.
//
// Importance: u(Ω) = max over joints of load over allowable load (its limits; without any, the rule of barred
// ranges). Peaks of u over the range come first, the highest first, then the ends of the range; 5 % of the speed
// apart, excluding the operating speed, whose cycle is known; none where u is below 1 %.              (theory 12.13)
#pragma once

#include <functional>

#include "studies/modes/modes.h"
#include "studies/response/held_cycle.h"

namespace kurbel {

// Fills `spots`: for the requested speeds, and for a number of speeds of the sweep.
void check_spots(const HeldMachine& machine, const std::function<LinearDrive(double speed)>& drive_at,
                 const ModesOptions& options, ModesStudy& found);

}  // namespace kurbel
