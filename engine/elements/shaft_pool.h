// shaft_pool.h — all shaft elements of one type, evaluated in one loop.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "engine/elements/element_pool.h"
#include "engine/elements/valid.h"
#include "engine/numerics/dual.h"

namespace kurbel {

// Indices of a shaft element in the model.
struct ShaftPorts {
  int id = 0;    // index among shaft elements
  int mode = 0;  // first of its mode slots
  int node = 0;
  int shaft = 0;
  double gain = 1;   // speed of the element's own shaft over that of the merged one
  int angle = -1;    // tracked angle
  double phase = 0;  // added to the tracked angle [rad]
  int account = 0;
  int own = 0;       // first of its internal states
  int command = -1;  // −1: none

  // Sign of the element's speed; its shaft may turn opposite to the merged one.
  int direction(const Instant& now) const { return gain < 0 ? -now.direction[shaft] : now.direction[shaft]; }
  // Adds the element's range of torque at standstill to that of its shaft.
  void add_hold(const Hold& own, Hold* of_shaft) const {
    of_shaft[shaft].low += gain * (gain < 0 ? own.high : own.low);
    of_shaft[shaft].high += gain * (gain < 0 ? own.low : own.high);
  }
};

// Data of an element that a pool rarely needs.
struct ShaftElementLabel {
  Window window;
  std::string component;
};

template <class E>
class ShaftPool final : public ElementPool {
  static_assert(demand_valid_shaft_element<E>());
  static constexpr int internal_states = E::is.states;
  // Columns of the derivatives: ω, internal states, the angle.
  static constexpr std::size_t inputs = 1 + internal_states + (UsesAngle<E> ? 1 : 0);

 public:
  struct Placed {
    E element;
    ShaftPorts at;
    std::array<int, inputs> slot{};                                        // of the torque
    std::array<std::array<int, inputs>, internal_states> internal_slot{};  // of the rates of the internal states
  };
  void place(E element, const ShaftPorts& at, ShaftElementLabel label) {
    placed_.push_back({std::move(element), at});
    label_.push_back(std::move(label));
  }

  void add(const Instant& now, Sums& sums) const override {
    for (const Placed& p : placed_) {
      const ShaftState<double> x = state(p, now);
      const double torque = now.active[p.at.id] ? p.element.torque(x) : 0.0;
      sums.element_torque[p.at.id] = torque;
      sums.torque[p.at.shaft] += p.at.gain * torque;
      if constexpr (HasStates<E>) p.element.rates(x, sums.internal_rate + p.at.own);
      if (sums.work_rate) {
        if constexpr (E::is.stores)
          sums.work_rate[p.at.account] -= now.active[p.at.id] ? p.element.loss_power(x) : 0;
        else
          sums.work_rate[p.at.account] += torque * x.rate;
      }
    }
  }

  void register_jacobian(JacobianPattern& pattern) override {
    for (Placed& p : placed_) {
      const int speed = pattern.speed(p.at.shaft);
      std::array<int, inputs> column{};
      column[0] = speed;
      for (int k = 0; k < internal_states; ++k) column[static_cast<std::size_t>(1 + k)] = pattern.own(p.at.own + k);
      if constexpr (UsesAngle<E>) column[inputs - 1] = pattern.angle(p.at.angle);
      for (std::size_t k = 0; k < inputs; ++k) {
        p.slot[k] = pattern.entry(speed, column[k]);
        for (int i = 0; i < internal_states; ++i)
          p.internal_slot[static_cast<std::size_t>(i)][k] = pattern.entry(pattern.own(p.at.own + i), column[k]);
      }
    }
  }

  void add_jacobian(const Instant& now, const double*, double* slots) const override {
    using Number = Dual<static_cast<int>(inputs)>;
    for (const Placed& p : placed_) {
      const ShaftState<double> x = state(p, now);
      std::array<Number, internal_states + 1> own;
      for (int k = 0; k < internal_states; ++k) own[static_cast<std::size_t>(k)] = Number::input(x.own[k], 1 + k);
      ShaftState<Number> dual{x.t,  {},        Number::input(x.rate, 0), x.mode, x.direction, x.command, own.data(),
                              x.on, x.on_since};
      if constexpr (UsesAngle<E>) dual.angle = Number::input(x.angle, static_cast<int>(inputs) - 1);
      const auto scatter = [&](const Number& value, double gain, const std::array<int, inputs>& to) {
        slots[to[0]] += gain * value.d[0] * p.at.gain;
        for (std::size_t k = 1; k < inputs; ++k) slots[to[k]] += gain * value.d[k];
      };
      if (now.active[p.at.id]) scatter(p.element.torque(dual), p.at.gain, p.slot);
      if constexpr (HasStates<E>) {
        std::array<Number, internal_states> rate;
        p.element.rates(dual, rate.data());
        for (std::size_t k = 0; k < internal_states; ++k) scatter(rate[k], 1, p.internal_slot[k]);
      }
    }
  }

