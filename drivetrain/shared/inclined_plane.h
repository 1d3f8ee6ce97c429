// inclined_plane.h — a load pushed up or let down an inclined plane, which a screw and a worm wind about an axis.
//
//     The plane moves by s under a push F along its base; the load, guided across, rises by s tan γ under Q.
//     up:    F = V (tan(γ + ρ) + μ_b),   Q = V (1 − μ_g tan(γ + ρ)),     η₁ = Q tan γ/F                     (theory 7.11)
//     down:  F = V (tan(γ − ρ) − μ_b),   Q = V (1 + μ_g |tan(γ − ρ)|),   η₂ = F/(Q tan γ)
//     γ    angle of the plane, 0 < γ < π/2 [rad];  ρ = atan μ friction angle of plane and load [rad]
//     V    what plane and base carry [N]
//     μ_b  friction on the base, over the same way as the plane's: of a screw μ_c d_c/d₂ of its collar (or pivot)
//     μ_g  friction in the guide of the load, which takes the push F bears across; of a screw 0: its nut is held by
//          a couple
// η₂ ≤ 0: it locks itself. Wound about an axis with d₂ (thread, worm): tan γ = P/(π d₂), tan ρ′ = μ/cos α, α the angle of
// the flank. Source: Artobolevsky, Theory of mechanisms and machines, friction in screw and wedge pairs; Niemann, Winter,
// Höhn: Maschinenelemente I.
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

  // The plane drives; 0: it drives nothing, however hard it is pushed.
  double efficiency() const {
    if (angle + friction_angle >= std::numbers::pi / 2) return 0;
    const double push = std::tan(angle + friction_angle);
    return std::max(0.0, std::tan(angle) * (1 - guide * push) / (push + base));
  }
  // The load drives; negative: this much must be helped.
  double efficiency_back() const {
    const double push = std::tan(angle - friction_angle);
    return (push - base) / (std::tan(angle) * (1 + guide * std::abs(push)));
  }
  bool self_locking() const { return efficiency_back() <= 0; }
};

// tan ρ′ = μ/cos α of flanks that stand at α to the normal of the axis.
inline double friction_angle_of_flanks(double friction, double flank_angle) {
  return std::atan(friction / std::cos(flank_angle));
}

}  // namespace kurbel
