// element_pool.h — all elements of one type, evaluated in one loop behind one virtual call. No element, no pool, no
// cost.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "engine/dual.h"
#include "engine/element.h"

namespace kurbel {

// Where the machine is. Arrays belong to the equations.
struct Instant {
  double t;
  const double* angle;   // per tracked angle
  const double* twist;   // per elastic connection
  const double* speed;   // per shaft
  const int* mode;       // per element
  const int* direction;  // per shaft
  const char* active;    // per element: within its window of time
};

// What the elements do to the machine at that instant.
struct Sums {
  double* torque;             // per shaft: sum of torques
  double* inertia;            // per shaft: variable inertias are added to the constant ones
  double* twist_rate;         // per elastic connection
  double* connection_torque;  // per elastic connection: transmitted torque k θ + c θ̇
  double* spring_torque;      // per elastic connection: spring torque k θ; written only when work_rate is wanted
  double* element_torque;     // per shaft element
  double* element_inertia;    // per shaft element: its variable inertia
  double* work_rate;          // per work account, or null where nobody asks
};

// Registers the places of a sparse Jacobian; a column or row of −1 is a motion that is no state.
class JacobianPattern {
 public:
  virtual ~JacobianPattern() = default;
  virtual int entry(int row, int column) = 0;  // slot to add the derivative to
  virtual int angle(int tracked) const = 0;    // state indices
  virtual int twist(int connection) const = 0;
  virtual int speed(int shaft) const = 0;  // −1: prescribed
};

// Everything that can be asked of the machine at one instant. Pointers are valid until the next evaluation.
struct Snapshot {
  Instant now;
  Sums sums;
  const double* alpha;         // per shaft [rad/s²]
  const double* joint_torque;  // per joint of the network: torque that it transmits [N·m]
  const double* node_angle;    // per node, turns counted [rad]
  const double* quadrature;    // null without an audit
};

// One quantity that a run can record.
struct Channel {
  std::string name;  // "torque.main_coupling"
  std::string unit;  // SI
  std::function<double(const Snapshot&)> value;
};

// Torques that depend on the accelerations: added to what the elements do without them.
struct Reactions {
  double* torque;          // per shaft [N·m]
  double* slope;           // per shaft: −∂torque/∂alpha, counts as inertia [kg·m²]
  double* element_torque;  // per shaft element
  double* work_rate;       // per work account, or null
};

struct GuardLabel {
  std::string component, what;  // what happens when it fires
};

class ElementPool {
 public:
  virtual ~ElementPool() = default;
  virtual void add(const Instant& now, Sums& sums) const = 0;
  virtual void register_jacobian(JacobianPattern& pattern) = 0;
  // Adds ∂(sum of torques − inertia · alpha)/∂(state) to the slots, at the accelerations alpha per shaft.
  virtual void add_jacobian(const Instant& now, const double* alpha, double* slots) const = 0;

  // Joint friction and the like: torques at the accelerations alpha per shaft; the equations find both together.
  virtual bool reacts() const { return false; }
  virtual void add_reactions(const Instant&, const double* /*alpha*/, Reactions&) const {}

