// element.h — what an element is: a few equations over its local motion. It knows no indices, solvers or files.
//
// What it is able to do it says once, as traits by name; the members that belong to each are told here, and checked where
// it comes into a pool (sound.h): one that is missing, of another form, or there without its trait is a compile error.
//   static constexpr ConnectionTraits is{.slips = true, .commanded = true};
//
// A **connection** joins two shafts a and b. Twist θ = φ_a − i φ_b; its torque τ acts as −τ on a and +i τ on b
// (theory 1.2): positive τ drives b and brakes a.
//   template <class T> T torque(const Twist<T>&) const;      transmitted torque τ [N·m], spring and damper
//   double spring_torque(double twist) const;                elastic part [N·m]
//   double twist_at(double torque) const;                    twist that carries this torque at rest [rad]; where that
//                                                            hangs on φ_a, (double torque, double turn), too
//   double energy(double twist) const;                       stored [J]
//   double stiffness_at_rest() const;                        [N·m/rad]
//
// .slips        (clutch, one-way clutch, belt) There is no spring. While it is stuck its two shafts turn as one and τ is
//               whatever that takes; torque() is asked for while it slips, in the sense x.direction of θ̇.
//     Hold hold(const Twist<double>&) const;                 range of τ that it can carry without slipping [N·m]
//     double capacity() const;                               order of magnitude of that range [N·m]
// .springless   (viscous film, fluid coupling) No spring either, and it never sticks: torque() is all, and all that it
//               takes is lost. It stays, whatever elasticity is on.
// .uses_angle   of a: x.turn
//     template <class T> T turning_torque(x) const;          further torque on a; of a spring −∂E/∂φ_a
// .uses_speeds  x.turn_rate, so that ω_b = (ω_a − θ̇)/i
// .turns_unevenly, with uses_angle
//     double rest_twist(double turn) const;                  its twist unloaded at φ_a; of others 0
//     double rest_ratio(double turn) const;                  and then i ω_b/ω_a; of others 1
//     double rest_ratio_slope(double turn) const;            its derivative by φ_a; of others 0
// .spring_takes_motion  spring_torque and energy take x in place of the twist: with states or an angle always
// .tells_loss   with states always
//     double loss_power(x) const;                            its power −dE/dt; of others (τ − spring torque) θ̇
//
// A **shaft element** sits on one shaft and exerts a torque M on it, positive in the direction of positive rotation.
//   template <class T> T torque(const ShaftState<T>&) const;
//   Rated rated() const;                                     orders of magnitude for error scales
//   bool uses_time() const; bool uses_speed() const;         whether M depends on t, on ω
// .account = a  which line of the energy balance its work belongs to; where that hangs on the use, the line is a member:
//     Account work_account;
// .directional  opposes motion
//     Hold hold(x) const;                                    what it can exert at standstill [N·m]
// .uses_angle   x.angle
//     double angle_period() const;                           M repeats after this angle of its own shaft [rad]
// .timed        piecewise over time
//     double next_edge(double t) const;                      [s]
//     int mode_at(double t) const;
// .periodic
//     double time_period() const;                            M over time repeats after this [s]; 0: it does not
// .settles
//     double settled_from() const;                           its law over time holds still from here on, of what starts
//                                                            anew so long after it went on [s]
// .stores       energy in its states
//     double stored(const double* own) const;                [J]
//     double loss_power(x) const;                            −M ω − dE/dt
// .feels_switching, with states
//     void switched(x, double* own) const;                   it went on or off (x.on)
// .starts_anew, with guards: whenever it goes on its start begins again; it reads x.on_since
//     int mode_anew(x) const;                                mode in which it goes on, its own states as switched
//
// Either may be, with x its local motion (Twist or ShaftState):
// .guards = n   piecewise
//     void guard(x, double* g) const;                        n values of order 1, positive while x.mode holds
//     int first_mode(x) const;                               mode for a state from nowhere
//     int next_mode(x, int which) const;                     after guard `which` fell through zero
//     std::string mode_name(int mode) const;                 for the list of events; empty: not worth telling
// .regularised_mode = m, with guards: a mode without guards, for events that find no rest
// .states = n   states of its own, x.own[0 … n−1]
//     template <class T> void rates(const X<T>& x, T* rate) const;   their time derivatives
//     void first_states(x, double* own) const;               at the start
//     OwnState state(int k) const;                           its name, unit and order of magnitude
// .commanded    an operating sequence sets x.command (1 unless told); of a shaft element:
//     bool opens_at_zero() const;                            told 0 it is off, as outside its window; on the way through
//                                                            0 it is not
//   .reversible   it may be told less than 0
// .described
//     std::string describe() const;                          for people: the law it follows
// .other_forms  A free function beside it tells what it becomes under effects; null: nothing else.
//     ConnectionForm under(const E&, const Effects&);        ShaftForm of a shaft element
//
// A connection whose damping hangs on the inertias that it joins is given as a **specification** that becomes one:
//   using Element = E;
//   E settled(double inertia) const;                         J_red [kg·m²]; 0: none is known
//   bool damping_hangs_on_inertia() const;                   so that without one it is not defined
//   static constexpr bool other_forms = true;                if so; as above
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "engine/base/enumerators.h"

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
  double on_since = 0;     // of what starts anew: it went on last [s]
};

