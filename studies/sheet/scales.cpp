// scales.cpp — round scales.
#include "studies/sheet/scales.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace kurbel {

double round_scale(double value) {
  const double decade = std::pow(10, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 2.5, 4.0, 5.0, 10.0})
    if (step * decade >= value * (1 - 1e-12)) return step * decade;
  return 10 * decade;
}

double round_degrees(double cycle, double width) {
  const double least = cycle * 180 / std::numbers::pi / width;
  for (double decade = 1;; decade *= 10)
    for (const double step : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.5, 9.0})
      if (step * decade >= least * (1 - 1e-12)) return step * decade;
}

std::string Scale::words() const { return fmt::format("{} = {:g} {}/mm", symbol, per_mm, unit); }

Scale scale_for(const std::string& symbol, const std::string& unit, double largest, double room) {
  return {symbol, largest > 0 ? round_scale(largest / room) : 1.0, unit};
}

}  // namespace kurbel
