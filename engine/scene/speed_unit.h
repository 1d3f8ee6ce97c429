// speed_unit.h — the unit in which a scene gives its speeds: people are told all speeds in it, programs get rad/s.
#pragma once

#include <numbers>
#include <string>

#include "engine/scene/units.h"

namespace kurbel {

struct SpeedUnit {
  std::string name = "rpm";
  double size = std::numbers::pi / 30;  // one of it [rad/s], > 0

  double of(double speed) const { return speed / size; }
  // "60 rpm"
  std::string text(double speed, int digits = 6) const { return with_unit(of(speed), name, digits); }
};

}  // namespace kurbel
