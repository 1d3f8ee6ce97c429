// started_motor.h — an induction motor on its starter, with a torque limit:
//     M = factor · M_c(ω + lag), limited to ± limit          (factor, lag: starters.h)
// Each time it is switched on, it starts from the first stage.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "drivetrain/induction/starters.h"
#include "engine/elements/element.h"
#include "engine/numerics/dual.h"

namespace kurbel {

template <class Motor, class Starter>
struct StartedMotor {
  // Guards: two ends of the piece of the characteristic, two torque limits, end of the stage.
  static constexpr ShaftTraits is{.account = Account::driving, .settles = true, .guards = 5, .starts_anew = true};
  Motor motor;
  Starter starter;
  double torque_limit = HUGE_VAL;  // [N·m], > 0

  template <class T>
  T torque(const ShaftState<T>& x) const {
    const Mode m = unpacked(x.mode);
    if (m.limit != free) return T(m.limit == upper ? torque_limit : -torque_limit);
    return unlimited(m, x.t - x.on_since, x.rate);
  }
  bool uses_time() const { return starter.uses_time(); }
  bool uses_speed() const { return true; }
  double settled_from() const { return starter.settled_from(); }
  Rated rated() const { return motor.rated(); }
  bool is_open(int mode) const { return mode < 0; }  // between star and delta

  void guard(const ShaftState<double>& x, double* g) const {
    const Mode m = unpacked(x.mode);
    std::fill(g, g + is.guards, 1.0);
    g[4] = std::min(1.0, starter.guard(m.stage, since(x), x.rate));
    if (m.stage < 0) return;  // contacts open between star and delta
    motor.guard_piece(m.piece, x.rate + starter.supply(m.stage, since(x)).lag, g);
    if (std::isinf(torque_limit)) return;
    const double over = unlimited(m, since(x), x.rate) / torque_limit;
    if (m.limit != lower) g[2] = std::min(1.0, m.limit == upper ? over - 1 : 1 - over);
    if (m.limit != upper) g[3] = std::min(1.0, m.limit == lower ? -1 - over : 1 + over);
  }
  int first_mode(const ShaftState<double>& x) const {
    return packed(entered(starter.first_stage(since(x), x.rate), x));
  }
  int mode_anew(const ShaftState<double>& x) const { return first_mode(x); }
  int next_mode(const ShaftState<double>& x, int which) const {
    Mode m = unpacked(x.mode);
    m.last_event = nothing;
    if (which < 2) {
      m.piece = motor.next_piece(m.piece, which);
    } else if (which < 4) {
      m.limit = m.limit != free ? free : which == 2 ? upper : lower;
      m.last_event = torque_limited;
    } else {
      m = entered(starter.next_stage(m.stage, since(x)), x);
      m.last_event = new_stage;
    }
    return packed(m);
  }
  std::string mode_name(int mode) const {
    const Mode m = unpacked(mode);
    if (m.last_event == new_stage) return starter.name(m.stage);
    if (m.last_event == torque_limited) return m.limit == free ? "below its torque limit" : "at its torque limit";
    return {};
  }

 private:
  static double since(const ShaftState<double>& x) { return x.t - x.on_since; }  // time since switching on [s]
  enum Limit { free, upper, lower };
  enum LastEvent { nothing, new_stage, torque_limited };  // kind of the last event
  struct Mode {
    int stage = 0, piece = 0;
    Limit limit = free;
    LastEvent last_event = nothing;
  };
  static Mode unpacked(int mode) {
    if (mode < 0) return {mode, 0, free, new_stage};
    return {mode / (9 * Motor::pieces), mode / 9 % Motor::pieces, static_cast<Limit>(mode / 3 % 3),
            static_cast<LastEvent>(mode % 3)};
  }
  static int packed(const Mode& m) {
    return m.stage < 0 ? m.stage : ((m.stage * Motor::pieces + m.piece) * 3 + m.limit) * 3 + m.last_event;
  }
  template <class T>
  T unlimited(const Mode& m, double t, const T& speed) const {
    if (m.stage < 0) return T(0.0);
    const Supply now = starter.supply(m.stage, t);
    return now.factor * motor.torque_in(m.piece, speed + now.lag);
  }
  // The mode at entry into a stage: piece and torque limit by the present state.
  Mode entered(int stage, const ShaftState<double>& x) const {
    Mode m{stage, 0, free, nothing};
    if (stage < 0) return m;
    m.piece = motor.piece_at(x.rate + starter.supply(stage, since(x)).lag);
    const double torque = unlimited(m, since(x), x.rate);
    m.limit = torque > torque_limit ? upper : torque < -torque_limit ? lower : free;
    return m;
  }
};

}  // namespace kurbel
