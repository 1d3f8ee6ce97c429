// higher_speeds.h — does a machine that turns faster than its usual speed settle at a higher one? By its balance, and by a trial.
#pragma once

#include <array>

#include "engine/run/run.h"
#include "studies/findings/watch.h"

namespace kurbel {

// Of mean speeds over doubling times: each is higher than the one before it, and by no less.
inline bool keeps_gaining(const std::array<double, 3>& mean) {
  return mean[2] > mean[1] && mean[2] - mean[1] >= mean[1] - mean[0];
}

// Over a cycle of the rigid machine at constant speed: whether loads and drag balance the drive at some speed above this
// one of the link.
bool settles_at_a_higher_speed(const Model& model, double t, double speed);

// Tried: the run goes on to eight times its time. Its mean speeds over the time as long again, twice and four times as
// long grow by less from one to the next: slower than the logarithm of time, for what dampers take is not in the balance
// of the rigid machine. So does what does not come to `least` times the speed at the end. A trial that ends before knows
// nothing: by the budget that the run left, or by its evaluations. Few cycles (`least` > 0) are then no runaway.
// `equations`: in the modes at the run's end; `speed_at_end`: of the link; `budget`: of the run and its trials [s of processor time].
bool settles_later(const Equations& equations, const RunOutcome& outcome, double speed_at_end, const Watch& watch,
                   double budget, double least);

}  // namespace kurbel
