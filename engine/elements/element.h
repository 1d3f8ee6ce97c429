// element.h — an element consists of a few equations over its local motion, without indices, solvers or files.
//
// It declares its capabilities once, as named traits. The members of each trait are listed here and checked when the
// element is put into a pool (sound.h): a missing member, another signature or a member without its trait is a compile error.
//   static constexpr ConnectionTraits is{.slips = true, .commanded = true};
//
// A **connection** joins two shafts a and b. Twist θ = φ_a − i φ_b; its torque τ acts as −τ on a and +i τ on b
// (theory 1.2): positive τ drives b and brakes a.
//   template <class T> T torque(const Twist<T>&) const;      transmitted torque τ [N·m], spring and damper
//   double spring_torque(double twist) const;                elastic part [N·m]
//   double twist_at(double torque) const;                    twist with this torque at rest [rad]; if it depends on φ_a,
//                                                            also (double torque, double turn)
//   double energy(double twist) const;                       stored [J]
//   double stiffness_at_rest() const;                        [N·m/rad]
//
// .slips        (clutch, one-way clutch, belt) No spring. While it is stuck, both shafts turn as one and τ is the constraint
//               torque; torque() is evaluated while it slips, with the sign x.direction of θ̇.
//     Hold hold(const Twist<double>&) const;                 range of τ that it can carry without slipping [N·m]
//     double capacity() const;                               order of magnitude of that range [N·m]
// .springless   (viscous film, fluid coupling) No spring, and it never sticks: it has only torque(), whose power is lost. It
//               is kept whatever elasticity is on.
// .uses_angle   of a: x.turn
//     template <class T> T turning_torque(x) const;          additional torque on a; for a spring −∂E/∂φ_a
// .uses_speeds  x.turn_rate, so that ω_b = (ω_a − θ̇)/i
// .turns_unevenly, with uses_angle
//     double rest_twist(double turn) const;                  its twist without load at φ_a; default 0
//     double rest_ratio(double turn) const;                  i ω_b/ω_a without load; default 1
//     double rest_ratio_slope(double turn) const;            derivative of rest_ratio by φ_a; default 0
// .spring_takes_motion  spring_torque and energy take x instead of the twist; required with states or an angle
// .reports_loss   required with states
//     double loss_power(x) const;                            its power −dE/dt; default (τ − spring torque) θ̇
//
// A **shaft element** sits on one shaft and exerts a torque M on it, positive in the direction of positive rotation.
//   template <class T> T torque(const ShaftState<T>&) const;
//   Rated rated() const;                                     orders of magnitude for error scales
//   bool uses_time() const; bool uses_speed() const;         whether M depends on t, on ω
// .account = a  line of the energy balance for its work; if the line depends on the use, it is a member instead:
//     Account work_account;
// .directional  opposes motion
//     Hold hold(x) const;                                    range of torque at standstill [N·m]
// .uses_angle   x.angle
//     double angle_period() const;                           period of M over the angle of its own shaft [rad]
// .timed        piecewise over time
//     double next_edge(double t) const;                      [s]
//     int mode_at(double t) const;
// .periodic
//     double time_period() const;                            period of M over time [s]; 0: not periodic
// .settles
//     double settled_from() const;                           time from which its law is constant; with .starts_anew the
//                                                            time after switching on [s]
// .stores       energy in its states
//     double stored(const double* own) const;                [J]
//     double loss_power(x) const;                            −M ω − dE/dt
// .feels_switching, with states
//     void switched(x, double* own) const;                   sets the states after switching on or off (x.on)
// .starts_anew, with guards: each time it is switched on, its start is repeated; it reads x.on_since
//     int mode_anew(x) const;                                mode after switching on, after switched()
//
// Traits of both, with x the local motion (Twist or ShaftState):
// .guards = n   piecewise
//     void guard(x, double* g) const;                        n values of order 1, positive while x.mode holds
//     int first_mode(x) const;                               mode for a state without history
//     int next_mode(x, int which) const;                     after guard `which` fell through zero
//     std::string mode_name(int mode) const;                 for the list of events; empty: not listed
// .regularised_mode = m, with guards: a mode without guards, used if events chatter
// .contact_modes, with guards, of a connection: its modes are −1, 0 and 1, slip backwards, grip and slip forwards of a
//     friction contact between an internal state and a shaft; its events are those of contacts, lock and slip
// .states = n   internal states x.own[0 … n−1]
//     template <class T> void rates(const X<T>& x, T* rate) const;   their time derivatives
//     void first_states(x, double* own) const;               at the start
//     InternalState state(int k) const;                           its name, unit and order of magnitude
// .commanded    an operating sequence sets x.command (default 1); for a shaft element:
//     bool opens_at_zero() const;                            command 0 switches it off, as outside its window; a ramp
//                                                            through 0 does not
//   .reversible   commands < 0 are allowed
// .described
//     std::string describe() const;                          description of its law, for reports
// .other_forms  A free function gives its form under the effects; null: unchanged.
//     ConnectionForm under(const E&, const Effects&);        ShaftForm for a shaft element
//
// A connection whose damping depends on the inertias on both sides is given as a **specification**, which becomes one:
//   using Element = E;
//   E settled(double inertia) const;                         J_red [kg·m²]; 0: unknown
//   bool damping_hangs_on_inertia() const;                   its damping is undefined without the inertia
//   static constexpr bool other_forms = true;                optional; as above
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
  int direction = 1;       // sign of the slip speed, fixed between events; 0 = stuck
  double command = 1;      // command of the operating sequence
  const T* own = nullptr;  // states of the element
  T turn{};                // φ_a, if the element uses the angle [rad], without full turns
  T turn_rate{};           // ω_a, if the element uses the speeds [rad/s]
};

