// cycle_of.h — after which angle of the reduction link a machine repeats.
#pragma once

#include <vector>

#include "engine/model/model.h"

namespace kurbel {

// The smallest multiple of the first period, up to 1000 times, that is a multiple of all (ratios to a part in 10⁹).
struct CommonPeriod {
  double value = 0;     // 0: they never meet
  std::size_t odd = 0;  // then: which one never meets the first, else the last
};
CommonPeriod common_period(const std::vector<double>& periods);

// Angle of one cycle of the reduction link: 2π; 4π where a four-stroke load says so, n · 2π where gears stand between
// the link and other elements of an angle (n ≤ 1000).
struct CyclePeriod {
  double angle = 0;  // [rad]
  bool periodic = true;
  double of_laws = 0;  // common period of all that depends on an angle, be it no whole turn [rad]; 0: nothing does
};
CyclePeriod cycle_of(const Model& model);

}  // namespace kurbel
