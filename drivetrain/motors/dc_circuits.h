// dc_circuits.h — DC motors with their electric circuits: the current is a state (effect "transients").
//
//     shunt   L di/dt = c U − R i − k ω,         M = k i                                (theory 4.7, 4.9)
//     series  L di/dt = |c| U − R i − s κ ω i,   M = s κ i²,  s = sgn c
//     U, c    voltage [V]; command of the operating sequence: the part of U, < 0: reversed (in a series motor only the
//             armature, so that the torque changes its sign)
//     R, L    resistance [Ω], inductance [H] of armature circuit; series: of armature and field together
//     k, κ    motor constants [N·m/A], [N·m/A²]
// Off (command 0, or outside its window) the circuit is open: the current is zero at once, the energy ½ L i² is lost in
// the arc. A shunt motor with a braking resistance R_b is closed over it at command 0 (dynamic braking) and reversed
// through it (plugging): R + R_b instead of R. Resistance and sense are modes, so that ramps cross their changes as
// events. Initial current: i = 0 at rest (the motor is just switched on), that of the static characteristic when
// turning.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "drivetrain/motors/dc_series_motor.h"
#include "drivetrain/motors/motors.h"
#include "engine/elements/element.h"
#include "engine/numerics/dual.h"

namespace kurbel {

// Resistance in series with the armature while it brakes: command ≤ 0.
struct BrakingResistor {
  enum Mode : int { driving = 0, braking = 1 };
  double resistance = 0;  // R_b [Ω], ≥ 0; 0: none, the circuit opens at command 0

  double added(int mode) const { return mode == braking ? resistance : 0; }
  int mode_at(double command) const { return resistance > 0 && command <= 0 ? braking : driving; }
  double guard(int mode, double command) const {
    constexpr double zero = 1e-9;  // brakes below this, drives above twice this
    if (resistance == 0) return 1;
    return mode == driving ? command - zero : 2 * zero - command;
  }
  std::string name(int mode) const {
    return resistance == 0 ? "" : mode == driving ? "without braking resistance" : "over its braking resistance";
  }
};

// Static characteristic of a shunt motor with a braking resistance: M = k (c U − k ω)/(R + R_b).
struct BrakedShuntMotor {
  static constexpr ShaftTraits is{.account = Account::driving, .commanded = true, .reversible = true, .guards = 1};
  double voltage = 0, resistance = 0, constant = 0;  // U [V], R [Ω], k [N·m/A], > 0
  double rated_torque = 0;                           // for error scales; 0: the stall torque
  BrakingResistor brake;

  template <class T>
  T torque(const ShaftState<T>& x) const {
    return constant * (x.command * voltage - constant * x.rate) / (resistance + brake.added(x.mode));
  }
  bool opens_at_zero() const { return false; }  // closed over its braking resistance
  bool uses_time() const { return false; }
  bool uses_speed() const { return true; }
  double stall_torque() const { return constant * voltage / resistance; }
  double current(const ShaftState<double>& x) const {
    return (x.command * voltage - constant * x.rate) / (resistance + brake.added(x.mode));
  }
  double steady_current(const ShaftState<double>& x) const { return current(x); }
  Rated rated() const { return {rated_torque > 0 ? rated_torque : stall_torque(), voltage / constant}; }
  void guard(const ShaftState<double>& x, double* g) const { g[0] = brake.guard(x.mode, x.command); }
  int first_mode(const ShaftState<double>& x) const { return brake.mode_at(x.command); }
  int next_mode(const ShaftState<double>& x, int) const { return 1 - x.mode; }
  std::string mode_name(int mode) const { return brake.name(mode); }
};

struct DcShuntCircuit {
  static constexpr ShaftTraits is{.account = Account::driving,
                                  .commanded = true,
                                  .reversible = true,
                                  .guards = 1,
                                  .states = 1,
                                  .feels_switching = true,
                                  .other_forms = true};
  BrakedShuntMotor line;                       // its static law
  double inductance = 0;                       // L [H], > 0
  std::optional<double> initial_current = {};  // [A]

