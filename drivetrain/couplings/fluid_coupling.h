// fluid_coupling.h — couplings that transmit by a fluid and have no spring: hydrodynamic coupling, viscous film.
//
//     fluid coupling:  M = λ(ν) ρ D⁵ ω_p |ω_p|, from the faster side (p, by |ω|) to the slower, ν = ω_slower/ω_faster
//     viscous film:    τ = c (ω_a − i ω_b)
// λ is given over −1 ≤ ν ≤ 1 with λ(1) = 0; below its first point it is constant. The law is symmetric: if the driven
// side is faster, it drives back. It is smooth through ν = 1; at ω_b = −ω_a (countercurrent braking) its slope jumps.
// (Föttinger's law of similarity; VDI 2153, Hydrodynamische Leistungsübertragung.) A ring joined to a shaft by a viscous
// film is an untuned (Houdaille) damper. With shaft inertia J on a spring k to the frame, μ = J_ring/J, the least peak is
// M₀/k · (1 + 2/μ) at ω² = (k/J) 2/(2 + μ), with c = 2 J_ring √(k/J)/√(2 (1 + μ)(2 + μ)) (Den Hartog, Mechanical
// Vibrations, 4th ed., ch. 3.3).
#pragma once

#include <cmath>

#include "engine/elements/element.h"
#include "engine/numerics/curve.h"
#include "engine/numerics/dual.h"

namespace kurbel {

struct FluidCoupling {
  static constexpr ConnectionTraits is{.springless = true, .uses_speeds = true};
  Curve lambda;     // λ(ν) [1]
  double size = 0;  // ρ D⁵ [kg·m²], > 0

  template <class T>
  T torque(const Twist<T>& x) const {
    const T a = x.turn_rate, b = x.turn_rate - x.rate;
    const bool a_faster = std::abs(value_of(a)) >= std::abs(value_of(b));
    const T fast = a_faster ? a : b, slow = a_faster ? b : a;
    if (value_of(fast) == 0) return T(0.0);
    const T flow = lambda.value(slow / fast) * size * (fast * fast);
    return (a_faster == (value_of(fast) > 0) ? 1.0 : -1.0) * flow;
  }
};

struct ViscousFilm {
  static constexpr ConnectionTraits is{.springless = true};
  double damping = 0;  // c [N·m·s/rad], ≥ 0

  template <class T>
  T torque(const Twist<T>& x) const {
    return damping * x.rate;
  }
};

}  // namespace kurbel
