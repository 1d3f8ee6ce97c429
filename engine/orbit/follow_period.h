// follow_period.h — once along a steady motion, for observers: the one place that integrates its period.
#pragma once

#include <vector>

#include "engine/return_map/return_map.h"

namespace kurbel {

struct FollowOptions {
  double tolerance = 1e-12;           // local, over the scale of each state
  double periods = 1;                 // to follow
  double time = 0;                    // of one period, where time tells its end [s]; 0: the map's own
  RunExtension* extension = nullptr;  // its states begin at 0
  // Another end than that of the period.
  std::function<double(double t, std::span<const double> y)> stop = {};
};

// From the point z of the map's section on, by the method and within the budget of the map. `equations`: of the map's model;
// they have the modes of the end then. The outcome's diagnosis says why the motion broke off; `stopped` whether the link came
// round, where its angle tells the period.
RunOutcome follow_period(const ReturnMap& map, const Eigen::VectorXd& z, Equations& equations,
                         const FollowOptions& options, const std::vector<Observer*>& observers);
// Of a steady motion that was found.
RunOutcome follow_period(const ReturnMap& map, const SteadyPoint& point, Equations& equations, FollowOptions options,
                         const std::vector<Observer*>& observers);

}  // namespace kurbel
