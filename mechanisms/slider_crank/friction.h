// friction.h — friction of the classical pairs in closed form: plane, wedge, screw, journal, roller.   (theory 8)
//
// f is a coefficient of friction [1], φ_f = atan f its angle; angles in rad, forces in N, torques in N·m. Where motion
// is impossible whatever the force (λ + φ_f ≥ π/2) the force is +∞. Every function throws std::invalid_argument for
// arguments outside the domain that stands beside them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace kurbel {

namespace friction_detail {
inline void require(bool holds, const char* what, double got, const char* domain) {
  if (!holds)
    throw std::invalid_argument(std::string("friction: ") + what + " = " + std::to_string(got) + "; must be " + domain);
}
// tan where it is finite: +∞ from π/2 on.
inline double tangent_or_jam(double angle) {
  return angle < std::numbers::pi / 2 ? std::tan(angle) : std::numeric_limits<double>::infinity();
}
}  // namespace friction_detail

inline double friction_angle(double f) {
  friction_detail::require(f >= 0 && std::isfinite(f), "coefficient", f, ">= 0");
  return std::atan(f);
}

// --- coefficient over sliding speed ---

// Stribeck curve, from static (dry) over mixed to fluid friction (Stribeck 1902; the exponential form after Bo and
// Pavelescu 1982):
//     f(v) = f_k + (f_s − f_k) exp(−(|v|/v_s)²) + b |v|
// v_s = 0: f_s at rest alone, f_k in motion; f_k is then Coulomb's kinetic coefficient.
struct FrictionCoefficient {
  double kinetic = 0;         // f_k ≥ 0
  double resting = 0;         // f_s ≥ f_k: static coefficient
  double stribeck_speed = 0;  // v_s ≥ 0 [m/s]
  double viscous = 0;         // b ≥ 0 [s/m]

  bool none() const { return kinetic == 0 && resting == 0 && viscous == 0; }
  double at(double sliding_speed) const {
    const double v = std::abs(sliding_speed);
    const double ratio = stribeck_speed > 0 ? v / stribeck_speed : (v > 0 ? 1e9 : 0.0);
    return kinetic + (resting - kinetic) * std::exp(-std::min(ratio * ratio, 700.0)) + viscous * v;
  }
  // The same without the jump at rest: what holds at v → 0 once it moves.
  double in_motion(double sliding_speed) const {
    return sliding_speed == 0 && stribeck_speed == 0 ? kinetic : at(sliding_speed);
  }
};

// --- inclined plane, slope λ, 0 ≤ λ < π/2, weight Q ---

// Horizontal force that moves the body up: P = Q tan(λ + φ_f).
inline double inclined_plane_raise(double weight, double slope, double f) {
  friction_detail::require(slope >= 0 && slope < std::numbers::pi / 2, "slope", slope, "0 ... pi/2 rad");
  return weight * friction_detail::tangent_or_jam(slope + friction_angle(f));
}
// Horizontal force that moves it down: P = Q tan(φ_f − λ); negative: that much must hold it back.
inline double inclined_plane_lower(double weight, double slope, double f) {
  friction_detail::require(slope >= 0 && slope < std::numbers::pi / 2, "slope", slope, "0 ... pi/2 rad");
  return weight * std::tan(friction_angle(f) - slope);
}
// Rests on the slope unaided: λ ≤ φ_f.
inline bool inclined_plane_self_locking(double slope, double f) { return slope <= friction_angle(f); }

// --- wedge of angle α under a guided load Q; f₁ on the slope, f₂ on the base ---

// P = Q (tan(α + φ₁) + tan φ₂)
inline double wedge_drive(double load, double angle, double f_slope, double f_base) {
  return inclined_plane_raise(load, angle, f_slope) + load * f_base;
}
// P = Q (tan(φ₁ − α) + tan φ₂); negative: it springs out unless held.
inline double wedge_withdraw(double load, double angle, double f_slope, double f_base) {
  return inclined_plane_lower(load, angle, f_slope) + load * f_base;
}
// α ≤ φ₁ + φ₂
inline bool wedge_self_locking(double angle, double f_slope, double f_base) {
  return angle <= friction_angle(f_slope) + friction_angle(f_base);
}

// --- screw pair ---

