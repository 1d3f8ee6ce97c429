// spot_checks.h — the linear response over a range of speeds, held against the nonlinear cycle where it matters most.
//
// Where that is: u(Ω) = max over joints of load over what it may bear (its limits; without any, the rule of barred
// ranges). Peaks of u over the range count first, the highest first, then the ends of the range; 5 % of the speed apart,
// off the operating speed, whose cycle is known; none where u stays below 1 %.              (theory 12.13)
#pragma once

#include <functional>

#include "studies/modes/modes.h"
#include "studies/response/held_cycle.h"

namespace kurbel {

// Fills `spots`: of the speeds that are asked for, and of so many more of the sweep's.
void check_spots(const HeldMachine& machine, const std::function<LinearDrive(double speed)>& drive_at,
                 const ModesOptions& options, ModesStudy& found);

}  // namespace kurbel
