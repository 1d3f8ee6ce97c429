// trajectory_rows.cpp — equidistant rows and peaks merged.
#include "studies/tables/trajectory_rows.h"

namespace kurbel {

void for_each_row(const TrajectoryRecorder& t,
                  const std::function<void(double time, std::span<const double> values)>& take) {
  auto peak = t.peaks().begin();
  for (std::size_t row = 0; row < t.time().size(); ++row) {
    for (; peak != t.peaks().end() && peak->time < t.time()[row]; ++peak) take(peak->time, peak->values);
    if (peak != t.peaks().end() && peak->time == t.time()[row]) ++peak;
    take(t.time()[row], std::span(t.values()).subspan(row * t.channels().size(), t.channels().size()));
  }
  for (; peak != t.peaks().end(); ++peak) take(peak->time, peak->values);
}

TrajectoryRows rows_of(const TrajectoryRecorder& t) {
  TrajectoryRows rows;
  rows.time.reserve(t.time().size() + t.peaks().size());
  rows.values.reserve(rows.time.capacity() * t.channels().size());
  for_each_row(t, [&](double time, std::span<const double> values) {
    rows.time.push_back(time);
    rows.values.insert(rows.values.end(), values.begin(), values.end());
  });
  return rows;
}

}  // namespace kurbel
