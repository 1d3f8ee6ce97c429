// sound.h — checks that an element has exactly the members required by its traits, with the right signatures.
//
// A misspelt member is missing, a member without its trait is found, and a misspelt trait is no member of ConnectionTraits
// or ShaftTraits. Members unknown to all traits (an element's own helpers) are allowed, as C++20 cannot list members.
// The type of an element is checked when it is put into a pool; -fconcepts-diagnostics-depth=3 shows what is missing.
#pragma once

#include <concepts>
#include <string>
#include <type_traits>

#include "engine/elements/element.h"
#include "engine/numerics/dual.h"

namespace kurbel {
namespace valid {

// All names of members of traits. A member of E with such a name (function, overload, template, data, private) makes
// &Free<E>::name ambiguous.
struct Names {
  int hold, capacity, spring_torque, energy, twist_at, stiffness_at_rest, turning_torque, rest_twist, rest_ratio,
      rest_ratio_slope;
  int loss_power, guard, first_mode, next_mode, mode_name, rates, first_states, state, describe;
  int work_account, angle_period, next_edge, mode_at, time_period, settled_from, stored, switched, mode_anew,
      opens_at_zero;
  int turned_mode;  // of a load on a mechanism's output
  // Traits are declared in `is`; a member with such a name would have no effect.
  int slips, springless, commanded, uses_angle, uses_speeds, turns_unevenly, spring_takes_motion, reports_loss;
  int guards, regularised_mode, contact_modes, states, described, other_forms;
  int account, directional, reversible, timed, periodic, settles, stores, feels_switching, starts_anew;
};
template <class E>
struct Free : E, Names {};

template <class E>
concept SaysTraitsInIs = requires {
  &Free<E>::slips;
  &Free<E>::springless;
  &Free<E>::commanded;
  &Free<E>::uses_angle;
  &Free<E>::uses_speeds;
  &Free<E>::turns_unevenly;
  &Free<E>::spring_takes_motion;
  &Free<E>::reports_loss;
  &Free<E>::guards;
  &Free<E>::regularised_mode;
  &Free<E>::contact_modes;
  &Free<E>::states;
  &Free<E>::described;
  &Free<E>::other_forms;
  &Free<E>::account;
  &Free<E>::directional;
  &Free<E>::reversible;
  &Free<E>::timed;
  &Free<E>::periodic;
  &Free<E>::settles;
  &Free<E>::stores;
  &Free<E>::feels_switching;
};

// --- for both; X: local motion, D: the same in dual numbers ---
template <class E, class X, class D>
concept Torque = requires(const E& e, const X& x, const D& dual) {
  { e.torque(x) } -> std::same_as<double>;
  { e.torque(dual) } -> std::same_as<Dual<1>>;
};
template <class E, class X>
concept Guards = (E::is.guards > 0 &&
                  requires(const E& e, const X& x, double* g) {
                    { e.guard(x, g) } -> std::same_as<void>;
                    { e.first_mode(x) } -> std::same_as<int>;
                    { e.next_mode(x, 0) } -> std::same_as<int>;
                    { e.mode_name(0) } -> std::same_as<std::string>;
                  }) ||
                 (E::is.guards == 0 && !E::is.regularised_mode && requires {
                   &Free<E>::guard;
                   &Free<E>::first_mode;
                   &Free<E>::next_mode;
                   &Free<E>::mode_name;
                 });
template <class E, class X, class D>
concept States = (E::is.states > 0 &&
                  requires(const E& e, const X& x, const D& dual, double* own, Dual<1>* rate) {
                    { e.rates(x, own) } -> std::same_as<void>;
                    { e.rates(dual, rate) } -> std::same_as<void>;
                    { e.first_states(x, own) } -> std::same_as<void>;
                    { e.state(0) } -> std::same_as<InternalState>;
                  }) ||
                 (E::is.states == 0 && requires {
                   &Free<E>::rates;
                   &Free<E>::first_states;
                   &Free<E>::state;
                 });
template <class E>
concept Described = (E::is.described &&
                     requires(const E& e) {
                       { e.describe() } -> std::convertible_to<std::string>;
                     }) ||
                    (!E::is.described && requires { &Free<E>::describe; });
template <class E, class Form>
concept FindsForms = requires(const E& e, const Effects& effects) {
  { under(e, effects) } -> std::same_as<Form>;
};
template <class E, class Form>
concept OtherForms = E::is.other_forms == FindsForms<E, Form>;

// --- of a connection ---
template <class E>
concept Slips = (E::is.slips && !E::is.springless &&
                 requires(const E& e, const Twist<double>& x) {
                   { e.hold(x) } -> std::same_as<Hold>;
                   { e.capacity() } -> std::same_as<double>;
                 }) ||
                (!E::is.slips && requires {
                  &Free<E>::hold;
                  &Free<E>::capacity;
                });
template <class E>
concept Spring = (E::is.has_spring() &&
                  requires(const E& e) {
                    { e.twist_at(1.0) } -> std::same_as<double>;
                    { e.stiffness_at_rest() } -> std::same_as<double>;
                  }) ||
                 (!E::is.has_spring() && requires {
                   &Free<E>::twist_at;
                   &Free<E>::stiffness_at_rest;
                   &Free<E>::spring_torque;
                   &Free<E>::energy;
                 });
template <class E>
concept SpringOfMotion = E::is.spring_takes_motion&& E::is.has_spring() &&
                         requires(const E& e, const Twist<double>& x) {
  { e.spring_torque(x) } -> std::same_as<double>;
  { e.energy(x) } -> std::same_as<double>;
};
template <class E>
concept SpringOfTwist = !E::is.spring_takes_motion && E::is.states == 0 && !E::is.uses_angle && requires(const E& e) {
  { e.spring_torque(1.0) } -> std::same_as<double>;
  { e.energy(1.0) } -> std::same_as<double>;
};
template <class E>
concept SpringTakes = SpringOfMotion<E> || SpringOfTwist<E> ||(!E::is.has_spring() && !E::is.spring_takes_motion);
template <class E>
concept ReportsLoss = (E::is.reports_loss && E::is.has_spring() &&
                       requires(const E& e, const Twist<double>& x) {
                         { e.loss_power(x) } -> std::same_as<double>;
                       }) ||
                      (!E::is.reports_loss && E::is.states == 0 && requires { &Free<E>::loss_power; });
template <class E>
concept UsesAngle = (E::is.uses_angle &&
                     requires(const E& e, const Twist<double>& x, const Twist<Dual<1>>& dual) {
                       { e.turning_torque(x) } -> std::same_as<double>;
                       { e.turning_torque(dual) } -> std::same_as<Dual<1>>;
                     }) ||
                    (!E::is.uses_angle && requires { &Free<E>::turning_torque; });
template <class E>
concept TurnsUnevenly = (E::is.turns_unevenly && E::is.uses_angle &&
                         requires(const E& e) {
                           { e.rest_twist(1.0) } -> std::same_as<double>;
                           { e.rest_ratio(1.0) } -> std::same_as<double>;
                           { e.rest_ratio_slope(1.0) } -> std::same_as<double>;
                         }) ||
                        (!E::is.turns_unevenly && requires {
                          &Free<E>::rest_twist;
                          &Free<E>::rest_ratio;
                          &Free<E>::rest_ratio_slope;
                        });
template <class E>
concept OfNoShaftElement = requires {
  &Free<E>::work_account;
  &Free<E>::angle_period;
  &Free<E>::next_edge;
  &Free<E>::mode_at;
  &Free<E>::time_period;
  &Free<E>::settled_from;
  &Free<E>::stored;
  &Free<E>::switched;
  &Free<E>::opens_at_zero;
};

// --- of a shaft element ---
template <class E>
concept Always = requires(const E& e) {
  { e.rated() } -> std::same_as<Rated>;
  { e.uses_time() } -> std::same_as<bool>;
  { e.uses_speed() } -> std::same_as<bool>;
};
template <class E>
concept HasAccount = (E::is.account.has_value() && requires { &Free<E>::work_account; }) ||
                     (!E::is.account.has_value() && requires(const E& e) {
                       { (e.work_account) } -> std::same_as<const Account&>;
                     });
template <class E>
concept Directional = (E::is.directional &&
                       requires(const E& e, const ShaftState<double>& x) {
                         { e.hold(x) } -> std::same_as<Hold>;
                       }) ||
                      (!E::is.directional && requires { &Free<E>::hold; });
template <class E>
concept Commanded = (E::is.commanded &&
                     requires(const E& e) {
                       { e.opens_at_zero() } -> std::same_as<bool>;
                     }) ||
                    (!E::is.commanded && !E::is.reversible && requires { &Free<E>::opens_at_zero; });
template <class E>
concept HasPeriodOfAngle = (E::is.uses_angle &&
                            requires(const E& e) {
                              { e.angle_period() } -> std::same_as<double>;
                            }) ||
                           (!E::is.uses_angle && requires { &Free<E>::angle_period; });
template <class E>
concept Timed = (E::is.timed &&
                 requires(const E& e) {
                   { e.next_edge(0.0) } -> std::same_as<double>;
                   { e.mode_at(0.0) } -> std::same_as<int>;
                 }) ||
                (!E::is.timed && requires {
                  &Free<E>::next_edge;
                  &Free<E>::mode_at;
                });
template <class E>
concept Periodic = (E::is.periodic &&
                    requires(const E& e) {
                      { e.time_period() } -> std::same_as<double>;
                    }) ||
                   (!E::is.periodic && requires { &Free<E>::time_period; });
template <class E>
concept Settles = (E::is.settles &&
                   requires(const E& e) {
                     { e.settled_from() } -> std::same_as<double>;
                   }) ||
                  (!E::is.settles && requires { &Free<E>::settled_from; });
template <class E>
concept Stores = (E::is.stores && E::is.states > 0 &&
                  requires(const E& e, const ShaftState<double>& x, const double* own) {
                    { e.stored(own) } -> std::same_as<double>;
                    { e.loss_power(x) } -> std::same_as<double>;
                  }) ||
                 (!E::is.stores && requires {
                   &Free<E>::stored;
                   &Free<E>::loss_power;
                 });
template <class E>
concept FeelsSwitching = (E::is.feels_switching && E::is.states > 0 &&
                          requires(const E& e, const ShaftState<double>& x, double* own) {
                            { e.switched(x, own) } -> std::same_as<void>;
                          }) ||
                         (!E::is.feels_switching && requires { &Free<E>::switched; });
template <class E>
concept StartsAnew = (E::is.starts_anew && E::is.guards > 0 &&
                      requires(const E& e, const ShaftState<double>& x) {
                        { e.mode_anew(x) } -> std::same_as<int>;
                      }) ||
                     (!E::is.starts_anew && requires { &Free<E>::mode_anew; });
template <class E>
concept OfNoConnection = requires {
  &Free<E>::capacity;
  &Free<E>::spring_torque;
  &Free<E>::energy;
  &Free<E>::twist_at;
  &Free<E>::stiffness_at_rest;
  &Free<E>::turning_torque;
  &Free<E>::rest_twist;
  &Free<E>::rest_ratio;
  &Free<E>::rest_ratio_slope;
};

template <class E, class Traits>
concept SaysWhatItIs = std::same_as<std::remove_cvref_t<decltype(E::is)>, Traits>;

}  // namespace valid

template <class E>
concept ValidConnection = valid::SaysWhatItIs<E, ConnectionTraits> && valid::SaysTraitsInIs<E> &&
    valid::Torque<E, Twist<double>, Twist<Dual<1>>> && valid::Slips<E> && valid::Spring<E> && valid::SpringTakes<E> &&
    valid::ReportsLoss<E> && valid::UsesAngle<E> && valid::TurnsUnevenly<E> && valid::Guards<E, Twist<double>> &&
    valid::States<E, Twist<double>, Twist<Dual<1>>> && valid::Described<E> && valid::OtherForms<E, ConnectionForm> &&
    valid::OfNoShaftElement<E>;

template <class E>
concept ValidShaftElement = valid::SaysWhatItIs<E, ShaftTraits> && valid::SaysTraitsInIs<E> &&
    valid::Torque<E, ShaftState<double>, ShaftState<Dual<1>>> && valid::Always<E> && valid::HasAccount<E> &&
    valid::Directional<E> && valid::Commanded<E> && valid::HasPeriodOfAngle<E> && valid::Timed<E> &&
    valid::Periodic<E> && valid::Settles<E> && valid::Guards<E, ShaftState<double>> &&
    valid::States<E, ShaftState<double>, ShaftState<Dual<1>>> && valid::Stores<E> && valid::FeelsSwitching<E> &&
    valid::StartsAnew<E> && valid::Described<E> && valid::OtherForms<E, ShaftForm> && valid::OfNoConnection<E>;

// A specification that becomes a connection.
template <class S>
concept ValidSpecification = requires(const S& given) {
  typename S::Element;
  { given.settled(1.0) } -> std::same_as<typename S::Element>;
  { given.damping_hangs_on_inertia() } -> std::same_as<bool>;
}
&&valid::FindsForms<S, ConnectionForm> == requires { requires S::other_forms; };

// Checks of both kinds with messages.
template <class E, class X, class D>
consteval void demand_common() {
  static_assert(valid::SaysTraitsInIs<E>, "a trait stands beside `is`: say it in `is`, as .slips = true");
  static_assert(valid::Torque<E, X, D>,
                "an element has template <class T> T torque(const Twist<T>&) const, of a shaft "
                "element const ShaftState<T>&");
  static_assert(valid::Guards<E, X>,
                ".guards = n goes with guard(x, double*), first_mode(x), next_mode(x, int) and "
                "mode_name(int), all const; and .regularised_mode with .guards");
  static_assert(valid::States<E, X, D>,
                ".states = n goes with template rates(x, T*), first_states(x, double*) and "
                "state(int), all const");
  static_assert(valid::Described<E>, ".described goes with std::string describe() const");
}

template <class E>
consteval bool demand_valid_connection() {
  static_assert(valid::SaysWhatItIs<E, ConnectionTraits>,
                "a connection says what it is: static constexpr ConnectionTraits is{…}");
  demand_common<E, Twist<double>, Twist<Dual<1>>>();
  static_assert(valid::Slips<E>,
                ".slips goes with Hold hold(const Twist<double>&) const and double capacity() const, "
                "and not with .springless");
  static_assert(valid::Spring<E>,
                "a connection has double twist_at(double) const, double stiffness_at_rest() const, "
                "spring_torque and energy, unless it .slips or is .springless");
  static_assert(valid::SpringTakes<E>,
                "double spring_torque(x) const and double energy(x) const take the twist, or "
                "with .spring_takes_motion, always with .states or .uses_angle, the motion");
  static_assert(valid::ReportsLoss<E>, ".reports_loss, always with .states, goes with double loss_power(x) const");
  static_assert(valid::UsesAngle<E>,
                ".uses_angle goes with template <class T> T turning_torque(const Twist<T>&) const");
  static_assert(valid::TurnsUnevenly<E>,
                ".turns_unevenly, with .uses_angle, goes with rest_twist(double), rest_ratio(double) "
                "and rest_ratio_slope(double), all double and const");
  static_assert(valid::OtherForms<E, ConnectionForm>,
                ".other_forms goes with ConnectionForm under(const E&, const Effects&)");
  static_assert(valid::OfNoShaftElement<E>, "this member belongs to a trait of shaft elements");
  return true;
}

template <class E>
consteval bool demand_valid_shaft_element() {
  static_assert(valid::SaysWhatItIs<E, ShaftTraits>,
                "a shaft element says what it is: static constexpr ShaftTraits is{…}");
  demand_common<E, ShaftState<double>, ShaftState<Dual<1>>>();
  static_assert(valid::Always<E>,
                "a shaft element has Rated rated() const, bool uses_time() const and bool uses_speed() "
                "const");
  static_assert(valid::HasAccount<E>, "a shaft element has either .account = … or a member Account work_account");
  static_assert(valid::Directional<E>, ".directional goes with Hold hold(const ShaftState<double>&) const");
  static_assert(valid::Commanded<E>,
                ".commanded goes with bool opens_at_zero() const, and .reversible with .commanded");
  static_assert(valid::HasPeriodOfAngle<E>, ".uses_angle goes with double angle_period() const");
  static_assert(valid::Timed<E>, ".timed goes with double next_edge(double) const and int mode_at(double) const");
  static_assert(valid::Periodic<E>, ".periodic goes with double time_period() const");
  static_assert(valid::Settles<E>, ".settles goes with double settled_from() const");
  static_assert(valid::Stores<E>,
                ".stores, with .states, goes with double stored(const double*) const and double "
                "loss_power(x) const");
  static_assert(valid::FeelsSwitching<E>, ".feels_switching, with .states, goes with void switched(x, double*) const");
  static_assert(valid::StartsAnew<E>, ".starts_anew, with .guards, goes with int mode_anew(x) const");
  static_assert(valid::OtherForms<E, ShaftForm>, ".other_forms goes with ShaftForm under(const E&, const Effects&)");
  static_assert(valid::OfNoConnection<E>, "this member belongs to a trait of connections");
  return true;
}

template <class S>
consteval bool demand_valid_specification() {
  static_assert(
      ValidSpecification<S>,
      "a specification has using Element = E, E settled(double) const, bool "
      "damping_hangs_on_inertia() const, and with other_forms = true ConnectionForm under(const S&, const Effects&)");
  return true;
}

}  // namespace kurbel
