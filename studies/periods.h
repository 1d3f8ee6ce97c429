// periods.h — recognises run-up, steady motion and run-down.
#pragma once

#include "studies/result.h"

namespace kurbel {

// Run-up ends where the reduction link's speed enters the range of the last cycle ± 1 % for good (without a mechanism:
// the last speed ± 1 %); run-down begins where the last driving source goes off; standstill is below 0.1 % of the
// steady speed. Motion is steady when the last two cycles' mean speeds agree to 0.1 %.
Periods find_periods(const Model& model, const std::vector<CycleRecord>& cycles, const TrajectoryRecorder& trajectory,
                     const RunOutcome& outcome);

}  // namespace kurbel
