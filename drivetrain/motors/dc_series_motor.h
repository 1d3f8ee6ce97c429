// dc_series_motor.h — DC series motor, static: armature and field carry the same current, the flux is proportional to it.
//     M = κ i²,  U = (R + κ ω) i   ⇒   M = κ U²/(R + κ ω)²                                  (theory 4.8)
//
// A command c of the operating sequence sets the voltage to |c| U; c < 0 reverses the armature relative to the field and
// thus the torque: M = sgn c · κ (c U)²/(R + κ ω sgn c)². 0 opens the circuit.
//
// The torque never reaches zero: without load the motor **runs away**. At `max_speed` the run ends with a message.
// Driven backwards it brakes, U and the induced voltage add, and the current grows without bound as ω → −R/κ (in a real
// motor the iron saturates first and a fuse blows). The law is valid down to half of that speed, where the current is
// twice the stall current U/R; there the run ends with a message as well.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "engine/elements/element.h"
#include "engine/numerics/dual.h"
#include "engine/scene/speed_unit.h"

namespace kurbel {

struct DcSeriesMotor {
  static constexpr ShaftTraits is{.account = Account::driving, .commanded = true, .reversible = true, .guards = 2};
  double voltage = 0;         // U [V], > 0
  double resistance = 0;      // R of armature and field [Ω], > 0
  double constant = 0;        // κ, torque over current squared [N·m/A²], > 0
  double max_speed = 0;       // [rad/s], > 0
  std::string name = {};      // of the component, for messages
  std::string limit_by = {};  // origin of max_speed, if not the scene
  SpeedUnit unit = {};        // of speeds in messages

  // R/κ: the speed at which the torque is a quarter of the stall torque [rad/s].
  double base_speed() const { return resistance / constant; }
  double stall_torque() const { return constant * voltage * voltage / (resistance * resistance); }
  double least_speed() const { return -0.5 * base_speed(); }

  template <class T>
  T torque(const ShaftState<T>& x) const {
    const double stall = sense(x) * x.command * x.command * stall_torque();
    const T speed = sense(x) * x.rate;
    if (value_of(speed) < least_speed()) {  // reached only by trial steps: a parabola, continuous with two derivatives
      const double at = 0.5;
      const T below = (speed - least_speed()) / base_speed();
      return stall / (at * at) * (1.0 - 2.0 / at * below + 3.0 / (at * at) * below * below);
    }
    const T over_stall = 1.0 + speed / base_speed();
    return stall / (over_stall * over_stall);
  }
  // Current of steady motion at this speed [A]; constant outside the range of the law.
  double current(const ShaftState<double>& x) const {
    return std::abs(x.command) * voltage / (resistance * std::max(0.5, 1 + sense(x) * x.rate / base_speed()));
  }
  double steady_current(const ShaftState<double>& x) const { return current(x); }
  bool opens_at_zero() const { return true; }
  bool uses_time() const { return false; }
  bool uses_speed() const { return true; }
  Rated rated() const { return {stall_torque(), base_speed()}; }

  // Mode 0: normal. Mode 1: ran away; reported as an event, after which the run ends with a message.
  void guard(const ShaftState<double>& x, double* g) const {
    const double speed = sense(x) * x.rate;
    g[0] = x.mode == 0 ? std::min(1.0, (max_speed - speed) / max_speed) : -1.0;
    g[1] = std::min(1.0, (speed - least_speed()) / base_speed());
  }
  int first_mode(const ShaftState<double>&) const { return 0; }
  int next_mode(const ShaftState<double>& x, int which) const {
    if (which == 1)
      throw std::runtime_error(
          fmt::format("series motor \"{}\" is driven backwards at {}, half the speed at which its current "
                      "grows without bound (−R/κ); give it a lighter load, or more resistance",
                      name, unit.text(least_speed())));
    if (x.mode != 0) say_it_ran_away();
    return 1;
  }
  [[noreturn]] void say_it_ran_away() const {
    throw std::runtime_error(fmt::format(
        "series motor \"{}\" ran away: its speed passed max_speed = {}{}. Nothing on its shaft held it below, "
        "and its own torque reaches zero at no speed; load it more, or raise max_speed if the machine can bear it",
        name, unit.text(max_speed), limit_by.empty() ? "" : " (" + limit_by + ")"));
  }
  std::string mode_name(int mode) const { return mode == 0 ? "" : "ran away: passed its max_speed"; }

 private:
  template <class T>
  static double sense(const ShaftState<T>& x) {
    return x.command < 0 ? -1 : 1;
  }
};

}  // namespace kurbel
