// round_figures.h — what is told of one round of a steady cycle: speeds, torques, drives, works.
#pragma once

#include <string>
#include <vector>

#include "studies/steady/steady.h"

namespace kurbel {

// All that is told of one round of a fixed point.
struct Round {
  std::vector<Figure> figures = {};
  std::vector<ShaftFluctuation> shafts = {};
  std::vector<MotorUse> motors = {};
  double work_residual = 0;
  std::vector<std::string> outside_data = {};  // what it takes from beyond the ends of tables
  std::string failed = {};
};

// Goes once round from the map's fixed point, as accurately as told.
Round go_round(const ReturnMap& map, const SteadyPoint& point, double tolerance);

}  // namespace kurbel
