// gear_loss.h — law of the losses of a gear by direction of power.
#pragma once

namespace kurbel {

// Losses of a gear: a torque L on its driving side against its motion, linear in the torque λ taken there,
// L = slope λ + offset, by the direction of motion and the sign of λ. At standstill any value between them is possible.
struct GearLoss {
  struct Line {
    double slope = 0, offset = 0;  // 1, [N·m]
  };
  Line forwards_driving, forwards_driven;    // moving forwards with λ > 0 (power flows a → b), λ < 0
  Line backwards_driven, backwards_driving;  // moving backwards with λ > 0, λ < 0
  const Line& line(int direction, int sign) const {
    if (direction > 0) return sign > 0 ? forwards_driving : forwards_driven;
    return sign > 0 ? backwards_driven : backwards_driving;
  }
};

}  // namespace kurbel