  template <class T>
  T torque(const ShaftState<T>& x) const {
    return line.constant * x.own[0];
  }
  template <class T>
  void rates(const ShaftState<T>& x, T* rate) const {
    const double total = line.resistance + line.brake.added(x.mode);
    rate[0] = x.on ? (x.command * line.voltage - total * x.own[0] - line.constant * x.rate) / inductance : T(0.0);
  }
  void first_states(const ShaftState<double>& x, double* own) const {
    const double total = line.resistance + line.brake.added(x.mode);
    const double steady = x.rate == 0 ? 0 : (x.command * line.voltage - line.constant * x.rate) / total;
    own[0] = x.on ? initial_current.value_or(steady) : 0;
  }
  void switched(const ShaftState<double>&, double* own) const { own[0] = 0; }
  double current(const ShaftState<double>& x) const { return x.own[0]; }
  double steady_current(const ShaftState<double>& x) const { return line.current(x); }
  InternalState state(int) const { return {"current", "A", line.voltage / line.resistance, true}; }
  bool opens_at_zero() const { return line.brake.resistance == 0; }
  bool uses_time() const { return false; }
  bool uses_speed() const { return true; }
  Rated rated() const { return line.rated(); }
  void guard(const ShaftState<double>& x, double* g) const { line.guard(x, g); }
  int first_mode(const ShaftState<double>& x) const { return line.first_mode(x); }
  int next_mode(const ShaftState<double>& x, int which) const { return line.next_mode(x, which); }
  std::string mode_name(int mode) const { return line.mode_name(mode); }
};

struct DcSeriesCircuit {
  static constexpr ShaftTraits is{.account = Account::driving,
                                  .commanded = true,
                                  .reversible = true,
                                  .guards = 3,  // overspeed; unbounded current; sense of the armature
                                  .states = 1,
                                  .feels_switching = true,
                                  .other_forms = true};
  DcSeriesMotor line;                          // its static law
  double inductance = 0;                       // L of armature and field [H], > 0
  std::optional<double> initial_current = {};  // [A]

  template <class T>
  T torque(const ShaftState<T>& x) const {
    return sense(x.mode) * line.constant * x.own[0] * x.own[0];
  }
  template <class T>
  void rates(const ShaftState<T>& x, T* rate) const {
    rate[0] = x.on ? (std::abs(x.command) * line.voltage -
                      (line.resistance + sense(x.mode) * line.constant * x.rate) * x.own[0]) /
                         inductance
                   : T(0.0);
  }
  // Driven backwards beyond −R/κ there is no steady current; the initial current is then zero.
  void first_states(const ShaftState<double>& x, double* own) const {
    const double total = line.resistance + sense(x.mode) * line.constant * x.rate;
    const double steady = x.rate == 0 || total <= 0 ? 0 : std::abs(x.command) * line.voltage / total;
    own[0] = x.on ? initial_current.value_or(steady) : 0;
  }
  void switched(const ShaftState<double>&, double* own) const { own[0] = 0; }
  double current(const ShaftState<double>& x) const { return x.own[0]; }
  double steady_current(const ShaftState<double>& x) const { return line.current(x); }
  InternalState state(int) const { return {"current", "A", stall_current(), true}; }
  double stall_current() const { return line.voltage / line.resistance; }
  bool opens_at_zero() const { return true; }
  bool uses_time() const { return false; }
  bool uses_speed() const { return true; }
  Rated rated() const { return line.rated(); }

  // Mode: sense of the armature, and whether it ran away (2), reported as an event before the run ends.
  void guard(const ShaftState<double>& x, double* g) const;
  int first_mode(const ShaftState<double>& x) const { return x.command < 0 ? reversed : 0; }
  int next_mode(const ShaftState<double>& x, int which) const;
  std::string mode_name(int mode) const;

 private:
  enum Mode : int { reversed = 1, ran_away = 2 };
  static constexpr double most_current = 50;  // limit, over the stall current; no motor withstands it
  static double sense(int mode) { return mode & reversed ? -1 : 1; }
};

// Without the effect "transients": their static laws.
ShaftForm under(const DcShuntCircuit& circuit, const Effects& effects);
ShaftForm under(const DcSeriesCircuit& circuit, const Effects& effects);

}  // namespace kurbel