  virtual int guard_count() const { return 0; }
  // Every law of the pool changes at fixed angles of its shaft alone, for either direction: load edges.
  virtual bool guards_are_of_angle() const { return guard_count() == 0; }
  // Positive while the present modes hold, of order one.
  virtual void guards(const Instant&, double*) const {}
  virtual void fire(const Instant&, int /*guard*/, int* /*mode*/) const {}
  virtual GuardLabel label(int /*guard*/, const int* /*mode*/) const { return {}; }
  virtual void first_modes(const Instant&, int* /*mode*/) const {}
  // Torques at standstill: what the opposing elements of each shaft can hold.
  virtual void add_holds(const Instant&, Hold* /*per shaft*/, Hold* /*per element*/) const {}
  // Edges at known times.
  virtual double next_edge(double /*t*/) const { return std::numeric_limits<double>::infinity(); }
  virtual void set_timed_modes(double /*t*/, int* /*mode*/, char* /*active*/) const {}
  // Energy stored in the elements.
  virtual double energy(const Instant&) const { return 0; }
  // Kinetic energy of the variable inertias, found in another way than from I_r: a check of the reduction.
  virtual double kinetic_energy_of_bodies(const Instant&) const { return 0; }
  virtual void add_channels(std::vector<Channel>&) const {}
};

// Where an element of the pool is connected.
struct ConnectionPorts {
  int id = 0;  // index of the twist
  int shaft_a = 0, shaft_b = 0;
  double gain_a = 1, gain_b = 1;  // θ̇ = gain_a ω_a − gain_b ω_b
  int loss_account = 0;
};

struct ShaftPorts {
  int id = 0;    // index among shaft elements
  int mode = 0;  // first of its mode slots
  int shaft = 0;
  double gain = 1;  // speed of the element's own shaft over that of the merged one
  int angle = -1;   // tracked angle
  int angle_shaft = 0;
  double phase = 0;  // added to the tracked angle [rad]
  int account = 0;
};

// What a pool needs of an element only now and then.
struct ShaftElementLabel {
  Window window;
  std::string component;
};

template <class E>
class ConnectionPool final : public ElementPool {
 public:
  // Long chains are bound by memory: what every step needs stands close together, Jacobian slots apart.
  struct Placed {
    E element;
    ConnectionPorts at;
  };
  void place(E element, ConnectionPorts at) { placed_.push_back({std::move(element), at}); }

  void add(const Instant& now, Sums& sums) const override {
    if (sums.work_rate) return add_with_work(now, sums);
    for (const Placed& p : placed_) {
      const Twist<double> x = motion(p, now);
      const double tau = p.element.torque(x);
      sums.twist_rate[p.at.id] = x.rate;
      sums.connection_torque[p.at.id] = tau;
      sums.torque[p.at.shaft_a] -= p.at.gain_a * tau;
      sums.torque[p.at.shaft_b] += p.at.gain_b * tau;
    }
  }

  void register_jacobian(JacobianPattern& pattern) override {
    slots_.clear();
    for (const Placed& p : placed_) {
      const int theta = pattern.twist(p.at.id), a = pattern.speed(p.at.shaft_a), b = pattern.speed(p.at.shaft_b);
      slots_.push_back({pattern.entry(a, theta), pattern.entry(a, a), pattern.entry(a, b), pattern.entry(b, theta),
                        pattern.entry(b, a), pattern.entry(b, b)});
    }
  }

  void add_jacobian(const Instant& now, const double*, double* slots) const override {
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      const Placed& p = placed_[i];
      const std::array<int, 6>& slot = slots_[i];
      const Twist<double> x = motion(p, now);
      const auto tau = p.element.torque(Twist<Dual<2>>{Dual<2>::input(x.angle, 0), Dual<2>::input(x.rate, 1)});
      const double ga = p.at.gain_a, gb = p.at.gain_b, by_angle = tau.d[0], by_rate = tau.d[1];
      slots[slot[0]] -= ga * by_angle;
      slots[slot[1]] -= ga * by_rate * ga;
      slots[slot[2]] += ga * by_rate * gb;
      slots[slot[3]] += gb * by_angle;
      slots[slot[4]] += gb * by_rate * ga;
      slots[slot[5]] -= gb * by_rate * gb;
    }
  }

  double energy(const Instant& now) const override {
    double sum = 0;
    for (const Placed& p : placed_) sum += p.element.energy(now.twist[p.at.id]);
    return sum;
  }

 private:
  static Twist<double> motion(const Placed& p, const Instant& now) {
    return {now.twist[p.at.id], p.at.gain_a * now.speed[p.at.shaft_a] - p.at.gain_b * now.speed[p.at.shaft_b]};
  }
  void add_with_work(const Instant& now, Sums& sums) const {
    for (const Placed& p : placed_) {
      const Twist<double> x = motion(p, now);
      const double tau = p.element.torque(x), spring = p.element.spring_torque(x.angle);
      sums.twist_rate[p.at.id] = x.rate;
      sums.connection_torque[p.at.id] = tau;
      sums.spring_torque[p.at.id] = spring;
      sums.torque[p.at.shaft_a] -= p.at.gain_a * tau;
      sums.torque[p.at.shaft_b] += p.at.gain_b * tau;
      sums.work_rate[p.at.loss_account] -= (tau - spring) * x.rate;
    }
  }

  std::vector<Placed> placed_;
  std::vector<std::array<int, 6>> slots_;
};

