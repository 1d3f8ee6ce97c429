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
    double off = e.window.stop;
    for (const Event& event : outcome.events)  // by the operating sequence
      if (event.component == e.component && event.what.starts_with("is set "))
        off = event.what == "is set off" ? std::min(event.t, e.window.stop) : e.window.stop;
    if (off >= outcome.t) return {};
    last = std::max(last, off);
  }
  for (const Network::Node& node : model.network.nodes)
    if (node.prescribed >= 0 && !model.network.prescribed[static_cast<std::size_t>(node.prescribed)].is_nothing())
      return {};
  return any && last > 0 ? std::optional(last) : std::nullopt;
}

// A time between samples, and how far off it may be.
struct Passing {
  double t, resolution;
};

// Speed of the reduction link at the samples.
struct SpeedSeries {
  const TrajectoryRecorder& trajectory;
  std::size_t channel;
  double at(std::size_t row) const { return trajectory.value(row, channel); }
  double time(std::size_t row) const { return trajectory.time()[row]; }
  std::size_t rows() const { return trajectory.time().size(); }
  // Time between rows row − 1 and row at which the speed passes a value: root of the cubic through four samples. Its
  // distance from the straight line's root is taken for its uncertainty.
  Passing passing(std::size_t row, double value) const {
    const double t0 = time(row - 1), t1 = time(row);
    const double a = at(row - 1) - value, b = at(row) - value;
    const double straight = a == b ? t1 : t0 + a / (a - b) * (t1 - t0);
    if (row < 2 || row + 1 >= rows()) return {straight, t1 - t0};
    const auto cubic = [&](double t) {
      double sum = 0;
      for (std::size_t i = row - 2; i <= row + 1; ++i) {
        double weight = 1;
        for (std::size_t k = row - 2; k <= row + 1; ++k)
          if (k != i) weight *= (t - time(k)) / (time(i) - time(k));
        sum += weight * at(i);
      }
      return sum - value;
    };
    const double root = find_root(cubic, t0, a, t1, b);
    return {root, std::abs(root - straight)};
  }
};

std::optional<SpeedSeries> speed_series(const Model& model, const TrajectoryRecorder& trajectory) {
  const std::string& component = model.network.nodes[static_cast<std::size_t>(model.reduction_node)].component;
  for (std::size_t k = 0; k < trajectory.channels().size(); ++k)
    if (trajectory.channels()[k].name == "speed." + component ||
        trajectory.channels()[k].name == "speed." + component + ".in")
      return SpeedSeries{trajectory, k};
  return {};
}

// The range of speeds that belongs to steady motion.
struct Band {
  double low = 0, high = 0;
  bool contains(double omega) const { return omega >= low && omega <= high; }
};

std::optional<Band> band_of_cycles(const std::vector<CycleRecord>& cycles, Periods& periods) {
  std::vector<const CycleRecord*> driven;
  for (const CycleRecord& c : cycles)
    if (!periods.run_down_begin || c.end <= *periods.run_down_begin) driven.push_back(&c);
  if (driven.size() < 2) return {};
  const CycleRecord& last = *driven.back();
  periods.steady_speed = last.mean_speed();
  periods.steady = std::abs(driven[driven.size() - 2]->mean_speed() / periods.steady_speed - 1) < same_cycle;
  const double margin = near_steady * std::abs(periods.steady_speed);
  return Band{last.omega_min - margin, last.omega_max + margin};
}

std::optional<Band> band_of_speed(const SpeedSeries& speed, std::size_t last, Periods& periods) {
  if (last < 20) return {};
  periods.steady_speed = speed.at(last);
  periods.steady =
      periods.steady_speed != 0 && std::abs(speed.at(last - last / 20) / periods.steady_speed - 1) < same_cycle;
  const double margin = near_steady * std::abs(periods.steady_speed);
  return Band{periods.steady_speed - margin, periods.steady_speed + margin};
}

// Where the speed enters the band for good.
void find_run_up(const SpeedSeries& speed, std::size_t last, const Band& band, Periods& periods) {
  if (!band.contains(speed.at(last))) return;
  std::size_t first = last;
  while (first > 0 && band.contains(speed.at(first - 1))) --first;
  if (first == 0) return;  // began in steady motion
  const Passing entry = speed.passing(first, speed.at(first - 1) < band.low ? band.low : band.high);
  periods.run_up_end = entry.t;
  periods.run_up_resolution = entry.resolution;
}

}  // namespace

Periods find_periods(const Model& model, const std::vector<CycleRecord>& cycles, const TrajectoryRecorder& trajectory,
                     const RunOutcome& outcome) {
  Periods periods;
  periods.run_down_begin = last_switch_off(model, outcome);
  const std::optional<SpeedSeries> speed = speed_series(model, trajectory);
  if (speed) {
    std::size_t last = 0;
    while (last + 1 < speed->rows() && speed->time(last + 1) <= periods.run_down_begin.value_or(outcome.t)) ++last;
    const std::optional<Band> band =
        cycles.size() >= 2 ? band_of_cycles(cycles, periods) : band_of_speed(*speed, last, periods);
    if (band && periods.steady) find_run_up(*speed, last, *band, periods);
  }
  if (!periods.run_down_begin || !speed) return periods;
  // The event is exact; a machine without dry friction only comes near rest.
  for (const Event& event : outcome.events)
    if (event.t > *periods.run_down_begin && event.what == "comes to rest and is held") {
      periods.standstill = event.t;
      return periods;
    }
  for (std::size_t row = 1; row < speed->rows(); ++row)
    if (speed->time(row) > *periods.run_down_begin &&
        std::abs(speed->at(row)) < at_rest * std::max(std::abs(periods.steady_speed), at_rest * model.speed_scale)) {
      periods.standstill = speed->time(row);
      periods.standstill_resolution = speed->time(row) - speed->time(row - 1);
      break;
    }
  return periods;
}

}  // namespace kurbel
