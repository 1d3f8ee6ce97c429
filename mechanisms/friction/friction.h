// friction.h — friction in a joint: coefficient over sliding speed, friction circle.
//                                                                                                     (theory 8)
// f: coefficient of friction [1], φ_f = atan f: angle of friction [rad]. Values outside their domain throw
// std::invalid_argument.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "engine/elements/stribeck.h"

namespace kurbel {

namespace friction_detail {
inline void require(bool holds, const char* what, double got, const char* domain) {
  if (!holds)
    throw std::invalid_argument(std::string("friction: ") + what + " = " + std::to_string(got) + "; must be " + domain);
}
}  // namespace friction_detail

inline double friction_angle(double f) {
  friction_detail::require(f >= 0 && std::isfinite(f), "coefficient", f, ">= 0");
  return std::atan(f);
}

// --- coefficient over sliding speed ---

// Stribeck curve, from static (dry) over mixed to fluid friction:
//     f(v) = f_k + (f_s − f_k) exp(−(|v|/v_s)²) + b |v|                                               (theory 8.7)
// v_s = 0: f_s only at rest, f_k in motion; f_k is then Coulomb's kinetic coefficient.
struct FrictionCoefficient {
  double kinetic = 0;         // f_k ≥ 0
  double resting = 0;         // f_s ≥ f_k: static coefficient
  double stribeck_speed = 0;  // v_s ≥ 0 [m/s]
  double viscous = 0;         // b ≥ 0 [s/m]

  bool none() const { return kinetic == 0 && resting == 0 && viscous == 0; }
  double at(double sliding_speed) const {
    const double v = std::abs(sliding_speed);
    if (stribeck_speed > 0) return stribeck(v, kinetic, resting, stribeck_speed) + viscous * v;
    return (v > 0 ? kinetic : resting) + viscous * v;
  }
  // The same without the jump at rest: at v = 0 the limit v → 0 of motion.
  double in_motion(double sliding_speed) const {
    return sliding_speed == 0 && stribeck_speed == 0 ? kinetic : at(sliding_speed);
  }
};

// --- revolute pair: journal radius r, reaction R tangent to the friction circle ---

// ρ = r sin φ_f, exact: R is the resultant of normal and friction force. For small f, f r.
inline double friction_circle_radius(double journal_radius, double f) {
  friction_detail::require(journal_radius >= 0, "journal radius", journal_radius, ">= 0 m");
  return journal_radius * std::sin(friction_angle(f));
}

}  // namespace kurbel
