// plain_forces.h — forces on a mechanism's output with one or two parameters: constant, spring, opposing the motion,
// resistance of a medium, linear motor.
#pragma once

#include <cmath>

#include "engine/elements/element.h"
#include "engine/numerics/dual.h"
#include "mechanisms/loads/load_traits.h"
#include "mechanisms/loads/slider_state.h"

namespace kurbel {

// F = F₀
struct ConstantForce {
  static constexpr LoadTraits is{};
  double force = 0;  // [N]
  template <class T>
  T value(const SliderState<T>&) const {
    return T(force);
  }
  bool uses_speed() const { return false; }
};

// F = −(F₀ + k (x − x₀)): a spring, in tension at x = x₀ for F₀ > 0.
struct SpringForce {
  static constexpr LoadTraits is{};
  double stiffness = 0, free = 0, preload = 0;  // k [N/m], x₀ [m], F₀ [N]
  double greatest = 0;                          // |F| over the travel [N]
  template <class T>
  T value(const SliderState<T>& s) const {
    return -(preload + stiffness * (s.x - free));
  }
  bool uses_speed() const { return false; }
};

// F = −F₀ sgn v; at standstill a static force up to F₀.
struct OpposingForce {
  static constexpr LoadTraits is{.opposes = true, .holds = true};
  double force = 0;  // [N], ≥ 0
  template <class T>
  T value(const SliderState<T>& s) const {
    return T(-force * s.travel);
  }
  bool uses_speed() const { return false; }
  Hold hold(const SliderState<double>&) const { return {-force, force}; }
};

// F = −(c v + q v |v|): resistance of the medium.
struct MediumResistance {
  static constexpr LoadTraits is{};
  double viscous = 0;    // c [N·s/m], ≥ 0
  double quadratic = 0;  // q [N·s²/m²], ≥ 0
  template <class T>
  T value(const SliderState<T>& s) const {
    using std::abs;
    return -(viscous + quadratic * abs(s.v)) * s.v;
  }
  bool uses_speed() const { return viscous != 0 || quadratic != 0; }
};

// Linear motor with the force–speed line F = F₀ (σ − v/v₀): σ = sgn v if the commutation follows the motion, else the
// constant direction of its force. In the first case it has no force at standstill and must be started.
struct LinearMotorForce {
  static constexpr LoadTraits is{.opposes = true, .holds = true};
  double force = 0;     // F₀ at standstill [N], > 0
  double velocity = 1;  // v₀ without load [m/s], > 0
  int sense = 0;        // +1: towards the extended end, −1: the folded end, 0: with the motion

  template <class T>
  T value(const SliderState<T>& s) const {
    return force * (sense != 0 ? sense : s.travel) - force / velocity * s.v;
  }
  bool uses_speed() const { return true; }
  Hold hold(const SliderState<double>&) const { return {}; }
};

}  // namespace kurbel
