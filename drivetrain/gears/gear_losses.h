// gear_losses.h — what a gear loses, by the direction of power: efficiencies and bearing friction; self-locking.
//
//     input drives:   μ + b₁ = η₁ λ                       λ: torque that the gear takes from its input shaft [N·m]
//     output drives:  λ = η₂ (μ + b₂)                     μ: torque that goes on to the output, on the input's shaft
//     L = λ − μ:  forwards the greater of  (1 − η₁) λ + b₁  and  (1 − 1/η₂) λ + b₂,  backwards mirrored;
//     at rest anything between both                       (law: Modelica.Mechanics.Rotational.Components.LossyGear)
// The output receives i μ. The two lines of L meet where the flanks change: with b₁ = b₂ at λ = 0, otherwise where the
// friction of the input's own bearings takes all. η₂ ≤ 0: the gear locks itself. At rest it then holds any torque on
// the output; moving with the load it wants λ = |η₂| |μ| of help. From |η₂| I₂ ≥ I₁ i² on (I₁ the inertia on its input,
// I₂ on its output) no acceleration satisfies that while the load drives: it jams, and stops at once
// (engine/equations/jam.h). Units: N·m; 0 < η₁ ≤ 1, η₂ ≤ 1, b ≥ 0.
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
    // An efficiency this near to nothing is told from nothing by nobody; on that side the gear still holds.
    constexpr double least = 1e-9;
    const double back = std::abs(backwards) < least ? -least : backwards;
    const double driving = 1 - forwards, driven = 1 - 1 / back;
    return {
        {driving, bearing_driving}, {driven, bearing_driven}, {driven, -bearing_driven}, {driving, -bearing_driving}};
  }
  // In words, for explanations; ratio: ω_in/ω_out.
  std::string describe(double ratio) const;
};

}  // namespace kurbel
