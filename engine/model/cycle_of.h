// cycle_of.h — after which angle of the reduction link a machine repeats.
#pragma once

#include "engine/model/model.h"

namespace kurbel {

// Angle of one cycle of the reduction link: 2π; 4π where a four-stroke load says so, n · 2π where gears stand between
// the link and other elements of an angle.
struct CyclePeriod {
  double angle = 0;  // [rad]
  bool periodic = true;
};
CyclePeriod cycle_of(const Model& model);

}  // namespace kurbel
