// periods.h — run-up, steady motion and run-down, located on the solution itself.
//
// All of it is of the reduction link's speed ω, as the steps' own dense output gives it; no sample is looked at.
//
// driven time   from the start to the time at which the last driving source goes off for good; all of the run where
//               none does.
// mid speeds    ω_k = ½ (ω_max + ω_min) of each whole cycle that ends within the driven time, taken over to equal
// times.
//               Of machines without a cycle: mean speeds of sixteen equal parts of the driven time.
// steady        what the mid speeds still have to go to their limit is at most 0.1 % of the last one. The limit comes from
//               how the changes shrink (approach_of): geometrically, δ_k+1 = q δ_k, they still sum up to q/(1 − q) of
//               the last one. Changes that do not shrink have no limit, however small they are: a runaway, a drift.
// steady speed  the last mid speed; without a cycle the speed at the end of the driven time. Of steady motion only.
// run-up        ends where ω enters for good, up to the end of the driven time, the range of the last cycle widened by
//               1 % of the steady speed (without a cycle: steady speed ± 1 %). Of steady motion only; a machine that
//               begins within that range has no run-up.
// run-down      from the end of the driven time to standstill, or to the end. The three periods and their works are between
//               these times wherever they are told (duty/work_periods.h).
// standstill    the link comes to rest and is held to the end; else |ω| stays for good below 0.1 % of the last mid
//               speed, or of the speed at the end of the driven time.
#pragma once

#include <span>

#include "engine/run/speed_history.h"
#include "studies/findings/result.h"

namespace kurbel {

// What the last of a sequence of equally spaced values lacks to the limit.
struct Approach {
  double last_change = 0;           // from the last but one value
  std::optional<double> remaining;  // |limit − last value|; nothing: no limit is in sight, or fewer than three values
};

// Judged by the later half of the values. One-sided changes are followed over short and long stretches of it, and the
// worse answer counts: two halves of a stretch that change by D₁, D₂ leave D₂ q/(1 − q), q = D₂/D₁ < 1. Changes to and
// fro leave their range, magnified where it grows. Changes below `noise` are not followed: they leave themselves.
Approach approach_of(std::span<const double> values, double noise);

// `tolerance`: local, of the run; errors of the speed below it move run-up's end by run_up_resolution.
Periods find_periods(const Model& model, const std::vector<CycleRecord>& cycles, const SpeedRecorder& speed,
                     const RunOutcome& outcome, double tolerance);

}  // namespace kurbel
