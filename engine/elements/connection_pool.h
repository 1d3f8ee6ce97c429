// connection_pool.h — all connections of one type, evaluated in one loop.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/elements/element_pool.h"
#include "engine/elements/valid.h"
#include "engine/numerics/dual.h"

namespace kurbel {

// Indices of a connection in the model.
struct ConnectionPorts {
  int id = 0;  // index of the twist
  int shaft_a = 0, shaft_b = 0;
  double gain_a = 1, gain_b = 1;  // θ̇ = gain_a ω_a − gain_b ω_b
  int loss_account = 0;
};

// Indices needed by some connections only: modes, internal states, a command, the angle of a.
struct ConnectionExtras {
  int mode = 0;
  int own = 0;       // first of its internal states
  int command = -1;  // −1: none
  int angle = -1;    // tracked angle of a
  std::string component = {};
};

template <class E>
class ConnectionPool final : public ElementPool {
  static_assert(demand_valid_connection<E>());
  static constexpr int internal_states = E::is.states;
  static constexpr bool needs_extras = Guarded<E> || HasStates<E> || Commanded<E> || UsesAngle<E>;
  struct Nothing {};
  using Extras = std::conditional_t<needs_extras, ConnectionExtras, Nothing>;

 public:
  // Long chains are limited by memory bandwidth: data of every step are contiguous, Jacobian slots are separate.
  struct Placed {
    E element;
    ConnectionPorts at;
    [[no_unique_address]] Extras more;
  };
  void place(E element, const ConnectionPorts& at, const ConnectionExtras& more = {}) {
    if constexpr (needs_extras) {
      placed_.push_back({std::move(element), at, more});
    } else {
      placed_.push_back({std::move(element), at, {}});
    }
  }

  void add(const Instant& now, Sums& sums) const override {
    if (sums.work_rate) return add_all<true>(now, sums);
    add_all<false>(now, sums);
  }

  void register_jacobian(JacobianPattern& pattern) override {
    slots_.clear();
    for (const Placed& p : placed_) {
      Slots s;
      const int a = pattern.speed(p.at.shaft_a), b = pattern.speed(p.at.shaft_b);
      const std::array<int, inputs> column = columns(p, pattern);
      for (std::size_t k = 0; k < inputs; ++k) {
        s.a[k] = pattern.entry(a, column[k]);
        s.b[k] = pattern.entry(b, column[k]);
        if constexpr (internal_states > 0)
          for (int i = 0; i < internal_states; ++i)
            s.own[static_cast<std::size_t>(i)][k] = pattern.entry(pattern.own(p.more.own + i), column[k]);
      }
      slots_.push_back(s);
    }
  }

  void add_jacobian(const Instant& now, const double*, double* slots) const override {
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      const Placed& p = placed_[i];
      if constexpr (Slipping<E>)
        if (now.slip[p.at.id] == 0) continue;
      const Slots& slot = slots_[i];
      const Inputs in(p, now);
      const Number tau = p.element.torque(in.dual);
      Number on_a = -tau;
      if constexpr (UsesAngle<E>) on_a = on_a + p.element.turning_torque(in.dual);
      scatter(on_a, p, p.at.gain_a, slot.a, slots);
      scatter(tau, p, p.at.gain_b, slot.b, slots);
      if constexpr (internal_states > 0) {
        std::array<Number, internal_states> rate;
        p.element.rates(in.dual, rate.data());
        for (std::size_t k = 0; k < internal_states; ++k) scatter(rate[k], p, 1, slot.own[k], slots);
      }
    }
  }

  void add_torque_slopes(const Instant& now, std::vector<TorqueSlope>& slopes) const override {
    using By = TorqueSlope::By;
    for (const Placed& p : placed_) {
      if constexpr (Slipping<E>)
        if (now.slip[p.at.id] == 0) continue;
      const Number tau = p.element.torque(Inputs(p, now).dual);
      slopes.push_back({p.at.id, By::twist, p.at.id, tau.d[0]});
      slopes.push_back({p.at.id, By::rate, p.at.id, tau.d[1]});
      if constexpr (internal_states > 0)
        for (int k = 0; k < internal_states; ++k) slopes.push_back({p.at.id, By::own, p.more.own + k, tau.d[2 + k]});
      if constexpr (UsesAngle<E>) slopes.push_back({p.at.id, By::angle, p.more.angle, tau.d[2 + internal_states]});
      if constexpr (UsesSpeeds<E>) slopes.push_back({p.at.id, By::speed_of_a, p.at.shaft_a, tau.d[derivatives - 1]});
    }
  }

