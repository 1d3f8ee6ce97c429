// field_weakening.h — separately excited DC motor with field weakening, prescribed over the time or the speed.
//
//     M = f k (c U − f k ω)/R,      ω₀ = U/(f k)                                        (theory 4.20)
//     L di/dt = c U − R i − f k ω,  M = f k i
//     f       flux over rated flux, > 0: by table or formula over the time, or over |ω|
// The field has no lag: its circuit, slower than the armature's, has no state; include the lag in the table.
// Switched off, the armature circuit is open. Source: G. K. Dubey, Fundamentals of Electrical Drives, ch. 5.
#pragma once

#include <cmath>
#include <string>

#include "drivetrain/motors/dc_circuits.h"
#include "engine/elements/element.h"
#include "engine/elements/piece_guard.h"
#include "engine/numerics/curve.h"

namespace kurbel {

enum class FieldOver { time, speed };

// Members of a motor required by the pieces of f: edges in time, or guards over the speed.
template <FieldOver over>
struct FieldPart {
  Curve curve;  // [s] → [1]

  template <class T>
  T part(const ShaftState<T>& x) const {
    return T(curve.value_in(x.mode, TimedPiece::near(curve, x.mode, x.t)));
  }
  int mode_at(double t) const { return TimedPiece::at(curve, t); }
  double next_edge(double t) const { return TimedPiece::next_edge(curve, t); }
  double time_period() const { return curve.period(); }
  double settled_from() const { return TimedPiece::settled_from(curve); }
};

template <>
struct FieldPart<FieldOver::speed> {
  Curve curve;  // [rad/s] → [1], from 0 on; constant beyond its ends, so that |ω| has no kink at standstill

  template <class T>
  T part(const ShaftState<T>& x) const {
    return curve.value_in(x.mode, value_of(x.rate) < 0 ? T(-1.0 * x.rate) : T(x.rate));
  }
  void guard(const ShaftState<double>& x, double* g) const {
    PieceGuard::guard(curve, x.mode, std::abs(x.rate), curve.x().back() - curve.x().front(), g);
  }
  int first_mode(const ShaftState<double>& x) const { return PieceGuard::first(curve, std::abs(x.rate)); }
  int next_mode(const ShaftState<double>& x, int which) const { return PieceGuard::next(curve, x.mode, which); }
  std::string mode_name(int) const { return {}; }
};

template <FieldOver over>
constexpr ShaftTraits weakened_traits() {
  ShaftTraits is{.account = Account::driving, .commanded = true, .reversible = true};
  if (over == FieldOver::time)
    is.timed = is.periodic = is.settles = true;
  else
    is.guards = 2;
  return is;
}

// The static characteristic.
template <FieldOver over>
struct WeakenedShuntMotor : FieldPart<over> {
  static constexpr ShaftTraits is = weakened_traits<over>();
  double voltage = 0, resistance = 0, constant = 0;  // U [V], R [Ω], k [N·m/A] at full field
  double rated_torque = 0;                           // for error scales; 0: the stall torque

  template <class T>
  T torque(const ShaftState<T>& x) const {
    const T k = constant * this->part(x);
    return k * (x.command * voltage - k * x.rate) / resistance;
  }
  bool opens_at_zero() const { return true; }
  bool uses_time() const { return over == FieldOver::time; }
  bool uses_speed() const { return true; }
  Rated rated() const {
    return {rated_torque > 0 ? rated_torque : constant * voltage / resistance, voltage / constant};
  }
};

// With the armature circuit.
template <FieldOver over>
struct WeakenedShuntCircuit : FieldPart<over> {
  static constexpr ShaftTraits is = [] {
    ShaftTraits traits = weakened_traits<over>();
    traits.states = 1;
    traits.feels_switching = traits.other_forms = true;
    return traits;
  }();
  WeakenedShuntMotor<over> line;               // its static law
  double inductance = 0;                       // L [H], > 0
  std::optional<double> initial_current = {};  // [A]

  template <class T>
  T torque(const ShaftState<T>& x) const {
    return line.constant * this->part(x) * x.own[0];
  }
  template <class T>
  void rates(const ShaftState<T>& x, T* rate) const {
    rate[0] = x.on ? (x.command * line.voltage - line.resistance * x.own[0] - line.constant * this->part(x) * x.rate) /
                         inductance
                   : T(0.0);
  }
  void first_states(const ShaftState<double>& x, double* own) const {
    const double steady =
        x.rate == 0 ? 0 : (x.command * line.voltage - line.constant * this->part(x) * x.rate) / line.resistance;
    own[0] = x.on ? initial_current.value_or(steady) : 0;
  }
  void switched(const ShaftState<double>&, double* own) const { own[0] = 0; }
  InternalState state(int) const { return {"current", "A", line.voltage / line.resistance, true}; }
  bool opens_at_zero() const { return true; }
  bool uses_time() const { return over == FieldOver::time; }
  bool uses_speed() const { return true; }
  Rated rated() const { return line.rated(); }
};

// Without the effect "transients": the static law.
template <FieldOver over>
ShaftForm under(const WeakenedShuntCircuit<over>& circuit, const Effects& effects);

}  // namespace kurbel
