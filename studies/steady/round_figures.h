// round_figures.h — what is told of one round of a steady cycle: speeds, torques, drives, works.
#pragma once

#include <string>
#include <vector>

#include "studies/steady/orders.h"
#include "studies/steady/steady.h"

namespace kurbel {

struct NamedShaft {
  std::string name;
  int node;
};
// Of all components, at both ends; of a long machine those of the link and at its ends.
std::vector<NamedShaft> shafts_of(const Model& model);

// All that is told of one round of a fixed point.
struct Round {
  std::vector<Figure> figures = {};
  OrdersOfRound orders = {};
  std::vector<ShaftFluctuation> shafts = {};
  std::vector<MotorUse> motors = {};
  double work_residual = 0;
  std::vector<std::string> outside_data = {};  // what it takes from beyond the ends of tables
  std::string failed = {};
};

// Goes once round from the map's fixed point, as accurately as told.
Round go_round(const ReturnMap& map, const SteadyPoint& point, double tolerance);

}  // namespace kurbel
