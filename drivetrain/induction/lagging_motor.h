// lagging_motor.h — an induction motor whose torque follows its static curve with the lag of the fluxes
// (effect "torque_lag", in machines with elastic elements).
//
//     T_e dM/dt + M = M_static(ω),   T_e = 1/(s_b ω_s)         (theory 4.21)
//     s_b      breakdown slip of the curve
//     ω_s      2π f, f the mains frequency: the electrical synchronous angular frequency, not that of the shaft
//
// T_e is the rotor's transient time constant X/(ω_s R_r). It does not depend on voltage or frequency of the supply, so a
// motor on any starter has the value of the mains. Accuracy against the two-axis model: theory 4.21, and the tests.
// Switched off, the torque is zero at once and the lagging torque decays with T_e; switched on again, the motor starts
// with the rest of it. Initial torque: zero at rest (the motor is just switched on), that of the curve when turning.
#pragma once

#include <fmt/format.h>

#include <numbers>
#include <string>
#include <utility>

#include "engine/elements/element.h"
#include "engine/scene/effects.h"

namespace kurbel {

struct FluxLag {
  double breakdown_slip = 0, mains = 0;                                                // s_b [1], f [Hz], > 0
  double time() const { return 1 / (2 * std::numbers::pi * breakdown_slip * mains); }  // T_e [s]
};

// Motor: an element without internal states.
template <class Motor>
struct LaggingMotor : Motor {
  static constexpr ShaftTraits is = [] {
    ShaftTraits traits = Motor::is;
    traits.states = 1;
    traits.described = traits.other_forms = true;
    return traits;
  }();
  FluxLag lag;

  LaggingMotor(Motor motor, FluxLag its) : Motor(std::move(motor)), lag(its) {}

  template <class T>
  T torque(const ShaftState<T>& x) const {
    if constexpr (requires(const Motor& motor) { motor.is_open(0); })
      if (this->is_open(x.mode)) return T(0.0);
    return x.own[0];
  }
  template <class T>
  void rates(const ShaftState<T>& x, T* rate) const {
    rate[0] = ((x.on ? Motor::torque(x) : T(0.0)) - x.own[0]) / lag.time();
  }
  void first_states(const ShaftState<double>& x, double* own) const {
    own[0] = x.on && x.rate != 0 ? Motor::torque(x) : 0;
  }
  InternalState state(int) const { return {"lagging_torque", "N*m", this->rated().torque, false, true}; }
  std::string describe() const {
    return fmt::format(
        "induction motor on its static curve with the lag of the fluxes, T_e dM/dt + M = M(ω), T_e = 1/(s_b 2π f) = "
        "{:.3g} ms by the breakdown slip {:.3g} at {:g} Hz; it has no pulsation at {:g} Hz after switching on, which "
        "can make the peak torques of a start several times as large; the two-axis model has it (key frequency, effect "
        "transients)",
        1e3 * lag.time(), lag.breakdown_slip, lag.mains, lag.mains);
  }
};

// Without the effect: the static curve.
template <class Motor>
ShaftForm under(const LaggingMotor<Motor>& motor, const Effects& effects);

}  // namespace kurbel
