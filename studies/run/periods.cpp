// periods.cpp — from cycle means, and from the last time outside a band.
#include "studies/run/periods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kurbel {
namespace {

constexpr double least_reported = 1e-6;  // of a speed: nearer to its limit nobody asks
constexpr double near_steady = 0.01, at_rest = 1e-3, steady_within = 1e-3;
constexpr double part_of_range = 0.05;  // the margin of a cycle's range
constexpr double nowhere = 1e3;         // times the speed: a limit so far away is rounding
constexpr std::size_t parts_without_cycle = 16, least_means = 3;
// Scatter of the mid speed between cycles for a local tolerance, as a multiple of it; never more than most_noise.
constexpr double noise_of_tolerance = 30, most_noise = 1e-5;

// Changes D₁, D₂ over the two halves of the last 2 · `length` changes.
std::optional<double> geometric_rest(std::span<const double> v, std::size_t length, double noise) {
  const std::size_t n = v.size() - 1;
  const double second = std::abs(v[n] - v[n - length]), first = std::abs(v[n - length] - v[n - 2 * length]);
  if (second <= noise) return second;
  if (second >= first) return {};
  return second * second / (first - second);
}

double range_of(std::span<const double> v) {
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  return *high - *low;
}

// The means of a machine without a cycle: angle over time.
std::vector<double> means_of_parts(const SpeedRecorder& speed, double begin, double end) {
  const std::vector<double>& angle = speed.angles();
  std::vector<double> means;
  if (angle.empty() || !(speed.interval() > 0)) return means;
  const std::size_t last = std::min(angle.size() - 1, static_cast<std::size_t>(end / speed.interval() * (1 + 1e-12)));
  const auto first = static_cast<std::size_t>(std::ceil(begin / speed.interval() * (1 - 1e-12)));
  const std::size_t part = last > first ? (last - first) / parts_without_cycle : 0;
  if (part == 0) return means;
  for (std::size_t k = first + (last - first) % part; k + part <= last; k += part)
    means.push_back((angle[k + part] - angle[k]) / (static_cast<double>(part) * speed.interval()));
  return means;
}

// Means of cycles converted to equal time steps: an even growth in time must not look like a slowing one because its
// cycles get shorter.
std::vector<double> at_equal_times(const std::vector<double>& time, const std::vector<double>& mean) {
  std::vector<double> even;
  std::size_t k = 1;
  for (std::size_t i = 0; i < mean.size() && mean.size() > 2; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(mean.size() - 1);
    const double t = time.front() + part * (time.back() - time.front());
    while (k + 1 < mean.size() && time[k] < t) ++k;
    even.push_back(mean[k] + (mean[k] - mean[k - 1]) * (t - time[k]) / (time[k] - time[k - 1]));
  }
  return mean.size() > 2 ? even : mean;
}

// Between changes of a command, with their ramps, and of windows of time, up to `end`; the whole, if the sequence repeats.
struct Section {
  double begin = 0, end = 0;  // [s]
};
std::vector<Section> sections(const Model& model, const EventLog& events, double end) {
  std::vector<Section> list{{0, end}};
  if (model.scene.sequence.repeat) return list;
  for (const Event& e : events) {
    const bool commands = e.kind == EventKind::command;
    if ((!commands && e.kind != EventKind::window) || e.t >= end) continue;
    double ramp = 0;
    for (const SequenceStep& step : model.scene.sequence.steps) {
      const bool follows = !step.law.empty();  // a law over time: to its last value
      if (commands && (follows ? step.law.y().back() : step.to) == e.value &&
          std::count(step.set.begin(), step.set.end(), e.component) > 0)
        ramp = std::max(ramp, follows ? step.law.x().back() : step.over);
    }
    list.back().end = e.t;
    list.push_back({std::max(list.back().begin, e.t + ramp), end});
  }
  return list;
}

// Data for the judgement, of one section.
struct DrivenTime {
  double begin = 0, end = 0;          // [s]
  const CycleRecord* last = nullptr;  // cycle
  std::vector<double> means = {};     // of the speed [rad/s]
  double speed = 0;                   // the last cycle's mean, or the speed at the end of the driven time
};

DrivenTime data_of(const Section& section, const Model& model, const std::vector<CycleRecord>& cycles,
                   const SpeedRecorder& speed) {
  DrivenTime d{.begin = section.begin, .end = section.end};
  std::vector<double> middle;
  for (const CycleRecord& c : cycles) {
    if (c.end > d.end) break;
    d.last = &c;
    if (c.begin < d.begin) continue;
    middle.push_back(0.5 * (c.begin + c.end));
    d.means.push_back(c.mid_speed());
  }
  d.means = model.cycle > 0 ? at_equal_times(middle, d.means) : means_of_parts(speed, d.begin, d.end);
  d.speed = d.last ? d.last->mid_speed() : speed.driven().empty() ? 0 : speed.driven().last();
  return d;
}

DrivenTime driven_time(const Model& model, const std::vector<CycleRecord>& cycles, const SpeedRecorder& speed,
                       const Periods& periods, const RunOutcome& outcome) {
  const std::vector<Section> list = sections(model, outcome.events, periods.run_down_begin.value_or(outcome.t));
  for (auto section = list.rbegin(); section != list.rend(); ++section)
    if (DrivenTime d = data_of(*section, model, cycles, speed); d.means.size() >= least_means) return d;
  return data_of(list.back(), model, cycles, speed);
}

void judge_steadiness(const Model& model, const DrivenTime& d, double tolerance, Periods& periods) {
  const char* unit = model.cycle > 0 ? "cycle" : "sixteenth of the time";
  const char* speed = model.cycle > 0 ? "mid" : "mean";
  if (d.means.size() < least_means) {
    periods.verdict = model.cycle > 0
                          ? fmt::format("{} whole cycle{}{}, of at least 3 needed", d.means.size(),
                                        d.means.size() == 1 ? "" : "s", d.begin > 0 ? " since the last command" : "")
                          : "too short a time to decide";
    return;
  }
  const double noise = std::min(noise_of_tolerance * tolerance, most_noise) * std::abs(d.speed);
  const Approach approach = approach_of(d.means, noise);
  const double scale = std::abs(d.speed);
  if (!(scale > at_rest * at_rest * model.speed_scale)) {
    periods.verdict = "it stands still";
    return;
  }
  if (approach.remaining) periods.remaining = *approach.remaining;
  periods.steady = approach.remaining && *approach.remaining <= steady_within * scale;
  const double change = 100 * approach.last_change / scale;
  periods.without_limit = !approach.remaining || *approach.remaining > nowhere * scale;
  if (periods.without_limit)
    periods.verdict =
        fmt::format("the {} speed changes by {:+.2g} % per {}, and this change does not decrease", speed, change, unit);
  else if (*approach.remaining > scale)
    periods.verdict = fmt::format("the {} speed is still to change by more than itself", speed);
  else
    periods.verdict = fmt::format("the {} speed is {} {:.3g} % {}", speed, periods.steady ? "within" : "still",
                                  100 * std::max(*approach.remaining / scale, least_reported),
                                  periods.steady ? "of its final value" : "from its final value");
}

// Margins of the range of the steady motion, in the order in which they are tried: 1 % of the speed hides a run-up where
// the speed fluctuates by no more, and a twentieth of the fluctuation is left by a motion that differs between cycles.
std::vector<double> margins_of(const DrivenTime& d) {
  const double speed = std::abs(d.speed), widest = near_steady * speed;
  if (!d.last) return {widest};
  const double narrow = part_of_range * (d.last->omega_max - d.last->omega_min);
  return {std::clamp(narrow, steady_within * speed, widest), widest};
}

void find_run_up(const Model& model, const BandHistory& speed, const DrivenTime& d, double tolerance,
                 Periods& periods) {
  double low = 0, high = 0;
  std::optional<double> entry;
  for (const double margin : margins_of(d)) {
    low = (d.last ? d.last->omega_min : d.speed) - margin;
    high = (d.last ? d.last->omega_max : d.speed) + margin;
    entry = speed.last_outside(low, high);
    if (!entry) return;
    if (*entry <= (d.last ? d.last->begin : d.end)) break;
  }
  if (*entry > (d.last ? d.last->begin : d.end)) {
    periods.steady = periods.without_limit = false;
    periods.verdict = fmt::format("{} the speed leaves its range, at {:.6g} s",
                                  d.last ? "after the last whole cycle" : "after the last command", *entry);
    return;
  }
  periods.run_up_end = entry;
  // A crossing that only touches the band's edge shifts much with a small error of the speed.
  const double shift = tolerance * model.speed_scale;
  for (const double s : {-shift, shift}) {
    const std::optional<double> other = speed.last_outside(low - s, high + s);
    periods.run_up_resolution = std::max(periods.run_up_resolution, std::abs(other.value_or(0) - *entry));
  }
}

// Standstill of the link, if it lasts; without dry friction a machine only approaches it.
void find_standstill(const Model& model, const BandHistory& speed, const RunOutcome& outcome, double tolerance,
                     Periods& periods) {
  const double level = at_rest * model.speed_scale, begin = *periods.run_down_begin;
  const auto last_above = [&](double speed_level) { return speed.last_outside(-speed_level, speed_level); };
  const std::optional<double> entry = last_above(level);
  if (const Event* rest = rest_of(
          outcome.events,
          {last_above(10 * level).value_or(begin), entry.value_or(begin), last_above(1e-6 * level).value_or(begin)},
          model)) {
    periods.standstill = rest->t;
    return;
  }
  if (!entry || *entry >= outcome.t) return;
  periods.standstill = entry;
  const double shift = std::min(tolerance * model.speed_scale, 0.5 * level);
  for (const double s : {-shift, shift}) {
    const std::optional<double> other = speed.last_outside(-level - s, level + s);
    periods.standstill_resolution = std::max(periods.standstill_resolution, std::abs(other.value_or(0) - *entry));
  }
}

}  // namespace

