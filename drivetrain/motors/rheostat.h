// rheostat.h — DC motor started with resistances in its armature circuit, cut out one after another.
//
//     stage k: the law of the motor with R + R_k instead of R,   R_1 > R_2 > … > 0; last stage: R
// The next stage begins when the armature current has fallen to the switching current, or at given times. With an
// inductance the current first rises after each switching to its peak (di/dt = 0: it equals the current of steady motion
// at that speed), then falls; a stage whose peak stays below the switching current is left at the peak. If the motor
// turns at the start, it is past the peak. Like an induction motor on its starter, the motor is only on or off; switched
// on again, it has all its resistances again and no current.
// Source: G. K. Dubey, Fundamentals of Electrical Drives, ch. 5 (starting of DC motors); theory 4.18.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "drivetrain/motors/dc_circuits.h"
#include "engine/elements/element.h"
#include "engine/numerics/dual.h"

namespace kurbel {

enum class CutOut { by_current, by_time };

// The stages, and the parts of a mode: the stage, and the mode of the motor in it.
template <class Motor>
struct RheostatStages {
  std::vector<Motor> stages;    // with R + R_1, R + R_2, …, R
  double switch_current = 1;    // [A]
  std::vector<double> times{};  // ends of the stages, after switching on [s]

 protected:
  static constexpr bool has_peak = Motor::is.states > 0;
  static constexpr int most_own = 4;  // modes of a motor
  struct Mode {
    int stage = 0, own = 0;
    bool past_peak = false, announced = false;  // announced: the last event was a change of stage
  };
  static Mode unpacked(int mode) {
    return {mode / (4 * most_own), mode / 4 % most_own, (mode & 2) != 0, (mode & 1) != 0};
  }
  static int packed(const Mode& m) { return ((m.stage * most_own + m.own) * 2 + m.past_peak) * 2 + m.announced; }
  template <class T>
  static ShaftState<T> inner(ShaftState<T> x) {
    x.mode = unpacked(x.mode).own;
    return x;
  }
  int last() const { return static_cast<int>(stages.size()) - 1; }
  const Motor& motor(const Mode& m) const { return stages[static_cast<std::size_t>(m.stage)]; }
  double flowing(const Mode& m, const ShaftState<double>& x) const { return std::abs(motor(m).current(inner(x))); }
  double steady(const Mode& m, const ShaftState<double>& x) const {
    return std::abs(motor(m).steady_current(inner(x)));
  }
};

// Members that only a motor with its current as a state has.
template <class Motor, bool has_states>
struct RheostatCurrent : RheostatStages<Motor> {};
template <class Motor>
struct RheostatCurrent<Motor, true> : RheostatStages<Motor> {
  template <class T>
  void rates(const ShaftState<T>& x, T* rate) const {
    this->motor(this->unpacked(x.mode)).rates(this->inner(x), rate);
  }
  void first_states(const ShaftState<double>& x, double* own) const {
    this->motor(this->unpacked(x.mode)).first_states(this->inner(x), own);
  }
  void switched(const ShaftState<double>& x, double* own) const { this->stages.back().switched(x, own); }
  InternalState state(int k) const { return this->stages.back().state(k); }
};

// Members that only stages by time have.
template <class Motor, CutOut when>
struct RheostatTimes : RheostatCurrent<Motor, (Motor::is.states > 0)> {};
template <class Motor>
struct RheostatTimes<Motor, CutOut::by_time> : RheostatCurrent<Motor, (Motor::is.states > 0)> {
  double settled_from() const { return this->times.back(); }
};

template <class Motor, CutOut when>
struct OnRheostat : RheostatTimes<Motor, when> {
  using Stages = RheostatStages<Motor>;
  using Stages::stages, Stages::switch_current, Stages::times;
  static constexpr int own_guards = Motor::is.guards;  // the next guard is the end of the stage
  static constexpr ShaftTraits is = [] {
    ShaftTraits traits = Motor::is;
    traits.guards += 1;
    traits.commanded = traits.reversible = false;
    traits.starts_anew = true;
    traits.settles = when == CutOut::by_time;
    return traits;
  }();

  template <class T>
  T torque(const ShaftState<T>& x) const {
    return motor(unpacked(x.mode)).torque(inner(x));
  }
  bool uses_time() const { return when == CutOut::by_time; }
  bool uses_speed() const { return true; }
  Rated rated() const { return stages.back().rated(); }

  void guard(const ShaftState<double>& x, double* g) const {
    const Mode m = unpacked(x.mode);
    motor(m).guard(inner(x), g);
    double& left = g[own_guards];
    if (m.stage == last())
      left = 1;
    else if (when == CutOut::by_time)
      left = x.on_since + times[static_cast<std::size_t>(m.stage)] - x.t;
    else if (m.past_peak)
      left = flowing(m, x) / switch_current - 1;
    else
      left = (steady(m, x) - flowing(m, x)) / switch_current;
  }
  int first_mode(const ShaftState<double>& x) const { return begun(x, !has_peak || x.rate != 0); }
  int mode_anew(const ShaftState<double>& x) const { return begun(x, !has_peak); }
  int next_mode(const ShaftState<double>& x, int which) const {
    Mode m = unpacked(x.mode);
    m.announced = false;
    if (which < own_guards) {
      m.own = motor(m).next_mode(inner(x), which);
      return packed(m);
    }
    if (when == CutOut::by_current && !m.past_peak && flowing(m, x) > switch_current) {
      m.past_peak = true;
      return packed(m);
    }
    // Stages in which the current would not rise above the switching current are skipped.
    do {
      ++m.stage;
    } while (when == CutOut::by_current && m.stage < last() && steady(m, x) <= switch_current);
    m.past_peak = !has_peak;
    m.announced = true;
    return packed(m);
  }
  std::string mode_name(int mode) const {
    const Mode m = unpacked(mode);
    if (!m.announced) return stages.back().mode_name(m.own);
    if (m.stage == last()) return "starting resistance cut out";
    return "starting resistance " + std::to_string(m.stage + 1) + " of " + std::to_string(last());
  }

 private:
  using Stages::flowing, Stages::has_peak, Stages::inner, Stages::last, Stages::motor, Stages::packed, Stages::steady,
      Stages::unpacked;
  using Mode = typename Stages::Mode;

  // The mode at the start: the first stage that has not ended yet.
  int begun(const ShaftState<double>& x, bool past_peak) const {
    Mode m;
    if (when == CutOut::by_time) {
      while (m.stage < last() && x.t >= x.on_since + times[static_cast<std::size_t>(m.stage)]) ++m.stage;
    } else if (past_peak || x.rate != 0) {
      while (m.stage < last() && steady(m, x) <= switch_current) ++m.stage;
    }
    m.past_peak = past_peak && when == CutOut::by_current;
    m.own = motor(m).first_mode(x);
    return packed(m);
  }
};

// Without the effect "transients": their static laws.
template <class Circuit, CutOut when>
ShaftForm under(const OnRheostat<Circuit, when>& motor, const Effects& effects) requires(Circuit::is.states > 0);

}  // namespace kurbel
