// governor.h — speed governor: proportional–integral on torque, with limits.
//
//     u = (K_p (c ω_ref − ω) + I)/(1 + K_p d),   e = c ω_ref − ω − d u,   M = u limited to M_min … M_max
//     dI/dt = K_i e + (M − u)/T_t
//     ω_ref, c  reference speed [rad/s]; command of the operating sequence: the part of ω_ref
//     K_p, K_i  proportional and integral gain [N·m·s/rad], [N·m/rad]
//     d         droop: decrease of the steady speed per torque [rad/(s·N·m)]; 0: no steady-state error
//     T_t       tracking time [s]: at a limit the integral tracks M, which prevents windup (back-calculation;
//               Åström, Hägglund: PID Controllers, 2nd ed. 1995, sect. 3.5)
// The integral is a state; the active limit is a mode. M and dI/dt are continuous at the limits. Off (command 0) the
// torque is zero and the integral is reset.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/elements/element.h"
#include "engine/numerics/dual.h"

namespace kurbel {

struct SpeedGovernor {
  static constexpr ShaftTraits is{
      .account = Account::driving, .commanded = true, .guards = 2, .states = 1, .feels_switching = true};
  enum Mode : int { free = 0, upper = 1, lower = -1 };
  double reference = 0;        // ω_ref [rad/s]
  double proportional = 0;     // K_p [N·m·s/rad], ≥ 0
  double integral = 0;         // K_i [N·m/rad], ≥ 0
  double droop = 0;            // d [rad/(s·N·m)], ≥ 0
  double most = 0, least = 0;  // M_max > M_min [N·m]
  double tracking_time = 1;    // T_t [s], > 0
  double initial_torque = 0;   // I at the start [N·m]

  // u
  template <class T>
  T demand(const ShaftState<T>& x) const {
    return (proportional * (x.command * reference - x.rate) + x.own[0]) / (1 + proportional * droop);
  }
  template <class T>
  T torque(const ShaftState<T>& x) const {
    return x.mode == free ? demand(x) : T(x.mode == upper ? most : least);
  }
  template <class T>
  void rates(const ShaftState<T>& x, T* rate) const {
    rate[0] = T(0.0);
    if (!x.on || integral == 0) return;
    const T u = demand(x);
    rate[0] = integral * (x.command * reference - x.rate - droop * u) + (torque(x) - u) / tracking_time;
  }
  void first_states(const ShaftState<double>& x, double* own) const { own[0] = x.on ? initial_torque : 0; }
  void switched(const ShaftState<double>&, double* own) const { own[0] = 0; }
  InternalState state(int) const { return {"integral", "N*m", scale()}; }
  bool opens_at_zero() const { return true; }
  bool uses_time() const { return false; }
  bool uses_speed() const { return true; }
  Rated rated() const { return {scale(), std::abs(reference)}; }

  void guard(const ShaftState<double>& x, double* g) const {
    const double u = demand(x);
    g[0] = x.mode == lower ? 1 : x.mode == upper ? (u - most) / scale() : (most - u) / scale();
    g[1] = x.mode == upper ? 1 : x.mode == lower ? (least - u) / scale() : (u - least) / scale();
    for (int i = 0; i < is.guards; ++i) g[i] = std::min(g[i], 1.0);
  }
  int first_mode(const ShaftState<double>& x) const {
    const double u = demand(x);
    return u > most ? upper : u < least ? lower : free;
  }
  int next_mode(const ShaftState<double>& x, int which) const {
    if (x.mode != free) return free;
    return which == 0 ? upper : lower;
  }
  std::string mode_name(int mode) const {
    return mode == free ? "governs" : mode == upper ? "at its upper limit" : "at its lower limit";
  }

 private:
  double scale() const { return std::max(std::abs(most), std::abs(least)); }
};

}  // namespace kurbel
