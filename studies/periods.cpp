// periods.cpp — from cycles, or from the sampled speed where there are none.
#include "studies/periods.h"

#include <algorithm>
#include <cmath>

namespace kurbel {
namespace {

constexpr double near_steady = 0.01, at_rest = 1e-3, same_cycle = 1e-3;

// The last time at which every driving source of the machine had gone off, if it stayed so.
std::optional<double> last_switch_off(const Model& model, const RunOutcome& outcome) {
  double last = -1;
  bool any = false;
  for (const Network::ShaftElement& e : model.network.elements) {
    if (e.element->account() != Account::driving) continue;
    any = true;
    if (e.window.stop >= outcome.t) return {};
    last = std::max(last, e.window.stop);
  }
  for (const Network::Node& node : model.network.nodes)
    if (node.prescribed >= 0) return {};
  return any && last > 0 ? std::optional(last) : std::nullopt;
}

// Speed of the reduction link over time, straight between the samples.
struct SpeedSeries {
  const TrajectoryRecorder& trajectory;
  std::size_t channel;
  double at(std::size_t row) const { return trajectory.value(row, channel); }
  double time(std::size_t row) const { return trajectory.time()[row]; }
  std::size_t rows() const { return trajectory.time().size(); }
  // Time between two rows at which the speed passes a value.
  double passing(std::size_t row, double value) const {
    const double a = at(row - 1) - value, b = at(row) - value;
    const double s = a == b ? 1 : a / (a - b);
    return time(row - 1) + s * (time(row) - time(row - 1));
  }
};

std::optional<SpeedSeries> speed_series(const Model& model, const TrajectoryRecorder& trajectory) {
  const std::string& component = model.network.nodes[static_cast<std::size_t>(model.reduction_node)].component;
  for (std::size_t k = 0; k < trajectory.channels().size(); ++k)
    if (trajectory.channels()[k].name == "speed." + component || trajectory.channels()[k].name == "speed." + component + ".in") return SpeedSeries{trajectory, k};
  return {};
}

void from_cycles(const std::vector<CycleRecord>& cycles, Periods& periods) {
  std::vector<const CycleRecord*> driven;
  for (const CycleRecord& c : cycles)
    if (!periods.run_down_begin || c.end <= *periods.run_down_begin) driven.push_back(&c);
  if (driven.size() < 2) return;
  periods.steady_speed = driven.back()->mean_speed();
  periods.steady = std::abs(driven[driven.size() - 2]->mean_speed() / periods.steady_speed - 1) < same_cycle;
  if (!periods.steady) return;
  std::size_t first = driven.size();
  while (first > 0 && std::abs(driven[first - 1]->mean_speed() / periods.steady_speed - 1) <= near_steady) --first;
  if (first > 0) periods.run_up_end = driven[first]->begin;
}

void from_speed(const SpeedSeries& speed, double end, Periods& periods) {
  std::size_t last = 0;
  while (last + 1 < speed.rows() && speed.time(last + 1) <= end) ++last;
  if (last < 20) return;
  const double final = speed.at(last), before = speed.at(last - last / 20);
  periods.steady_speed = final;
  periods.steady = final != 0 && std::abs(before / final - 1) < same_cycle;
  if (!periods.steady) return;
  std::size_t first = last;
  while (first > 0 && std::abs(speed.at(first - 1) / final - 1) <= near_steady) --first;
  if (first > 0) periods.run_up_end = speed.passing(first, speed.at(first - 1) < final ? final * (1 - near_steady) : final * (1 + near_steady));
}

}  // namespace

Periods find_periods(const Model& model, const std::vector<CycleRecord>& cycles, const TrajectoryRecorder& trajectory,
                     const RunOutcome& outcome) {
  Periods periods;
  periods.run_down_begin = last_switch_off(model, outcome);
  const std::optional<SpeedSeries> speed = speed_series(model, trajectory);
  if (cycles.size() >= 2) {
    from_cycles(cycles, periods);
  } else if (speed) {
    from_speed(*speed, periods.run_down_begin.value_or(outcome.t), periods);
  }
  if (!periods.run_down_begin || !speed) return periods;
  // The event is exact; a machine without dry friction only comes near rest.
  for (const Event& event : outcome.events)
    if (event.t > *periods.run_down_begin && event.what == "comes to rest and is held") {
      periods.standstill = event.t;
      return periods;
    }
  for (std::size_t row = 1; row < speed->rows(); ++row)
    if (speed->time(row) > *periods.run_down_begin && std::abs(speed->at(row)) < at_rest * std::max(std::abs(periods.steady_speed), at_rest * model.speed_scale)) {
      periods.standstill = speed->time(row);
      break;
    }
  return periods;
}

}  // namespace kurbel
