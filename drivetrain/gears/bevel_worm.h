// bevel_worm.h — bevel and worm pairs by their basic relations (theory 6).
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "drivetrain/shared/inclined_plane.h"

namespace kurbel {

// Straight bevel pair. Pitch cones: tan δ₁ = sin Σ/(u + cos Σ), δ₂ = Σ − δ₁; at the outer end d = m z.
struct BevelPair {
  std::array<int, 2> teeth;
  double module;                              // at the outer end [m]
  double shaft_angle = std::numbers::pi / 2;  // Σ [rad]

  double ratio() const { return static_cast<double>(teeth[1]) / teeth[0]; }
  double cone_angle(int i) const {
    const double first = std::atan2(std::sin(shaft_angle), ratio() + std::cos(shaft_angle));
    return i == 0 ? first : shaft_angle - first;
  }
  double reference_diameter(int i) const { return module * teeth[static_cast<std::size_t>(i)]; }
  // R_e = d/(2 sin δ), equal for both wheels.
  double cone_distance() const { return 0.5 * reference_diameter(0) / std::sin(cone_angle(0)); }
  // Tredgold: the teeth are those of a spur wheel with z_v = z/cos δ; a crown wheel (δ = 90°) is a rack.
  double virtual_teeth(int i) const {
    const double c = std::cos(cone_angle(i));
    return std::abs(c) < 1e-15 ? std::numeric_limits<double>::infinity() : teeth[static_cast<std::size_t>(i)] / c;
  }
};

// Worm and wheel. Lead angle tan γ = z₁ m/d₁; d₁ reference diameter of the worm, m axial module.
struct WormPair {
  int starts, teeth;
  double module, worm_diameter;                  // [m]
  double friction = 0;                           // μ
  double pressure_angle = std::numbers::pi / 9;  // α_n [rad]

  double ratio() const { return static_cast<double>(teeth) / starts; }
  double lead_angle() const { return std::atan(starts * module / worm_diameter); }
  double centre_distance() const { return 0.5 * (worm_diameter + module * teeth); }
  // ρ′ = atan(μ/cos α_n).
  double friction_angle() const { return friction_angle_of_flanks(friction, pressure_angle); }
  InclinedPlane thread() const { return {lead_angle(), friction_angle()}; }
  // Worm drives: η = tan γ/tan(γ + ρ′).
  double efficiency() const { return thread().efficiency(); }
  // Wheel drives: η = tan(γ − ρ′)/tan γ; negative: self-locking; the worm must be driven with |η| of the load torque.
  double efficiency_back() const { return thread().efficiency_back(); }
  bool self_locking() const { return thread().self_locking(); }
  // v_g = ω₁ d₁/(2 cos γ).
  double sliding_speed(double omega_worm) const { return omega_worm * worm_diameter / (2 * std::cos(lead_angle())); }
};

inline void check(const BevelPair& b) {
  if (b.teeth[0] < 5 || b.teeth[1] < 5)
    throw std::invalid_argument("bevel pair: both wheels must have 5 teeth or more");
  if (!(b.module > 0)) throw std::invalid_argument("bevel pair: module must be > 0");
  if (!(b.shaft_angle > 0 && b.shaft_angle < std::numbers::pi && b.cone_angle(1) < std::numbers::pi))
    throw std::invalid_argument("bevel pair: shaft angle must be > 0 and < 180 deg");
}
inline void check(const WormPair& w) {
  if (w.starts < 1 || w.starts > 20) throw std::invalid_argument("worm pair: the worm must have 1 … 20 starts");
  if (w.teeth < 5) throw std::invalid_argument("worm pair: the wheel must have 5 teeth or more");
  if (!(w.module > 0 && w.worm_diameter > 0))
    throw std::invalid_argument("worm pair: module and worm diameter must be > 0");
  if (!(w.friction >= 0 && w.friction <= 1)) throw std::invalid_argument("worm pair: friction must be 0 … 1");
}

}  // namespace kurbel
