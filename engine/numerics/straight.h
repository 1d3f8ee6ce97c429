// straight.h — whether a smooth function runs so straight between two points that it has no extreme there.
#pragma once

namespace kurbel {

// Both slopes within this factor of the mean one: nothing turns between. A parabola turns where one is below zero, a
// cubic where one is above three times the mean; what bends there and back needs a factor near one.
inline bool runs_straight(double first_slope, double last_slope, double mean_slope, double within = 2) {
  const auto is_alike = [&](double slope) { return slope / mean_slope >= 1 / within && slope / mean_slope <= within; };
  return mean_slope != 0 && is_alike(first_slope) && is_alike(last_slope);
}
inline constexpr double closely = 1.25;

}  // namespace kurbel
