// settling.h — what is still to be switched before a motion can be periodic, or in the one found; its rate of change.
#pragma once

#include <Eigen/Core>

#include "engine/events/equations.h"
#include "engine/return_map/periodicity.h"
#include "engine/return_map/return_map.h"

namespace kurbel {

// Time until which non-recurring switching remains [s]; in the past: none remains.
double switched_until(const Model& model, const Periodicity& period, const State& state);
// The next step of the sequence waits for an angle.
bool waits_for_angle(const Model& model, const Modes& modes);
// No law over angle or time defines the period: a vibration is self-excited, or the sequence is repeated.
bool has_own_period(const Model& model, const Periodicity& period, bool clocked = true);

// Maximum speed, and maximum rate of all states except angles, over the rated values.
struct Pace {
  double speed = 0, rate = 0;
};
Pace pace_of(Equations& equations, const State& state);

// A step that waits for a time or an angle is executed; a step that waits for a speed, if it is reached within a period or
// already. False for a repeated sequence.
bool sequence_goes_on(const ReturnMap& map, const Eigen::VectorXd& z);

}  // namespace kurbel
