// plots.h — curves from rows: the common cases of plots in studies.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "studies/findings/report.h"

namespace kurbel {

// x and y are members or functions of an item.
template <class Items, class X, class Y>
Series series_of(std::string name, Role role, const Items& items, X x, Y y) {
  Series series{.name = std::move(name), .role = role};
  for (const auto& item : items) {
    series.add(std::invoke(x, item), std::invoke(y, item));
  }
  return series;
}

inline Series dashed(Series series) {
  series.dashed = true;
  return series;
}
// Markers only.
inline Series marks(Series series) {
  series.points = true, series.line = false;
  return series;
}

// Largest |y| of all series.
inline double largest_of(const Plot& plot) {
  double largest = 0;
  for (const Series& series : plot.series)
    for (const double y : series.y) largest = std::max(largest, std::abs(y));
  return largest;
}

// Converts from SI into a readable unit for values up to `largest`.
inline Plot in_readable_unit(Plot plot, const std::string& si_unit, double largest, const SpeedUnit& speed = {}) {
  const ReadableUnit unit = readable_unit(largest, si_unit, speed);
  plot.y.unit = unit.unit;
  for (Series& series : plot.series)
    for (double& y : series.y) y *= unit.factor;
  return plot;
}
inline Plot in_readable_unit(Plot plot, const std::string& si_unit, const SpeedUnit& speed = {}) {
  const double largest = largest_of(plot);
  return in_readable_unit(std::move(plot), si_unit, largest, speed);
}

// On a tile: a unit is kept up to 10 000.
ReadableUnit unit_on_tile(double value, const std::string& unit);

}  // namespace kurbel