// Lead angle λ = atan(p_h/(π d)); φ′ = atan(f/cos α) with half the thread angle α (0: square thread).
struct ScrewPair {
  double mean_diameter = 0;      // d [m], > 0
  double lead = 0;               // p_h = starts · pitch [m], ≥ 0
  double coefficient = 0;        // f, ≥ 0
  double half_thread_angle = 0;  // α, 0 ≤ α < π/2 [rad]; 15° of a metric trapezoidal thread, 30° of a fastening one

  double lead_angle() const {
    friction_detail::require(mean_diameter > 0, "mean diameter", mean_diameter, "> 0 m");
    friction_detail::require(lead >= 0, "lead", lead, ">= 0 m");
    return std::atan(lead / (std::numbers::pi * mean_diameter));
  }
  double thread_friction_angle() const {
    friction_detail::require(half_thread_angle >= 0 && half_thread_angle < std::numbers::pi / 2, "half thread angle",
                             half_thread_angle, "0 ... pi/2 rad");
    return friction_angle(coefficient / std::cos(half_thread_angle));
  }
  // Torque that raises an axial load Q: M = ½ d Q tan(λ + φ′).
  double raise_torque(double load) const {
    return 0.5 * mean_diameter * load * friction_detail::tangent_or_jam(lead_angle() + thread_friction_angle());
  }
  // Torque that lowers it: M = ½ d Q tan(φ′ − λ); negative: the load drives the screw.
  double lower_torque(double load) const {
    return 0.5 * mean_diameter * load * std::tan(thread_friction_angle() - lead_angle());
  }
  // Rotation into lifting: η = tan λ/tan(λ + φ′). 0 without lead.
  double efficiency() const { return std::tan(lead_angle()) / ratio_tangent(lead_angle() + thread_friction_angle()); }
  // The load drives the screw: η = tan(λ − φ′)/tan λ; 0 where it is self-locking.
  double efficiency_driven_by_load() const {
    return self_locking() ? 0.0 : std::tan(lead_angle() - thread_friction_angle()) / std::tan(lead_angle());
  }
  bool self_locking() const { return lead_angle() <= thread_friction_angle(); }  // λ ≤ φ′

 private:
  static double ratio_tangent(double angle) {
    return angle > 0 ? friction_detail::tangent_or_jam(angle) : std::numeric_limits<double>::infinity();
  }
};

// --- revolute pair: journal radius r, reaction R tangent to the friction circle ---

// ρ = r sin φ_f, exact: the reaction's normal and friction parts add to R. For small f, f r.
inline double friction_circle_radius(double journal_radius, double f) {
  friction_detail::require(journal_radius >= 0, "journal radius", journal_radius, ">= 0 m");
  return journal_radius * std::sin(friction_angle(f));
}
inline double friction_circle_radius_approximate(double journal_radius, double f) { return journal_radius * f; }
// M = ρ R
inline double journal_torque(double reaction, double journal_radius, double f) {
  return friction_circle_radius(journal_radius, f) * std::abs(reaction);
}
// Rolling bearing by its equivalent coefficient f_eq, referred to the bore: M = ½ f_eq F d (f_eq 0.001 … 0.005).
inline double rolling_bearing_torque(double load, double bore_diameter, double equivalent_coefficient) {
  friction_detail::require(bore_diameter >= 0, "bore diameter", bore_diameter, ">= 0 m");
  return 0.5 * equivalent_coefficient * std::abs(load) * bore_diameter;
}

// --- rolling: lever arm k_r [m] of the normal force ---

inline double rolling_torque(double normal_force, double arm) { return arm * std::abs(normal_force); }  // M = k_r N
// Wheel of radius R pulled at its axle: F = k_r N/R.
inline double rolling_pull(double normal_force, double arm, double radius) {
  friction_detail::require(radius > 0, "radius", radius, "> 0 m");
  return rolling_torque(normal_force, arm) / radius;
}
// Load on rollers of radius R between two tracks: F = (k₁ + k₂) N/(2 R).
inline double roller_pull(double normal_force, double arm_below, double arm_above, double radius) {
  friction_detail::require(radius > 0, "radius", radius, "> 0 m");
  return (arm_below + arm_above) * std::abs(normal_force) / (2 * radius);
}
// A wheel rolls rather than slides where the pull that rolling asks for stays below the grip: k_r/R ≤ f.
inline bool rolls(double arm, double radius, double f) { return arm <= f * radius; }

}  // namespace kurbel
