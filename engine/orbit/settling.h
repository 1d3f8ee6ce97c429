// settling.h — what a motion still waits for before it can come again, and how fast it changes.
#pragma once

#include "engine/events/equations.h"
#include "engine/return_map/periodicity.h"

namespace kurbel {

// Until when something is still to be switched that does not come again [s]; before: nothing.
double switched_until(const Model& model, const Periodicity& period, const State& state);
// The next step of the sequence comes at an angle.
bool waits_for_angle(const Model& model, const Modes& modes);
// Nothing that depends on an angle or on time sets the pace: what vibrates, vibrates by itself; or a sequence goes round.
bool has_own_period(const Model& model, const Periodicity& period);

// Greatest speed, and greatest rate of all that is no angle, of the rated values.
struct Pace {
  double speed = 0, rate = 0;
};
Pace pace_of(Equations& equations, const State& state);

}  // namespace kurbel
