// belt_rating.h — what a belt may bear, beside the data that its forces follow from.
#pragma once

#include <optional>

namespace kurbel {

struct BeltRating {
  double pretension = 0, radius = 1;  // F₀ [N]; r₁ of the driving pulley [m]
  double limit = 0;                   // M at which it slips [N·m]
  std::optional<double> tension;      // allowable force in a strand [N]
  std::optional<double> reserve;      // demanded M/|τ|, ≥ 1

  // Of the tight strand at a torque on the driving pulley, fixed centres: T₁ + T₂ = 2 F₀, T₁ − T₂ = |τ|/r₁ [N].
  double tight_strand(double torque) const { return pretension + 0.5 * (torque < 0 ? -torque : torque) / radius; }
};

}  // namespace kurbel