// A state of its own that an element brings.
struct OwnState {
  std::string name;   // "current"
  std::string unit;   // SI
  double scale = 1;   // order of magnitude, for error control
  bool peak = false;  // its extreme is a figure of every run
  bool lags = false;  // follows a law of the present motion; at a constant one it is at the law's value
};

// Lines of the energy balance. Useful work goes into the process; harmful work is friction and damping.
enum class Account { driving, useful, harmful, weight };
inline constexpr std::array all_accounts = {Account::driving, Account::useful, Account::harmful, Account::weight};
inline const char* name_of(Account account) { return enumerator_name<Account::weight>(account); }

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
  double first_on() const { return start > Window{}.start ? start : 0; }
};

// What a connection is; the members that belong to each are told above.
struct ConnectionTraits {
  bool slips = false;
  bool springless = false;
  bool commanded = false;
  bool uses_angle = false;
  bool uses_speeds = false;
  bool turns_unevenly = false;
  bool spring_takes_motion = false;
  bool tells_loss = false;
  int guards = 0;
  std::optional<int> regularised_mode = {};
  int states = 0;
  bool described = false;
  bool other_forms = false;

  constexpr bool has_spring() const { return !slips && !springless; }
};

// What a shaft element is.
struct ShaftTraits {
  std::optional<Account> account = {};
  bool directional = false;
  bool commanded = false;
  bool reversible = false;
  bool uses_angle = false;
  bool timed = false;
  bool periodic = false;
  bool settles = false;
  int guards = 0;
  std::optional<int> regularised_mode = {};
  int states = 0;
  bool stores = false;
  bool feels_switching = false;
  bool starts_anew = false;
  bool described = false;
  bool other_forms = false;
};

template <class E>
concept UsesAngle = bool(E::is.uses_angle);
template <class E>
concept Directional = bool(E::is.directional);
template <class E>
concept Guarded = (E::is.guards > 0);
template <class E>
concept Slipping = bool(E::is.slips);
template <class E>
concept UsesSpeeds = bool(E::is.uses_speeds);
template <class E>
concept HasStates = (E::is.states > 0);
template <class E>
concept Commanded = bool(E::is.commanded);
template <class E>
concept Timed = bool(E::is.timed);

// An element of any type, as a network holds it (engine/model).
class AnyConnection;
class AnyShaftElement;
using ConnectionForm = std::shared_ptr<const AnyConnection>;
using ShaftForm = std::shared_ptr<const AnyShaftElement>;
struct Effects;

}  // namespace kurbel
