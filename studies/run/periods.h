// periods.h — run-up, steady motion and run-down, located on the solution itself.
//
// All from the reduction link's speed ω on the dense output of the steps, not from samples.
//
// driven time   from the start until the last driving source is finally switched off; the whole run if none is.
// section       of the driven time, between changes of a command, up to the end of their ramps and laws over time, of windows of
//               time, and of the starts of drives; from where on a law over time is constant (switchings.h). A sequence that
//               repeats divides nothing. What counts is the last section that has three mid speeds, and none before the last
//               start of a drive.
// mid speeds    ω_k = ½ (ω_max + ω_min) of each whole cycle of the section, converted to equal time steps. For machines
//               without a cycle: of each period of the laws over time; if there is none, the speed without its vibration
//               (limit_of_speed, duty/approach.h), of less than 64 intervals mean speeds of sixteen equal parts.
// steady        the distance of the mid speeds to their limit is at most 0.1 % of the last one. The limit follows from the
//               decrease of the changes (approach_of): geometric, δ_k+1 = q δ_k, with a remaining sum of q/(1 − q) of
//               the last one. Changes that do not decrease have no limit, however small they are: a runaway, a drift.
// period        of steady motion: the fewest cycles, up to twelve, after which each mid speed is as above; where that leaves
//               cycles with different works, the fewest with a tenth of the difference and at most 1 % of the works. Else
//               periods of the laws over time.
// steady speed  the mid speed of the last period; without any, the speed at the end of the driven time, without its vibration.
//               Only for steady motion.
// run-up        ends when ω, for the rest of the driven time, stays within the range of the last period widened by a
//               twentieth of it, but by 0.1 … 1 % of the steady speed; by 1 % if ω leaves that in later cycles (without a
//               period: steady speed ± 1 %, of what vibrates by more ± 2, 5 … 50 %); but not before a drive is started:
//               before its starter, ramp or law has come to its end. Only for steady motion; a machine that starts within that range has no run-up.
// run-down      from the end of the driven time to standstill, or to the end; a pause of a drive that the clock switches is
//               none. The three periods and their works have the
//               same borders everywhere (duty/work_periods.h).
// standstill    |ω| finally stays below 0.1 % of its usual speed; or, where dry friction ends the motion, the link is held
//               soon after that (rest_of, engine/run/speed_history.h), however it trembles later.
#pragma once

#include <cmath>

#include "engine/run/speed_history.h"
#include "studies/duty/approach.h"
#include "studies/findings/result.h"
#include "studies/run/switchings.h"

namespace kurbel {

// What is known of the reduction link in a run. `by_time`: records of the periods of its laws over time (clock_of).
struct LinkHistory {
  double begin = 0;  // of the run [s]
  const std::vector<CycleRecord>& cycles;
  const std::vector<CycleRecord>& by_time;
  const SpeedRecorder& speed;
  const RunOutcome& outcome;
  const std::vector<Switched>& switchings;
};
// `tolerance`: local, of the run; speed errors of this size shift the end of run-up by run_up_resolution.
Periods find_periods(const Model& model, const LinkHistory& link, double tolerance);

// Records of so many cycles in a row, the last one with the last cycle that ends by `until`.
std::vector<CycleRecord> in_periods(const std::vector<CycleRecord>& cycles, int in_a_row, double until = HUGE_VAL);

// Change of the mid speed, or of the range of the speed, from one record to the next, over that range; 0 within the run's
// errors.
double drift_of(const CycleRecord& last, const CycleRecord& before, double tolerance);

}  // namespace kurbel
