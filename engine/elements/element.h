// element.h — what an element is: a few equations over its local motion. It knows no indices, solvers or files.
//
// A **connection** joins two shafts a and b. Twist θ = φ_a − i φ_b; its torque τ acts as −τ on a and +i τ on b
// (theory 1.2): positive τ drives b and brakes a.
//   template <class T> T torque(const Twist<T>&) const;      transmitted torque τ [N·m], spring and damper
//   double spring_torque(double twist) const;                elastic part [N·m]
//   double twist_at(double torque) const;                    twist that carries this torque at rest [rad]
//   double energy(double twist) const;                       stored [J]
//   double stiffness_at_rest() const;                        [N·m/rad]
//
// A **slipping connection** (clutch, one-way clutch, belt) has no spring. While it is stuck its two shafts turn as one
// and τ is whatever that takes; torque() is asked for while it slips, in the sense x.direction of θ̇.
//   static constexpr bool slips = true;
//   Hold hold(const Twist<double>&) const;                   range of τ that it can carry without slipping [N·m]
//   double capacity() const;                                 order of magnitude of that range [N·m]
//
// A **springless connection** (viscous film, fluid coupling) has no spring either, and never sticks: torque() is all.
//   static constexpr bool springless = true;                 it stays, whatever elasticity is on
//
// A **shaft element** sits on one shaft and exerts a torque M on it, positive in the direction of positive rotation.
//   template <class T> T torque(const ShaftState<T>&) const;
//   static constexpr Account account;                        which line of the energy balance its work belongs to
//   Rated rated() const;                                     orders of magnitude for error scales
//   static constexpr bool uses_angle = true;                 optional: depends on the angle
//   static constexpr bool directional = true;                optional: opposes motion; then Hold hold(state) const
//   double next_edge(double t) const; int mode_at(double t)  optional: piecewise over time
//   bool uses_time() const; bool uses_speed() const;         optional: whether M depends on t, on ω; unsaid: it does
//
// Either may have, with x its local motion (Twist or ShaftState):
//   static constexpr int guards = n;                         piecewise; then
//     void guard(x, double* g) const;                          n values of order 1, positive while x.mode holds
//     int first_mode(x) const;                                 mode for a state from nowhere
//     int next_mode(x, int which) const;                       after guard `which` fell through zero
//     std::string mode_name(int mode) const;                   for the list of events; empty: not worth telling
//   static constexpr int regularised_mode = m;               a mode without guards, for events that find no rest
//   static constexpr int states = n;                         states of its own, x.own[0 … n−1]; then
//     template <class T> void rates(const X<T>& x, T* rate) const;   their time derivatives
//     void first_states(x, double* own) const;                 at the start
//     OwnState state(int k) const;                             its name, unit and order of magnitude
//     double stored(const double* own) const;                  optional: energy in them [J]
//   double loss_power(x) const;                              of a connection with states or an angle: its power −dE/dt;
//                                                            its spring_torque and energy take x in place of the twist.
//                                                            Of a shaft element that stores: −M ω − dE/dt
//   void switched(x, double* own) const;                     of a shaft element with states: it went on or off (x.on)
//   double rest_twist(double turn) const;                    of a connection with uses_angle: its twist unloaded at φ_a
//   double rest_ratio(double turn) const;                    and then i ω_b/ω_a; unsaid: 0 and 1
//   static constexpr bool uses_speeds = true;                of a connection: x.turn_rate, so that ω_b = (ω_a − θ̇)/i
//   template <class T> T turning_torque(x) const;            of a connection with uses_angle: further torque on a,
//                                                            of a spring −∂E/∂φ_a
//   static constexpr bool commanded = true;                  an operating sequence sets x.command (1 unless told)
//     static constexpr bool reversible = true;                 of a shaft element: it may be told less than 0
//     bool opens_at_zero() const;                              of a shaft element: told 0 it is off, as outside its
//                                                              window; on the way through 0 it is not
#pragma once

#include <string>

namespace kurbel {

template <class T>
struct Twist {
  T angle{};               // θ [rad]
  T rate{};                // θ̇ [rad/s]
  double t = 0;            // [s]
  int mode = 0;            // piece of a piecewise law, fixed between events
  int direction = 1;       // sense of slip, fixed between events; 0 = stuck
  double command = 1;      // what an operating sequence says
  const T* own = nullptr;  // states of the element
  T turn{};                // φ_a, where the element uses the angle [rad], turns removed
  T turn_rate{};           // ω_a, where the element uses the speeds [rad/s]
};

template <class T>
struct ShaftState {
  double t = 0;            // [s]
  T angle{};               // φ of the shaft that the element sits on [rad], turns removed
  T rate{};                // ω [rad/s]
  int mode = 0;            // piece of a piecewise law, fixed between events
  int direction = 1;       // sign of ω, fixed between events; 0 = at standstill
  double command = 1;      // what an operating sequence says
  const T* own = nullptr;  // states of the element
  bool on = true;          // within its window of time, and not switched off; else its torque counts as nothing
};

// A state of its own that an element brings.
struct OwnState {
  std::string name;   // "current"
  std::string unit;   // SI
  double scale = 1;   // order of magnitude, for error control
  bool peak = false;  // its extreme is a figure of every run
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
concept Slipping = requires {
  requires E::slips;
};
template <class E>
concept Springless = requires {
  requires E::springless;
};
template <class E>
concept UsesSpeeds = requires {
  requires E::uses_speeds;
};
template <class E>
concept HasStates = requires {
  E::states;
};
template <class E>
concept Commanded = requires {
  requires E::commanded;
};
template <class E>
concept Reversible = requires {
  requires E::reversible;
};
template <class E>
concept Regularisable = requires {
  E::regularised_mode;
};
template <class E>
constexpr int states_of() {
  if constexpr (HasStates<E>)
    return E::states;
  else
    return 0;
}
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
