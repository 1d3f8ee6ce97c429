// cycle_of.h — the angle of the reduction link after which a machine repeats.
#pragma once

#include <vector>

#include "engine/model/model.h"

namespace kurbel {

// The smallest multiple of the first period, up to 1000 times, that is a multiple of all (ratios to a part in 10⁹).
struct CommonPeriod {
  double value = 0;     // 0: none
  std::size_t odd = 0;  // in that case: index of the period that does not fit the first; else the last
};
CommonPeriod common_period(const std::vector<double>& periods);

// Angle of one cycle of the reduction link: 2π; 4π with a four-stroke load; n · 2π with gears between the link and other
// elements that depend on an angle (n ≤ 1000).
struct CyclePeriod {
  double angle = 0;  // [rad]
  bool periodic = true;
  double of_laws = 0;  // common period of all laws over an angle, not necessarily full turns [rad]; 0: there are none
};
CyclePeriod cycle_of(const Model& model);

}  // namespace kurbel