  int guard_count() const override {
    if constexpr (Guarded<E>) return static_cast<int>(placed_.size()) * E::is.guards;
    return 0;
  }
  bool guards_are_of_angle() const override { return !Guarded<E>; }
  void guards(const Instant& now, double* g) const override {
    if constexpr (Guarded<E>)
      for (const Placed& p : placed_) {
        const Twist<double> x = motion(p, now);
        if (is_regularised(x.mode)) {
          std::fill(g, g + E::is.guards, 1.0);
        } else {
          p.element.guard(x, g);
        }
        g += E::is.guards;
      }
  }
  void fire(const Instant& now, int guard, int* mode) const override {
    if constexpr (Guarded<E>) {
      const Placed& p = owner(guard);
      mode[p.more.mode] = p.element.next_mode(motion(p, now), guard % E::is.guards);
    }
  }
  GuardLabel label(int guard, const Instant& now) const override {
    if constexpr (ContactModes<E>) {
      const int mode = now.mode[owner(guard).more.mode];
      return {owner(guard).more.component, mode_text(owner(guard), now.mode),
              mode == 0 ? EventKind::lock : EventKind::slip, mode};
    } else if constexpr (Guarded<E>) {
      return {owner(guard).more.component, mode_text(owner(guard), now.mode)};
    }
    return {};
  }
  void first_modes(const Instant& now, int* mode) const override {
    if constexpr (Guarded<E>)
      for (const Placed& p : placed_)
        if (!is_regularised(mode[p.more.mode])) mode[p.more.mode] = p.element.first_mode(motion(p, now));
  }
  bool regularise(int guard, int* mode) const override {
    if constexpr (E::is.regularised_mode.has_value()) {
      mode[owner(guard).more.mode] = *E::is.regularised_mode;
      return true;
    }
    return false;
  }
  void first_states(const Instant& now, double* own) const override {
    if constexpr (HasStates<E>)
      for (const Placed& p : placed_) p.element.first_states(motion(p, now), own + p.more.own);
  }
  void add_slip_holds(const Instant& now, Hold* hold) const override {
    if constexpr (Slipping<E>)
      for (const Placed& p : placed_) hold[p.at.id] = p.element.hold(motion(p, now));
  }

  double energy(const Instant& now) const override {
    double sum = 0;
    if constexpr (E::is.has_spring())
      for (const Placed& p : placed_) {
        if constexpr (E::is.spring_takes_motion)
          sum += p.element.energy(motion(p, now));
        else
          sum += p.element.energy(now.twist[p.at.id]);
      }
    return sum;
  }

 private:
  // Derivatives by θ, θ̇, internal states, the angle, the speed of a.
  static constexpr int derivatives = 2 + internal_states + (UsesAngle<E> ? 1 : 0) + (UsesSpeeds<E> ? 1 : 0);
  using Number = Dual<derivatives>;
  // A connection's motion with unit derivatives.
  struct Inputs {
    Inputs(const Placed& p, const Instant& now) : x(motion(p, now)) {
      for (int k = 0; k < internal_states; ++k) own[static_cast<std::size_t>(k)] = Number::input(x.own[k], 2 + k);
      dual = {
          Number::input(x.angle, 0), Number::input(x.rate, 1), x.t, x.mode, x.direction, x.command, own.data(), {}, {}};
      if constexpr (UsesAngle<E>) dual.turn = Number::input(x.turn, 2 + internal_states);
      if constexpr (UsesSpeeds<E>) dual.turn_rate = Number::input(x.turn_rate, derivatives - 1);
    }
    Inputs(const Inputs&) = delete;  // `dual` points to `own`
    Inputs& operator=(const Inputs&) = delete;
    Twist<double> x;
    std::array<Number, internal_states + 1> own;
    Twist<Number> dual;
  };
  // Columns: θ, ω_a, ω_b, internal states, the angle.
  static constexpr std::size_t inputs = 3 + internal_states + (UsesAngle<E> ? 1 : 0);
  struct Slots {
    std::array<int, inputs> a, b;
    std::array<std::array<int, inputs>, internal_states> own;
  };

