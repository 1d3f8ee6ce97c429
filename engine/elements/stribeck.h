// stribeck.h — Stribeck curve: friction decreases from its static to its kinetic value with the sliding speed.
//
//     g(v) = g_k + (g_s − g_k) exp(−(v/v_s)ⁿ)                        (theory 8.6, 8.7; Stribeck 1902, exponential form
//                                                                    after Bo and Pavelescu 1982)
//     g_k  kinetic, g_s static: torques, forces or coefficients
//     v_s  > 0, at which the mixed friction has decreased to 1/e; n its exponent, 0.5 … 10
#pragma once

#include <cmath>

#include "engine/numerics/dual.h"

namespace kurbel {

// v > 0; v = 0 is allowed if n ≥ 1 or no derivative is needed.
template <class T>
T stribeck(const T& v, double kinetic, double resting, double stribeck_speed, double exponent = 2) {
  using std::exp;
  using std::pow;
  constexpr double spent = 700;  // exp(−spent) is negligible but not zero
  const T ratio = v / stribeck_speed;
  const T power = exponent == 2 ? ratio * ratio : pow(ratio, exponent);
  if (value_of(power) >= spent) return T(kinetic + (resting - kinetic) * std::exp(-spent));
  return kinetic + (resting - kinetic) * exp(-power);
}

}  // namespace kurbel
