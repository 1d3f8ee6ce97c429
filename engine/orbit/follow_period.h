// follow_period.h — integrates one period of a steady motion for observers.
#pragma once

#include <vector>

#include "engine/return_map/return_map.h"

namespace kurbel {

struct FollowOptions {
  double tolerance = 1e-12;           // local, over the scale of each state
  double periods = 1;                 // number of periods
  double time = 0;                    // of one period, if time defines its end [s]; 0: that of the map
  RunExtension* extension = nullptr;  // its states begin at 0
  // Another end instead of that of the period.
  std::function<double(double t, std::span<const double> y)> stop = {};
};

// From the point z of the map's section, with the method and the budget of the map. `equations`: of the map's model; on
// return they have the modes of the end. The diagnosis of the outcome states why a motion ended early; `stopped`: the link
// completed the period, if its angle defines it.
RunOutcome follow_period(const ReturnMap& map, const Eigen::VectorXd& z, Equations& equations,
                         const FollowOptions& options, const std::vector<Observer*>& observers);
// The same from a steady motion found before.
RunOutcome follow_period(const ReturnMap& map, const SteadyPoint& point, Equations& equations, FollowOptions options,
                         const std::vector<Observer*>& observers);

}  // namespace kurbel
