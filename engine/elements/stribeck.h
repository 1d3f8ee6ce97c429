// stribeck.h — friction that falls from its value at rest to that in motion as its parts begin to slide.
//
//     g(v) = g_k + (g_s − g_k) exp(−(v/v_s)ⁿ)                        (theory 8.6, 8.7; Stribeck 1902, exponential form
//                                                                    after Bo and Pavelescu 1982)
//     g_k  kinetic, g_s static: torques, forces or coefficients
//     v_s  > 0, where what mixed friction adds has fallen to 1/e; n its exponent, 0.5 … 10
#pragma once

#include <cmath>

#include "engine/numerics/dual.h"

namespace kurbel {

// v > 0, or ≥ 0 where n ≥ 1 or no derivative is asked for.
template <class T>
T stribeck(const T& v, double kinetic, double resting, double stribeck_speed, double exponent = 2) {
  using std::exp;
  using std::pow;
  constexpr double spent = 700;  // exp(−spent) is next to nothing, and a number still
  const T ratio = v / stribeck_speed;
  const T power = exponent == 2 ? ratio * ratio : pow(ratio, exponent);
  if (value_of(power) >= spent) return T(kinetic + (resting - kinetic) * std::exp(-spent));
  return kinetic + (resting - kinetic) * exp(-power);
}

}  // namespace kurbel
