// bearing.h — friction of a bearing against the frame: dry, mixed and viscous.
//
//     M(ω) = −g(|ω|) sgn ω − b ω,   g(v) = M_c + (M_s − M_c) exp(−(v/ω_s)ⁿ)                 (theory 8.6; Stribeck)
//     M_c  kinetic (Coulomb) torque [N·m], M_s static torque [N·m], ≥ M_c
//     ω_s  Stribeck speed [rad/s], at which the mixed friction has decreased to 1/e; n its exponent, 0.5 … 10
//     b    viscous friction [N·m·s/rad]
// Three models of the same curve:
//   exact        sticks and slips: at standstill it holds up to M_s (engine/events/contacts.h)
//   regularised  g tanh(ω/ω_c) instead of g sgn ω: smooth, without a static torque, so that it creeps
//   LuGre        bristles deflect by z before they slip: ż = ω − σ₀ |ω| z/g(|ω|), M = −(σ₀ z + σ₁ ż + b ω); at constant
//                speed M is the curve above. |ω| has a kink at standstill, but ż is continuous there, so that the many
//                reversals of presliding are not treated as events
// Sources: Armstrong-Hélouvry, Dupont, Canudas de Wit: A survey of models … for machines with friction, Automatica 30
// (1994), 1083–1138; Canudas de Wit, Olsson, Åström, Lischinsky: A new model for control of systems with friction,
// IEEE Trans. Automatic Control 40 (1995), 419–425.
#pragma once

#include <cmath>
#include <string>

#include "engine/elements/element.h"
#include "engine/elements/stribeck.h"
#include "engine/numerics/dual.h"

namespace kurbel {

struct StribeckCurve {
  double kinetic = 0;         // M_c [N·m], ≥ 0
  double breakaway = 0;       // M_s [N·m], ≥ M_c
  double stribeck_speed = 1;  // ω_s [rad/s], ≥ 0
  double exponent = 2;        // n [1]
  double viscous = 0;         // b [N·m·s/rad], ≥ 0

  // g(v), v = |ω|; constant for v ≤ 0, which trial steps may reach.
  template <class T>
  T dry(const T& v) const {
    if (!falls()) return T(kinetic);
    if (value_of(v) <= 0) return T(breakaway);
    return stribeck(v, kinetic, breakaway, stribeck_speed, exponent);
  }
  // Whether g decreases over the speed; with ω_s = 0 it drops to M_c at the first motion.
  bool falls() const { return breakaway != kinetic && stribeck_speed > 0; }
  bool uses_speed() const { return viscous != 0 || falls(); }
  Rated rated() const { return {breakaway, 0}; }
};

struct StickingBearing {
  static constexpr ShaftTraits is{.account = Account::harmful, .directional = true, .other_forms = true};
  StribeckCurve curve;

  template <class T>
  T torque(const ShaftState<T>& x) const {
    const double side = x.direction;
    return -side * curve.dry(side * x.rate) - curve.viscous * x.rate;
  }
  Hold hold(const ShaftState<double>&) const { return {-curve.breakaway, curve.breakaway}; }
  bool uses_time() const { return false; }
  bool uses_speed() const { return curve.uses_speed(); }
  Rated rated() const { return curve.rated(); }
};

struct CreepingBearing {
  static constexpr ShaftTraits is{.account = Account::harmful, .described = true, .other_forms = true};
  StribeckCurve curve;
  double creep_speed = 0;  // ω_c [rad/s], > 0
  std::string name = {};   // of the component, for describe()

  template <class T>
  T torque(const ShaftState<T>& x) const {
    using std::abs;
    using std::tanh;
    return -curve.dry(abs(x.rate)) * tanh(x.rate / creep_speed) - curve.viscous * x.rate;
  }
  bool uses_time() const { return false; }
  bool uses_speed() const { return true; }
  Rated rated() const { return curve.rated(); }
  std::string describe() const;
};

struct BristleBearing {
  static constexpr ShaftTraits is{.account = Account::harmful, .states = 1, .stores = true, .other_forms = true};
  StribeckCurve curve;
  double stiffness = 0;  // σ₀ of the bristles [N·m/rad], > 0
  double damping = 0;    // σ₁ [N·m·s/rad], ≥ 0

  template <class T>
  T torque(const ShaftState<T>& x) const {
    T bend_rate;
    rates(x, &bend_rate);
    return -(stiffness * x.own[0] + damping * bend_rate + curve.viscous * x.rate);
  }
  template <class T>
  void rates(const ShaftState<T>& x, T* rate) const {
    using std::abs;
    const T speed = abs(x.rate);
    rate[0] = x.rate - stiffness * speed * x.own[0] / curve.dry(speed);
  }
  // Deflection of steady sliding at the initial speed; zero at rest.
  void first_states(const ShaftState<double>& x, double* own) const {
    own[0] = x.rate == 0 ? 0 : std::copysign(curve.dry(std::abs(x.rate)) / stiffness, x.rate);
  }
  InternalState state(int) const { return {"bristle", "rad", curve.breakaway / stiffness}; }
  double stored(const double* own) const { return 0.5 * stiffness * own[0] * own[0]; }
  double loss_power(const ShaftState<double>& x) const {
    double bend_rate = 0;
    rates(x, &bend_rate);
    return -torque(x) * x.rate - stiffness * x.own[0] * bend_rate;
  }
  bool uses_time() const { return false; }
  bool uses_speed() const { return true; }
  Rated rated() const { return curve.rated(); }
};

// Without the effect "bearing_friction" they are omitted.
ShaftForm under(const StickingBearing&, const Effects& effects);
ShaftForm under(const CreepingBearing&, const Effects& effects);
ShaftForm under(const BristleBearing&, const Effects& effects);

}  // namespace kurbel
