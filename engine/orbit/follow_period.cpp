// follow_period.cpp — a run from the section to the period's end.
#include "engine/orbit/follow_period.h"

namespace kurbel {

RunOutcome follow_period(const ReturnMap& map, const Eigen::VectorXd& z, Equations& equations,
                         const FollowOptions& options, const std::vector<Observer*>& observers) {
  const Periodicity& period = map.periodicity();
  std::vector<double> y = map.place(equations, z);
  const double by_law = options.time > 0 ? options.time : period.time * map.options().cycles;
  RunOptions run{.tolerance = options.tolerance,
                 .method = map.options().method,
                 .until = map.start_time() + options.periods * (period.by_time ? by_law : map.time_limit()),
                 .budget = map.options().budget,
                 .interrupted = map.options().interrupted,
                 .progress = {},
                 .stop = options.stop,
                 .extension = options.extension};
  if (!run.stop) run.stop = map.period_end(equations, y, options.periods);
  y.resize(options.extension ? options.extension->size() : equations.size(), 0.0);
  run.from = {map.start_time(), std::move(y)};
  return integrate(equations, run, observers);
}

RunOutcome follow_period(const ReturnMap& map, const SteadyPoint& point, Equations& equations, FollowOptions options,
                         const std::vector<Observer*>& observers) {
  options.time = point.time;
  return follow_period(map, point.z, equations, options, observers);
}

}  // namespace kurbel
