// ranges.h — a range as people read it: both ends to the same place.
#pragma once

#include <string>

#include "engine/scene/speed_unit.h"

namespace kurbel {

// "56.79 … 63.00", "5.0 … 7.5", "20 … 200": to the place of the last of so many digits of the larger end, without zeros at the
// end of both. Ends so far apart that two digits of the smaller one would not remain, a zero, and ends of which one needs an
// exponent are rounded by themselves, "0.1234 … 350.1", "0 … 0.3"; ends that are the same then are one number.
std::string range_text(double low, double high, int digits = 4);

// "1340 … 1640 rpm"
inline std::string speed_range(double slowest, double fastest, const SpeedUnit& unit, int digits = 4) {
  return range_text(unit.of(slowest), unit.of(fastest), digits) + " " + pretty_unit(unit.name);
}

}  // namespace kurbel