template <class E>
class ShaftPool final : public ElementPool {
 public:
  struct Placed {
    E element;
    ShaftPorts at;
    int slot_angle = 0, slot_rate = 0;
  };
  void place(E element, const ShaftPorts& at, ShaftElementLabel label) {
    placed_.push_back({std::move(element), at, 0, 0});
    label_.push_back(std::move(label));
  }

  void add(const Instant& now, Sums& sums) const override {
    for (const Placed& p : placed_) {
      const ShaftState<double> x = state(p, now);
      const double torque = now.active[p.at.id] ? p.element.torque(x) : 0.0;
      sums.element_torque[p.at.id] = torque;
      sums.torque[p.at.shaft] += p.at.gain * torque;
      if (sums.work_rate) sums.work_rate[p.at.account] += torque * x.rate;
    }
  }

  void register_jacobian(JacobianPattern& pattern) override {
    for (Placed& p : placed_) {
      const int speed = pattern.speed(p.at.shaft);
      if constexpr (UsesAngle<E>) p.slot_angle = pattern.entry(speed, pattern.angle(p.at.angle));
      p.slot_rate = pattern.entry(speed, speed);
    }
  }

  void add_jacobian(const Instant& now, const double*, double* slots) const override {
    for (const Placed& p : placed_) {
      if (!now.active[p.at.id]) continue;
      const ShaftState<double> x = state(p, now);
      const auto torque = p.element.torque(
          ShaftState<Dual<2>>{x.t, Dual<2>::input(x.angle, 0), Dual<2>::input(x.rate, 1), x.mode, x.direction});
      if constexpr (UsesAngle<E>) slots[p.slot_angle] += p.at.gain * torque.d[0];
      slots[p.slot_rate] += p.at.gain * torque.d[1] * p.at.gain;
    }
  }

  int guard_count() const override {
    if constexpr (Guarded<E>) return static_cast<int>(placed_.size()) * E::guards;
    return 0;
  }
  bool guards_are_of_angle() const override {
    if constexpr (Guarded<E>)
      return UsesAngle<E> && std::none_of(placed_.begin(), placed_.end(), [](const Placed& p) {
               return depends_on_speed(p.element) || depends_on_time(p.element);
             });
    return true;
  }
  void guards(const Instant& now, double* g) const override {
    if constexpr (Guarded<E>)
      for (const Placed& p : placed_) {
        if (now.active[p.at.id]) {
          p.element.guard(state(p, now), g);
        } else {
          for (int i = 0; i < E::guards; ++i) g[i] = 1;
        }
        g += E::guards;
      }
  }
  void fire(const Instant& now, int guard, int* mode) const override {
    if constexpr (Guarded<E>) {
      const Placed& p = placed_[static_cast<std::size_t>(guard / E::guards)];
      mode[p.at.mode] = p.element.next_mode(state(p, now), guard % E::guards);
    }
  }
  GuardLabel label(int guard, const int* mode) const override {
    if constexpr (Guarded<E>) {
      const Placed& p = placed_[static_cast<std::size_t>(guard / E::guards)];
      return {label_[static_cast<std::size_t>(guard / E::guards)].component, p.element.mode_name(mode[p.at.mode])};
    }
    return {};
  }
  void first_modes(const Instant& now, int* mode) const override {
    if constexpr (Guarded<E>)
      for (const Placed& p : placed_) mode[p.at.mode] = p.element.first_mode(state(p, now));
  }
  void add_holds(const Instant& now, Hold* shaft, Hold* element) const override {
    if constexpr (Directional<E>)
      for (const Placed& p : placed_) {
        if (!now.active[p.at.id]) continue;
        const Hold hold = p.element.hold(state(p, now));
        element[p.at.id] = hold;
        shaft[p.at.shaft].low += p.at.gain * hold.low;
        shaft[p.at.shaft].high += p.at.gain * hold.high;
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

 private:
  ShaftState<double> state(const Placed& p, const Instant& now) const {
    double angle = 0;
    if constexpr (UsesAngle<E>) angle = now.angle[p.at.angle] + p.at.phase;
    return {now.t, angle, p.at.gain * now.speed[p.at.shaft], now.mode[p.at.mode], now.direction[p.at.shaft]};
  }

  std::vector<Placed> placed_;
  std::vector<ShaftElementLabel> label_;
};

}  // namespace kurbel
