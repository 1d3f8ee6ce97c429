// period.h — where a value lies within a period: the one place that this is asked.
#pragma once

#include <cmath>

namespace kurbel {

// x − k · period with whole k, and always 0 ≤ place < period, for any finite x and any period > 0.
//
// fmod is exact, so that what is left keeps every digit that x has. A place that lies less than rounding below a
// multiple (x = −1e-16, −5e-324; a start at 720° less an ulp) is the greatest number below the period: it falls into
// the last piece and never past it. (x − period ⌊x/period⌋ gives `period` itself there, and an index past the end.)
inline double place_within(double x, double period) {
  const double rest = std::fmod(x, period);
  const double place = rest < 0 ? rest + period : rest;
  return place < period ? place : std::nextafter(period, 0);
}

}  // namespace kurbel
