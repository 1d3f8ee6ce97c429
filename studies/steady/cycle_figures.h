// cycle_figures.h — figures of one period of a steady cycle: speeds, torques, drives, works.
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
// All components, at both ends; for a long machine only those of the link and at its ends.
std::vector<NamedShaft> shafts_of(const Model& model);
// The reduction link as figures name it: a component with one shaft has no "in".
std::string name_of_link(const Model& model);

// All results for one period of a fixed point.
struct Period {
  std::vector<Figure> figures = {};
  OrdersOfCycle orders = {};
  std::vector<ShaftFluctuation> shafts = {};
  std::vector<MotorUse> motors = {};
  double work_residual = 0;
  std::vector<std::string> outside_data = {};  // extrapolation of tables
  std::string failed = {};
};

// Integrates one period from the map's fixed point with this tolerance.
Period figures_of_period(const ReturnMap& map, const SteadyPoint& point, double tolerance);

}  // namespace kurbel
