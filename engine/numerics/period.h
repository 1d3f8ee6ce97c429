// period.h — position of a value within a period, computed only here.
#pragma once

#include <cmath>

namespace kurbel {

// x − k · period with whole k, and always 0 ≤ place < period, for any finite x and any period > 0.
//
// fmod is exact, so that the remainder has all digits of x. If x is below a multiple by less than rounding (x = −1e-16,
// −5e-324; a start at 720° minus an ulp), the result is the largest number below the period: it is in the last piece and
// never beyond. (x − period ⌊x/period⌋ would give `period` itself, and an index past the end.)
inline double place_within(double x, double period) {
  const double rest = std::fmod(x, period);
  const double place = rest < 0 ? rest + period : rest;
  return place < period ? place : std::nextafter(period, 0);
}

}  // namespace kurbel
