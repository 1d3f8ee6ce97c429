// time_to_turn.h — time in which a shaft turns by an angle at its present speed: limits steps, so that no guard is missed.
#pragma once

#include <cmath>

#include "engine/equations/contact.h"
#include "engine/events/equations.h"
#include "engine/numerics/index.h"
#include "engine/steppers/stepper.h"

namespace kurbel {

// Time [s] from the stepper's time until the angle has changed by `by` [rad]; a prescribed shaft may start from rest.
// Infinite at standstill.
inline double time_to_turn(const Equations& equations, const TrackedAngle& angle, double by, const Stepper& stepper) {
  const Model& m = equations.model();
  if (at(angle.shaft) < m.free_shafts)
    return by / std::abs(angle.gain * stepper.y()[equations.speed_index(angle.shaft)]);
  const double t = stepper.t(),
               omega = std::abs(angle.gain * prescribed_speed(m, equations.modes(), at(angle.shaft), t)),
               alpha = std::abs(angle.gain * prescribed_acceleration(m, equations.modes(), at(angle.shaft), t));
  return 2 * by / (omega + std::sqrt(omega * omega + 2 * alpha * by));
}

}  // namespace kurbel