  int guard_count() const override {
    if constexpr (Guarded<E>) return static_cast<int>(placed_.size()) * E::is.guards;
    return 0;
  }
  bool guards_are_of_angle() const override {
    if constexpr (Guarded<E>)
      return UsesAngle<E> && std::none_of(placed_.begin(), placed_.end(), [](const Placed& p) {
               return p.element.uses_speed() || p.element.uses_time();
             });
    return true;
  }
  void guards(const Instant& now, double* g) const override {
    if constexpr (Guarded<E>)
      for (const Placed& p : placed_) {
        if (now.active[p.at.id] && !is_regularised(now.mode[p.at.mode])) {
          p.element.guard(state(p, now), g);
        } else {
          for (int i = 0; i < E::is.guards; ++i) g[i] = 1;
        }
        g += E::is.guards;
      }
  }
  void fire(const Instant& now, int guard, int* mode) const override {
    if constexpr (Guarded<E>) {
      const Placed& p = placed_[static_cast<std::size_t>(guard / E::is.guards)];
      mode[p.at.mode] = p.element.next_mode(state(p, now), guard % E::is.guards);
    }
  }
  GuardLabel label(int guard, const Instant& now) const override {
    if constexpr (Guarded<E>) {
      const Placed& p = placed_[static_cast<std::size_t>(guard / E::is.guards)];
      return {label_[static_cast<std::size_t>(guard / E::is.guards)].component,
              p.element.mode_name(now.mode[p.at.mode])};
    }
    return {};
  }
  void first_modes(const Instant& now, int* mode) const override {
    if constexpr (Guarded<E>)
      for (const Placed& p : placed_)
        if (!is_regularised(mode[p.at.mode])) mode[p.at.mode] = p.element.first_mode(state(p, now));
  }
  void follow_directions(const Instant& now, int* mode) const override {
    if constexpr (Directional<E>) first_modes(now, mode);
  }
  bool regularise(int guard, int* mode) const override {
    if constexpr (E::is.regularised_mode.has_value()) {
      mode[placed_[static_cast<std::size_t>(guard / E::is.guards)].at.mode] = *E::is.regularised_mode;
      return true;
    }
    return false;
  }
  void first_states(const Instant& now, double* own) const override {
    if constexpr (HasStates<E>)
      for (const Placed& p : placed_) p.element.first_states(state(p, now), own + p.at.own);
  }
  void switched(const Instant& now, const char* before, double* own) const override {
    if constexpr (E::is.feels_switching)
      for (const Placed& p : placed_)
        if (now.active[p.at.id] != before[p.at.id]) p.element.switched(state(p, now), own + p.at.own);
  }
  void start_anew(const Instant& now, const char* before, int* mode) const override {
    if constexpr (E::is.starts_anew)
      for (const Placed& p : placed_)
        if (now.active[p.at.id] && !before[p.at.id]) mode[p.at.mode] = p.element.mode_anew(state(p, now));
  }
  void add_holds(const Instant& now, Hold* shaft, Hold* element) const override {
    if constexpr (Directional<E>)
      for (const Placed& p : placed_) {
        if (!now.active[p.at.id]) continue;
        const Hold hold = p.element.hold(state(p, now));
        element[p.at.id] = hold;
        p.at.add_hold(hold, shaft);
      }
  }
  double next_edge(double t) const override {
    double next = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      if (label_[i].window.start > t) next = std::min(next, label_[i].window.start);
      if (label_[i].window.stop > t) next = std::min(next, label_[i].window.stop);
      if constexpr (Timed<E>) next = std::min(next, placed_[i].element.next_edge(t));
    }
    return next;
  }
  void set_timed_modes(double t, int* mode, char* active) const override {
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      const Placed& p = placed_[i];
      active[p.at.id] = t >= label_[i].window.start && t < label_[i].window.stop;
      if constexpr (Timed<E>) mode[p.at.mode] = p.element.mode_at(t);
    }
  }

  double energy(const Instant& now) const override {
    double sum = 0;
    if constexpr (E::is.stores)
      for (const Placed& p : placed_) sum += p.element.stored(now.own + p.at.own);
    return sum;
  }

 private:
  static bool is_regularised(int mode) {
    if constexpr (E::is.regularised_mode.has_value()) return mode == *E::is.regularised_mode;
    return false;
  }
  ShaftState<double> state(const Placed& p, const Instant& now) const {
    double angle = 0;
    if constexpr (UsesAngle<E>) angle = now.angle[p.at.angle] + p.at.phase;
    ShaftState<double> x{now.t, angle, p.at.gain * now.speed[p.at.shaft], now.mode[p.at.mode], p.at.direction(now)};
    if constexpr (HasStates<E>) x.own = now.own + p.at.own;
    x.on = now.active[p.at.id] != 0;
    if constexpr (E::is.starts_anew) x.on_since = now.on_since[p.at.id];
    if constexpr (Commanded<E>)
      if (p.at.command >= 0) x.command = now.command[p.at.command];
    return x;
  }

  std::vector<Placed> placed_;
  std::vector<ShaftElementLabel> label_;
};

}  // namespace kurbel
