// trajectory_rows.h — all rows of a trajectory in order of time: those at equidistant times, and between them those at peaks.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "engine/run/recorders.h"

namespace kurbel {

void for_each_row(const TrajectoryRecorder& trajectory,
                  const std::function<void(double time, std::span<const double> values)>& take);

struct TrajectoryRows {
  std::vector<double> time, values;  // values row by row
};
TrajectoryRows rows_of(const TrajectoryRecorder& trajectory);

}  // namespace kurbel
