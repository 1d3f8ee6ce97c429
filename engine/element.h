// element.h — what an element is: a few equations over its local motion. It knows no indices, solvers or files.
//
// A **connection** joins two shafts a and b. Twist θ = φ_a − i φ_b; its torque τ acts as −τ on a and +i τ on b
// (THEORY 5): positive τ drives b and brakes a.
//   template <class T> T torque(const Twist<T>&) const;      transmitted torque τ [N·m], spring and damper
//   double spring_torque(double twist) const;                elastic part [N·m]
//   double twist_at(double torque) const;                    twist that carries this torque at rest [rad]
//   double energy(double twist) const;                       stored [J]
//   double stiffness_at_rest() const;                        [N·m/rad]
//
// A **shaft element** sits on one shaft and exerts a torque M on it, positive in the direction of positive rotation.
//   template <class T> T torque(const ShaftState<T>&) const;
//   static constexpr Account account;                        which line of the energy balance its work belongs to
//   Rated rated() const;                                     orders of magnitude for error scales
//   static constexpr bool uses_angle = true;                 optional: depends on the angle
//   static constexpr bool directional = true;                optional: opposes motion; then Hold hold(state) const
//   static constexpr int guards = n;                         optional: piecewise; then first_mode, guard, next_mode
//   double next_edge(double t) const; int mode_at(double t)  optional: piecewise over time
//   bool uses_time() const; bool uses_speed() const;         optional: whether M depends on t, on ω; unsaid: it does
#pragma once

#include <string>

namespace kurbel {

template <class T>
struct Twist {
  T angle{};  // θ [rad]
  T rate{};   // θ̇ [rad/s]
};

template <class T>
struct ShaftState {
  double t = 0;       // [s]
  T angle{};          // φ of the shaft that the element sits on [rad], turns removed
  T rate{};           // ω [rad/s]
  int mode = 0;       // piece of a piecewise law, fixed between events
  int direction = 1;  // sign of ω, fixed between events; 0 = at standstill
};

// Lines of the energy balance. Useful work goes into the process; harmful work is friction and damping.
enum class Account { driving, useful, harmful, weight };
inline const char* name_of(Account account) {
  switch (account) {
    case Account::driving:
      return "driving";
    case Account::useful:
      return "useful";
    case Account::harmful:
      return "harmful";
    case Account::weight:
      return "weight";
  }
  return "";
}

// Orders of magnitude that scale errors and tolerances; 0 = the element cannot tell.
struct Rated {
  double torque = 0;  // [N·m]
  double speed = 0;   // [rad/s]
};

// Range of torques that an element that opposes motion can exert at standstill.
struct Hold {
  double low = 0, high = 0;  // [N·m], low ≤ 0 ≤ high
};

// When a source or load acts.
struct Window {
  double start = -1e300, stop = 1e300;  // [s]
};

template <class E>
concept UsesAngle = requires {
  requires E::uses_angle;
};
template <class E>
concept Directional = requires {
  requires E::directional;
};
template <class E>
concept Guarded = requires {
  E::guards;
};
template <class E>
concept Timed = requires(const E& e) {
  e.next_edge(0.0);
};

// What a torque depends on, as the element says; one that does not say counts as depending on everything.
template <class E>
bool depends_on_time(const E& element) {
  if constexpr (requires { element.uses_time(); })
    return element.uses_time();
  else
    return true;
}
template <class E>
bool depends_on_speed(const E& element) {
  if constexpr (requires { element.uses_speed(); })
    return element.uses_speed();
  else
    return true;
}

}  // namespace kurbel
