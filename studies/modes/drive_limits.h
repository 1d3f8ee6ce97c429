// drive_limits.h — what the scene's limits say of a drive's swings: barred ranges of speed, and verdicts on components.
#pragma once

#include "studies/modes/modes.h"

namespace kurbel {

// Fills `limits` and `barred` from the sweep over the speeds. A joint without limits is barred where its swing exceeds
// `barred_factor` times its mean torque, if that mean is one to go by.
void find_barred_ranges(const Model& model, double barred_factor, ModesStudy& found);

// Fills `verdicts` of all joints with limits: at the operating point, passing the resonances below it, and of the
// simulated torque, if there is one.
void judge_limits(ModesStudy& found);

}  // namespace kurbel
