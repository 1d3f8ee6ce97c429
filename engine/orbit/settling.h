// settling.h — remaining switching before a motion can be periodic, and its rate of change.
#pragma once

#include "engine/events/equations.h"
#include "engine/return_map/periodicity.h"

namespace kurbel {

// Time until which non-recurring switching remains [s]; in the past: none remains.
double switched_until(const Model& model, const Periodicity& period, const State& state);
// The next step of the sequence waits for an angle.
bool waits_for_angle(const Model& model, const Modes& modes);
// No law over angle or time defines the period: a vibration is self-excited, or the sequence is repeated.
bool has_own_period(const Model& model, const Periodicity& period);

// Maximum speed, and maximum rate of all states except angles, over the rated values.
struct Pace {
  double speed = 0, rate = 0;
};
Pace pace_of(Equations& equations, const State& state);

}  // namespace kurbel
