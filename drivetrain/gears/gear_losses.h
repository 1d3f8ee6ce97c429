// gear_losses.h — losses of a gear by direction of power: efficiencies and bearing friction; self-locking.
//
//     input drives:   μ + b₁ = η₁ λ                       λ: torque that the gear takes from its input shaft [N·m]
//     output drives:  λ = η₂ (μ + b₂)                     μ: torque passed to the output, referred to the input
//     L = λ − μ:  forwards the greater of  (1 − η₁) λ + b₁  and  (1 − 1/η₂) λ + b₂,  backwards mirrored;
//     at rest any value between them                      (law: Modelica.Mechanics.Rotational.Components.LossyGear)
// The output receives i μ. The two lines of L intersect where the flanks change: at λ = (b₂ − b₁)/(1/η₂ − η₁). η₂ ≤ 0:
// the gear is self-locking. At rest it then holds any torque on the output; to lower the load, the input must be driven
// with λ = |η₂| |μ|. If |η₂| I₂ ≥ I₁ i² (I₁: inertia on the input, I₂: on the output), no acceleration satisfies this
// while the load drives: the gear jams and stops at once (engine/equations/jam.h). Units: N·m; 0 < η₁ ≤ 1, η₂ ≤ 1, b ≥ 0.
#pragma once

#include <cmath>
#include <string>

#include "engine/elements/gear_loss.h"

namespace kurbel {

struct GearEfficiency {
  double forwards = 1, backwards = 1;              // η₁, η₂
  double bearing_driving = 0, bearing_driven = 0;  // b₁, b₂ on the input shaft [N·m]

  bool self_locking() const { return backwards <= 0; }
  GearLoss law() const {
    // Avoids the division by zero; efficiencies so near to zero count as self-locking.
    constexpr double least = 1e-9;
    const double back = std::abs(backwards) < least ? -least : backwards;
    const double driving = 1 - forwards, driven = 1 - 1 / back;
    return {
        {driving, bearing_driving}, {driven, bearing_driven}, {driven, -bearing_driven}, {driving, -bearing_driving}};
  }
  // Description for reports; ratio: ω_in/ω_out.
  std::string describe(double ratio) const;
};

}  // namespace kurbel