Approach approach_of(std::span<const double> values, double noise) {
  Approach approach;
  if (values.size() >= 2) approach.last_change = values.back() - values[values.size() - 2];
  if (values.size() < 3) return approach;
  const std::span<const double> v = values.last(std::max<std::size_t>(3, values.size() / 2 + 1));
  const std::size_t n = v.size() - 1, half = n / 2;
  bool rises = false, falls = false;
  for (std::size_t k = 1; k <= n; ++k) {
    rises = rises || v[k] - v[k - 1] > noise;
    falls = falls || v[k - 1] - v[k] > noise;
  }
  if (rises && falls) {
    const double before = range_of(v.first(v.size() - half)), now = range_of(v.last(half + 1));
    const double growth = std::max(1.0, now / std::max(before, noise));
    approach.remaining = std::isfinite(growth) ? now * growth * growth : now;
    return approach;
  }
  approach.remaining = 0;
  for (const std::size_t length : {std::max<std::size_t>(1, half / 4), half}) {
    const std::optional<double> rest = geometric_rest(v, length, noise);
    if (!rest || !approach.remaining) {
      approach.remaining.reset();
    } else {
      approach.remaining = std::max(*approach.remaining, *rest);
    }
  }
  // A single ratio may be that of a faster motion, which dies away in it: none below a tenth is assumed.
  if (const double change = std::abs(v[n] - v[n - 1]); n == 2 && approach.remaining && change > noise)
    approach.remaining = std::max(*approach.remaining, change / 9);
  return approach;
}

Periods find_periods(const Model& model, const std::vector<CycleRecord>& cycles, const SpeedRecorder& speed,
                     const RunOutcome& outcome, double tolerance) {
  Periods periods;
  periods.run_down_begin = speed.off_since();
  const DrivenTime d = driven_time(model, cycles, speed, periods, outcome);
  judge_steadiness(model, d, tolerance, periods);
  if (periods.steady && !speed.driven().empty()) find_run_up(model, speed.driven(), d, tolerance, periods);
  if (periods.steady) periods.steady_speed = d.speed;
  if (periods.run_down_begin) find_standstill(model, speed.coasting(), outcome, tolerance, periods);
  return periods;
}

}  // namespace kurbel
