// inclined_plane.h — a load raised or lowered by an inclined plane; screw and worm are an inclined plane about an axis.
//
//     The plane moves by s along its base under a force F; the load Q, guided at right angles, rises by s tan γ.
//     up:    F = V (tan(γ + ρ) + μ_b),   Q = V (1 − μ_g tan(γ + ρ)),     η₁ = Q tan γ/F                     (theory 7.11)
//     down:  F = V (tan(γ − ρ) − μ_b),   Q = V (1 + μ_g |tan(γ − ρ)|),   η₂ = F/(Q tan γ)
//     γ    angle of the plane, 0 < γ < π/2 [rad];  ρ = atan μ friction angle of plane and load [rad]
//     V    vertical force between plane and load, carried by the base [N]
//     μ_b  friction coefficient of the base, referred to the travel of the plane; for a screw μ_c d_c/d₂ of its collar
//     μ_g  friction coefficient in the guide of the load, which carries the horizontal force; 0 for a screw, whose nut is
//          held by a couple
// η₂ ≤ 0: self-locking. About an axis with d₂ (thread, worm): tan γ = P/(π d₂), tan ρ′ = μ/cos α, α the flank angle.
// Source: Artobolevsky, Theory of mechanisms and machines, friction in screw and wedge pairs; Niemann, Winter, Höhn:
// Maschinenelemente I.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kurbel {

struct InclinedPlane {
  double angle = 0;           // γ [rad]
  double friction_angle = 0;  // ρ, of flanks ρ′ [rad]
  double base = 0;            // μ_b, ≥ 0
  double guide = 0;           // μ_g, ≥ 0

  // The plane drives; 0: no force F can move the load.
  double efficiency() const {
    if (angle + friction_angle >= std::numbers::pi / 2) return 0;
    const double push = std::tan(angle + friction_angle);
    return std::max(0.0, std::tan(angle) * (1 - guide * push) / (push + base));
  }
  // The load drives; negative: self-locking; F = |η₂| Q tan γ is needed to lower the load.
  double efficiency_back() const {
    const double push = std::tan(angle - friction_angle);
    return (push - base) / (std::tan(angle) * (1 + guide * std::abs(push)));
  }
  bool self_locking() const { return efficiency_back() <= 0; }
};

// tan ρ′ = μ/cos α; α: angle of the flanks to the normal of the axis.
inline double friction_angle_of_flanks(double friction, double flank_angle) {
  return std::atan(friction / std::cos(flank_angle));
}

}  // namespace kurbel
