// speed_unit.h — the unit of speeds in a scene, used in reports for people; programs get rad/s.
#pragma once

#include <numbers>
#include <string>

#include "engine/scene/units.h"

namespace kurbel {

struct SpeedUnit {
  std::string name = "rpm";
  double size = std::numbers::pi / 30;  // the unit in rad/s, > 0

  double of(double speed) const { return speed / size; }
  // "60 rpm"
  std::string text(double speed, int digits = 6) const { return with_unit(of(speed), name, digits); }
};

}  // namespace kurbel