template <class T>
struct ShaftState {
  double t = 0;            // [s]
  T angle{};               // φ of the element's shaft [rad], without full turns
  T rate{};                // ω [rad/s]
  int mode = 0;            // piece of a piecewise law, fixed between events
  int direction = 1;       // sign of ω, fixed between events; 0 = at standstill
  double command = 1;      // command of the operating sequence
  const T* own = nullptr;  // states of the element
  bool on = true;          // within its window of time and not switched off; else its torque is zero
  double on_since = 0;     // with .starts_anew: time of the last switching on [s]
};

// An internal state of an element.
struct InternalState {
  std::string name;   // "current"
  std::string unit;   // SI
  double scale = 1;   // order of magnitude, for error control; 0: the twist of its joint under the rated torque
  bool peak = false;  // its extreme is a figure of every run
  bool lags = false;  // follows a law of the present motion; equals the law in constant motion
};

// Lines of the energy balance. Useful work goes into the process; harmful work is friction and damping.
enum class Account { driving, useful, harmful, weight };
inline constexpr std::array all_accounts = {Account::driving, Account::useful, Account::harmful, Account::weight};
inline const char* name_of(Account account) { return enumerator_name<Account::weight>(account); }

// Orders of magnitude for scales of errors and tolerances; 0 = unknown to the element.
struct Rated {
  double torque = 0;  // [N·m]
  double speed = 0;   // [rad/s]
};

// Range of the torque at standstill of an element that opposes motion.
struct Hold {
  double low = 0, high = 0;  // [N·m], low ≤ 0 ≤ high
};

// Time window in which a source or load acts.
struct Window {
  double start = -1e300, stop = 1e300;  // [s]
  double first_on() const { return start > Window{}.start ? start : 0; }
};

// Traits of a connection; the members of each are listed above.
struct ConnectionTraits {
  bool slips = false;
  bool springless = false;
  bool commanded = false;
  bool uses_angle = false;
  bool uses_speeds = false;
  bool turns_unevenly = false;
  bool spring_takes_motion = false;
  bool reports_loss = false;
  int guards = 0;
  std::optional<int> regularised_mode = {};
  bool contact_modes = false;
  int states = 0;
  bool described = false;
  bool other_forms = false;

  constexpr bool has_spring() const { return !slips && !springless; }
};

// Traits of a shaft element.
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
concept ContactModes = bool(E::is.contact_modes);
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

// Type-erased elements of a network (engine/model).
class AnyConnection;
class AnyShaftElement;
using ConnectionForm = std::shared_ptr<const AnyConnection>;
using ShaftForm = std::shared_ptr<const AnyShaftElement>;
struct Effects;

}  // namespace kurbel