  static std::array<int, inputs> columns(const Placed& p, JacobianPattern& pattern) {
    std::array<int, inputs> c{};
    c[0] = pattern.twist(p.at.id), c[1] = pattern.speed(p.at.shaft_a), c[2] = pattern.speed(p.at.shaft_b);
    if constexpr (internal_states > 0)
      for (int k = 0; k < internal_states; ++k) c[static_cast<std::size_t>(3 + k)] = pattern.own(p.more.own + k);
    if constexpr (UsesAngle<E>) c[inputs - 1] = pattern.angle(p.more.angle);
    return c;
  }
  static void scatter(const Dual<derivatives>& value, const Placed& p, double gain, const std::array<int, inputs>& to,
                      double* slots) {
    slots[to[0]] += gain * value.d[0];
    slots[to[1]] += gain * value.d[1] * p.at.gain_a;
    slots[to[2]] -= gain * value.d[1] * p.at.gain_b;
    if constexpr (UsesSpeeds<E>) slots[to[1]] += gain * value.d[derivatives - 1] * p.at.gain_a;
    for (std::size_t k = 3; k < inputs; ++k) slots[to[k]] += gain * value.d[k - 1];
  }

  const Placed& owner(int guard) const requires Guarded<E> {
    return placed_[static_cast<std::size_t>(guard / E::is.guards)];
  }
  static bool is_regularised(int mode) {
    if constexpr (E::is.regularised_mode.has_value()) return mode == *E::is.regularised_mode;
    return false;
  }
  static std::string mode_text(const Placed& p, const int* mode) {
    if constexpr (Guarded<E>) return p.element.mode_name(mode[p.more.mode]);
    return {};
  }
  static Twist<double> motion(const Placed& p, const Instant& now) {
    Twist<double> x{now.twist[p.at.id], p.at.gain_a * now.speed[p.at.shaft_a] - p.at.gain_b * now.speed[p.at.shaft_b]};
    if constexpr (needs_extras) {
      x.t = now.t;
      if constexpr (Guarded<E>) x.mode = now.mode[p.more.mode];
      if constexpr (HasStates<E>) x.own = now.own + p.more.own;
      if constexpr (Commanded<E>)
        if (p.more.command >= 0) x.command = now.command[p.more.command];
      if constexpr (UsesAngle<E>) x.turn = now.angle[p.more.angle];
    }
    if constexpr (UsesSpeeds<E>) x.turn_rate = p.at.gain_a * now.speed[p.at.shaft_a];
    if constexpr (Slipping<E>) x.direction = now.slip[p.at.id];
    return x;
  }

  template <bool with_work>
  void add_all(const Instant& now, Sums& sums) const {
    for (const Placed& p : placed_) {
      Twist<double> x = motion(p, now);
      double tau = 0;
      if constexpr (Slipping<E>) {
        if (x.direction == 0)
          x.rate = 0;  // its torque is found with the accelerations
        else
          tau = p.element.torque(x);
      } else {
        tau = p.element.torque(x);
      }
      sums.twist_rate[p.at.id] = x.rate;
      sums.connection_torque[p.at.id] = tau;
      double from_a = tau;
      if constexpr (UsesAngle<E>) from_a -= sums.turning_torque[p.at.id] = p.element.turning_torque(x);
      sums.torque[p.at.shaft_a] -= p.at.gain_a * from_a;
      sums.torque[p.at.shaft_b] += p.at.gain_b * tau;
      if constexpr (HasStates<E>) p.element.rates(x, sums.internal_rate + p.more.own);
      if constexpr (with_work) add_work(p, x, tau, sums);
    }
  }
  static void add_work(const Placed& p, const Twist<double>& x, double tau, Sums& sums) {
    double spring = 0;
    if constexpr (E::is.spring_takes_motion)
      spring = p.element.spring_torque(x);
    else if constexpr (E::is.has_spring())
      spring = p.element.spring_torque(x.angle);
    sums.spring_torque[p.at.id] = spring;
    if constexpr (E::is.reports_loss)
      sums.work_rate[p.at.loss_account] -= p.element.loss_power(x);
    else
      sums.work_rate[p.at.loss_account] -= (tau - spring) * x.rate;
  }

  std::vector<Placed> placed_;
  std::vector<Slots> slots_;
};

}  // namespace kurbel
