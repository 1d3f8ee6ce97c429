// torque_source.h — torques given as functions of time, angle or speed; sources drive, loads resist.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/elements/element.h"
#include "engine/elements/piece_guard.h"
#include "engine/numerics/curve.h"
#include "engine/numerics/dual.h"

namespace kurbel {

// M = M₀ + M₁ sin(2π f t + ψ)
struct HarmonicTorque {
  static constexpr ShaftTraits is{.periodic = true};
  Account work_account = Account::driving;
  double mean = 0;       // M₀ [N·m]
  double amplitude = 0;  // M₁ [N·m]
  double frequency = 0;  // f [Hz]
  double phase = 0;      // ψ [rad]

  template <class T>
  T torque(const ShaftState<T>& x) const {
    if (amplitude == 0) return T(mean);
    return T(mean + amplitude * std::sin(2 * std::numbers::pi * frequency * x.t + phase));
  }
  bool uses_time() const { return amplitude != 0; }
  bool uses_speed() const { return false; }
  Rated rated() const { return {std::abs(mean) + std::abs(amplitude), 0}; }
  double time_period() const { return amplitude == 0 || frequency == 0 ? 0 : 1 / std::abs(frequency); }
};

// M = sign · f(t), piecewise: the piece is the mode.
struct TorqueOverTime {
  static constexpr ShaftTraits is{.timed = true, .periodic = true, .settles = true};
  Account work_account = Account::driving;
  Curve curve;      // [s] → [N·m]
  double sign = 1;  // −1: a load

  template <class T>
  T torque(const ShaftState<T>& x) const {
    return T(sign * curve.value_in(x.mode, TimedPiece::near(curve, x.mode, x.t)));
  }
  int mode_at(double t) const { return TimedPiece::at(curve, t); }
  bool uses_time() const { return true; }
  bool uses_speed() const { return false; }
  double next_edge(double t) const { return TimedPiece::next_edge(curve, t); }
  Rated rated() const { return {curve.max_abs(), 0}; }
  double time_period() const { return curve.period(); }
  double settled_from() const { return TimedPiece::settled_from(curve); }
};

// M = sign · f(φ)
struct TorqueOverAngle {
  static constexpr ShaftTraits is{.uses_angle = true, .guards = 2};
  Account work_account = Account::driving;
  Curve curve;  // [rad] → [N·m], periodic
  double sign = 1;

  template <class T>
  T torque(const ShaftState<T>& x) const {
    return sign * PieceGuard::value(curve, x.mode, x.angle);
  }
  bool uses_time() const { return false; }
  bool uses_speed() const { return false; }
  double angle_period() const { return curve.period(); }
  void guard(const ShaftState<double>& x, double* g) const { PieceGuard::guard(curve, x.mode, x.angle, 1.0, g); }
  int first_mode(const ShaftState<double>& x) const { return PieceGuard::first(curve, x.angle); }
  int next_mode(const ShaftState<double>& x, int which) const { return PieceGuard::next(curve, x.mode, which); }
  std::string mode_name(int) const { return {}; }  // passing a point of a table is not reported
  Rated rated() const { return {curve.max_abs(), 0}; }
};

// M = sign · f(ω): a tabulated characteristic of a motor, hydraulic drive, turbine or brake.
struct TorqueOverSpeed {
  static constexpr ShaftTraits is{.guards = 2};
  Account work_account = Account::driving;
  Curve curve;  // [rad/s] → [N·m]
  double sign = 1;

  template <class T>
  T torque(const ShaftState<T>& x) const {
    return sign * curve.value_in(x.mode, x.rate);
  }
  bool uses_time() const { return false; }
  bool uses_speed() const { return true; }
  void guard(const ShaftState<double>& x, double* g) const {
    PieceGuard::guard(curve, x.mode, x.rate, curve.x().back() - curve.x().front(), g);
  }
  int first_mode(const ShaftState<double>& x) const { return PieceGuard::first(curve, x.rate); }
  int next_mode(const ShaftState<double>& x, int which) const { return PieceGuard::next(curve, x.mode, which); }
  std::string mode_name(int) const { return {}; }
  Rated rated() const { return {curve.max_abs(), std::max(std::abs(curve.x().front()), std::abs(curve.x().back()))}; }
};

}  // namespace kurbel
