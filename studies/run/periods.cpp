// periods.cpp — from the mid speeds of cycles, and from the last time outside a band.
#include "studies/run/periods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/return_map/periodicity.h"
#include "studies/answers/run_claims.h"
#include "studies/duty/work_periods.h"

namespace kurbel {
namespace {

constexpr double least_reported = 1e-6;  // of a speed: nearer to its limit nobody asks
constexpr double near_steady = 0.01, at_rest = 1e-3, steady_within = 1e-3;
constexpr double part_of_range = 0.05;  // the margin of a cycle's range
// Of a machine without a cycle: intervals from which on its limit is that of its angles; part of what lacks by which it may be
// unsure; deviation of the speed from its mean that is a vibration.
constexpr std::size_t least_angles = 64;
constexpr double most_unsure = 0.2, vibrates_from = 1e-4;
constexpr double nowhere = 1e3;  // times the speed: a limit so far away is rounding
// Works of cycles that differ by less, over the largest, are alike, or nearly so, or unlike; several cycles are one period
// where they leave a tenth of what single ones differ by, or what the mid speeds change by a tenth of their range. Below this
// part of the energy works are none.
constexpr double alike = 1e-3, nearly_alike = 0.01, unlike_from = 0.05, far_less = 0.1, least_work = 1e-4;
constexpr std::size_t parts_without_cycle = 16, least_means = 3;
// Scatter of the mid speed between cycles for a local tolerance, as a multiple of it; never more than most_noise.
constexpr double noise_of_tolerance = 30, most_noise = 1e-5;

// Angles at equal intervals within a time.
std::span<const double> angles_within(const SpeedRecorder& speed, double begin, double end) {
  const std::vector<double>& angle = speed.angles();
  if (angle.empty() || !(speed.interval() > 0)) return {};
  const std::size_t last = std::min(angle.size() - 1, static_cast<std::size_t>(end / speed.interval() * (1 + 1e-12)));
  const auto first = static_cast<std::size_t>(std::ceil(begin / speed.interval() * (1 - 1e-12)));
  return last > first ? std::span(angle).subspan(first, last - first + 1) : std::span<const double>();
}

// The means of a machine without a cycle: angle over time.
std::vector<double> means_of_parts(std::span<const double> angle, double interval) {
  std::vector<double> means;
  const std::size_t last = angle.empty() ? 0 : angle.size() - 1, part = last / parts_without_cycle;
  if (part == 0) return means;
  for (std::size_t k = last % part; k + part <= last; k += part)
    means.push_back((angle[k + part] - angle[k]) / (static_cast<double>(part) * interval));
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

// Data for the judgement, of one section.
struct DrivenTime {
  DrivenPart of;
  std::vector<CycleRecord> cycles = {}, by_time = {};  // whole ones within it
  std::vector<double> means = {};                      // of its sixteenths [rad/s], where there are neither
  std::span<const double> angles = {};                 // then, at intervals [rad]
  std::optional<CycleRecord> last = {};                // the last period; before it is known, the last cycle
  double speed = 0;       // its mid speed, or the speed at the end of the driven time [rad/s]
  double unlike = 0;      // works of the last periods, over the largest
  bool vibrates = false;  // without a cycle: `speed` is its mean
  bool is_long_enough() const { return std::max({cycles.size(), by_time.size(), means.size()}) >= least_means; }
};

DrivenTime data_of(const DrivenPart& section, const Model& model, const LinkHistory& link) {
  DrivenTime d{.of = section};
  const CycleRecord* last = nullptr;
  const auto within = [&](const std::vector<CycleRecord>& all) {
    std::vector<CycleRecord> list;
    for (const CycleRecord& c : all) {
      if (c.end > section.end) break;
      if (!last || c.end >= last->end) last = &c;
      if (c.begin >= section.begin) list.push_back(c);
    }
    return list;
  };
  d.by_time = within(link.by_time);
  d.cycles = within(link.cycles);
  if (last) d.last = *last;
  if (model.cycle == 0 && clock_of(model) == 0) {
    d.angles = angles_within(link.speed, section.begin, section.end);
    d.means = means_of_parts(d.angles, link.speed.interval());
  }
  d.speed = d.last ? d.last->mid_speed() : link.speed.driven().empty() ? 0 : link.speed.driven().last();
  return d;
}

// A section before a drive was started says nothing about the motion after that.
DrivenTime driven_time(const Model& model, const LinkHistory& link, const Periods& periods) {
  const double end = periods.run_down_begin.value_or(link.outcome.t);
  const std::vector<DrivenPart> list = sections_of(model, link.switchings, link.outcome.events, end);
  const double started = list.back().started;
  for (auto section = list.rbegin(); section != list.rend(); ++section) {
    if (started > 0 && section->end <= started) break;
    if (DrivenTime d = data_of(*section, model, link); d.is_long_enough()) {
      d.of.started = started;
      return d;
    }
  }
  return data_of(list.back(), model, link);
}

// Of the mid speeds of cycles n apart, for each of the n sequences that they are; the worst counts.
Approach approach_of_each(std::size_t n, const std::vector<CycleRecord>& cycles, double noise) {
  Approach worst;
  for (std::size_t before = 0; before < n; ++before) {
    std::vector<double> middle, mid;
    for (std::size_t k = (cycles.size() - 1 - before) % n; k + before < cycles.size(); k += n) {
      middle.push_back(0.5 * (cycles[k].begin + cycles[k].end));
      mid.push_back(cycles[k].mid_speed());
    }
    const Approach one = approach_of(at_equal_times(middle, mid), noise);
    if (before == 0)
      worst = one;
    else if (worst.remaining)
      worst.remaining = one.remaining ? std::optional(std::max(*worst.remaining, *one.remaining)) : std::nullopt;
  }
  return worst;
}

// The largest difference of works between cycles n apart, among the last ones, over the largest work.
double unlike(std::size_t n, std::size_t among, const Model& m, const std::vector<CycleRecord>& cycles,
              double least = least_work) {
  double most = 0, largest = 0;
  for (std::size_t k = cycles.size() - among + n; k < cycles.size(); ++k) {
    const std::array<double, 4> here = works_by_kind(m, cycles[k].work), before = works_by_kind(m, cycles[k - n].work);
    largest = std::max(largest, least * std::abs(cycles[k].energy_before));
    for (std::size_t i = 0; i < here.size(); ++i) {
      most = std::max(most, std::abs(here[i] - before[i]));
      largest = std::max({largest, std::abs(here[i]), std::abs(before[i])});
    }
  }
  return largest > 0 ? most / largest : 0;
}

// Of the last n: what dies away must not count as a part of the period.
double range_of_mids(std::size_t n, const std::vector<CycleRecord>& cycles) {
  std::vector<double> mid;
  for (std::size_t k = cycles.size() - n; k < cycles.size(); ++k) mid.push_back(cycles[k].mid_speed());
  return range_of(mid);
}

// Of the clock; of a clocked sequence whose repetitions begin late, the time between them.
double time_of_period(const Model& model, const DrivenTime& d) {
  constexpr double same = 1e-9;
  const double clock = clock_of(model);
  if (d.by_time.empty()) return clock;
  const double last = d.by_time.back().end - d.by_time.back().begin;
  return std::abs(last - clock) <= same * clock ? clock : last;
}

// The period of the motion, if it is steady by one; else single cycles. Empty: too few of them.
std::optional<Approach> find_period(const Model& model, double tolerance, DrivenTime& d, Periods& periods) {
  const double noise = std::min(noise_of_tolerance * tolerance, most_noise) * std::abs(d.speed);
  const std::vector<CycleRecord>& usual = model.cycle > 0 ? d.cycles : d.by_time;
  std::optional<Approach> best;
  if (usual.size() >= least_means) best = approach_of_each(1, usual, noise);
  if (d.means.size() >= least_means) best = approach_of(d.means, noise);
  const std::vector<CycleRecord>* found =
      nullptr;  // cycles or periods of time, of which several in a row are the period
  std::size_t several = 0;
  for (const auto* list : {&d.cycles, &d.by_time})
    for (std::size_t n = 1; n <= most_cycles_of_a_period && least_means * n <= list->size(); ++n) {
      const Approach approach = approach_of_each(n, *list, noise);
      if (!approach.remaining || *approach.remaining > steady_within * std::abs(d.speed)) continue;
      if (found) {
        const double since = (*list)[list->size() - least_means * n].begin;
        const auto in_same_time = static_cast<std::size_t>(
            std::count_if(found->begin(), found->end(), [&](const CycleRecord& c) { return c.begin >= since; }));
        const double differ = unlike(several, std::max(least_means * several, in_same_time), model, *found);
        const double rest = unlike(n, least_means * n, model, *list);
        if (differ <= alike || rest > std::max(alike, std::min(nearly_alike, far_less * differ))) continue;
      } else if (n > 1 && *approach.remaining > far_less * range_of_mids(n, *list)) {
        continue;
      }
      best = approach, found = list, several = n;
    }
  if (found) {
    periods.cycles = static_cast<int>(several), periods.time = found == &d.by_time ? time_of_period(model, d) : 0;
    d.unlike = unlike(several, least_means * several, model, *found, 10 * least_work);
  }
  if (const auto whole = in_periods(periods.time > 0 ? d.by_time : d.cycles, periods.cycles); !whole.empty())
    d.last = whole.back(), d.speed = d.last->mid_speed();
  return best;
}

// Of the last speed v to its limit. A rising speed is stated from the limit, a falling one from where it is: a limit of
// zero has no parts.
std::string remaining_in_words(const Approach& approach, double v, bool steady, int digits = 3) {
  const double rest = *approach.remaining, now = std::abs(v);
  const auto percent = [&](double part) { return fmt::format("{:.{}g} %", 100 * part, digits); };
  if (steady) return fmt::format("is within {} of its final value", percent(std::max(rest / now, least_reported)));
  if (approach.alternates) return "still varies by up to " + percent(rest / now);
  if (approach.last_change * v > 0)
    return fmt::format("is still {} below its final value", percent(rest / (now + rest)));
  return fmt::format("is still to fall by {}{}", percent(rest / now), rest > now ? ", to beyond zero" : "");
}

std::string growing_in_words(const char* speed, double change, const std::string& unit) {
  return fmt::format("the {} speed changes by {:+.2g} % per {}, and this change does not decrease", speed, 100 * change,
                     unit);
}

// Without a cycle and without laws over time.
void judge_by_angles(const LinkHistory& link, double tolerance, DrivenTime& d, Periods& periods) {
  const double scale = std::abs(d.speed), interval = link.speed.interval();
  const SpeedLimit found =
      limit_of_speed(d.angles, std::min(noise_of_tolerance * tolerance, most_noise) * scale * interval);
  const double lacks = std::abs(found.limit - found.speed) / interval, unsure = found.unsure / interval;
  const double before = d.means[d.means.size() - 2],
               change = (d.means.back() - before) / std::max(scale, std::abs(before));
  const bool known = found.kind == SpeedLimit::Kind::known;
  periods.steady = known && lacks + unsure <= steady_within * scale;
  periods.without_limit = found.kind == SpeedLimit::Kind::grows;
  if (periods.steady || (known && unsure <= most_unsure * lacks)) {
    const Approach approach{.last_change = found.change, .remaining = lacks + (periods.steady ? unsure : 0)};
    periods.remaining = approach.remaining;
    periods.verdict = "the speed " + remaining_in_words(approach, d.speed, periods.steady, 2);
    d.vibrates = periods.steady && std::abs(d.speed - found.speed / interval) > vibrates_from * scale;
    if (d.vibrates) d.speed = found.speed / interval;
  } else if (periods.without_limit) {
    periods.verdict = growing_in_words("mean", change, "sixteenth of the time");
  } else {
    periods.unsettled = true;
    periods.verdict =
        fmt::format("the mean speed still changes, by {:+.2g} % in the last sixteenth of the time", 100 * change);
  }
}

void judge_steadiness(const Model& model, const LinkHistory& link, double tolerance, DrivenTime& d, Periods& periods) {
  if (model.cycle == 0) periods.time = time_of_period(model, d);
  const bool in_parts = model.cycle == 0 && periods.time == 0;
  const std::string length = periods.time > 0 ? fmt::format(" of {:.6g} s", periods.time) : "";
  const std::string unit = in_parts ? "sixteenth of the time" : (model.cycle > 0 ? "cycle" : "period") + length;
  const char* speed = in_parts ? "mean" : "mid";
  const std::size_t whole = model.cycle > 0 ? d.cycles.size() : d.by_time.size();
  const std::optional<Approach> approach = find_period(model, tolerance, d, periods);
  if (!approach) {
    periods.verdict = in_parts ? "too short a time to decide"
                               : fmt::format("{} whole {}{}{}{}, of at least 3 needed", whole,
                                             model.cycle > 0 ? "cycle" : "period", whole == 1 ? "" : "s", length,
                                             d.of.begin > 0 ? fmt::format(" since {:.6g} s", d.of.begin) : "");
    return;
  }
  const double scale = std::abs(d.speed);
  if (!(scale > at_rest * at_rest * model.speed_scale)) {
    periods.verdict = "it stands still";
    return;
  }
  if (in_parts && d.angles.size() > least_angles && d.means.size() > 1)
    return judge_by_angles(link, tolerance, d, periods);
  if (approach->remaining) periods.remaining = *approach->remaining;
  periods.steady = approach->remaining && *approach->remaining <= steady_within * scale;
  const double change = approach->last_change / scale;
  periods.without_limit = !approach->remaining || *approach->remaining > nowhere * scale;
  if (periods.without_limit)
    periods.verdict = growing_in_words(speed, change, unit);
  else
    periods.verdict = fmt::format("the {} speed {}", speed, remaining_in_words(*approach, d.speed, periods.steady));
  if (const std::string period = period_in_words(periods, model.cycle); periods.steady && !period.empty())
    periods.verdict = fmt::format("the speed repeats every {}, and {}", period, periods.verdict);
  if (periods.steady && d.unlike > unlike_from)
    periods.verdict += fmt::format(", but the works of its last three {} differ by up to {:.2g} %",
                                   periods.cycles > 1 || periods.time > 0 ? "periods" : "cycles", 100 * d.unlike);
}

// Margins of the range of the steady motion, in the order in which they are tried: 1 % of the speed hides a run-up where
// the speed fluctuates by no more, and a twentieth of the fluctuation is left by a motion that differs between cycles.
std::vector<double> margins_of(const DrivenTime& d) {
  const double speed = std::abs(d.speed), widest = near_steady * speed;
  if (!d.last && d.vibrates) return {widest, 2 * widest, 5 * widest, 10 * widest, 20 * widest, 50 * widest};
  if (!d.last) return {widest};
  const double narrow = part_of_range * (d.last->omega_max - d.last->omega_min);
  return {std::clamp(narrow, steady_within * speed, widest), widest};
}

void find_run_up(const Model& model, const LinkHistory& link, const DrivenTime& d, double tolerance, Periods& periods) {
  const BandHistory& speed = link.speed.driven();
  // A vibration must stay within the range for a sixteenth of the time.
  const double begin = d.last       ? d.last->begin
                       : d.vibrates ? d.of.end - (d.of.end - d.of.begin) / static_cast<double>(parts_without_cycle)
                                    : d.of.end;
  double low = 0, high = 0;
  std::optional<double> entry;
  for (const double margin : margins_of(d)) {
    low = (d.last ? d.last->omega_min : d.speed) - margin;
    high = (d.last ? d.last->omega_max : d.speed) + margin;
    entry = speed.last_outside(low, high);
    if (!entry || *entry <= begin) break;
  }
  if (entry && *entry > begin) {
    periods.steady = periods.without_limit = false;
    periods.verdict = fmt::format("{} the speed leaves its range, at {:.6g} s",
                                  d.last ? "after the last whole cycle" : "after the last command", *entry);
    return;
  }
  if (d.of.started > std::max(link.begin, entry.value_or(link.begin))) {
    periods.run_up_end = d.of.started;
    return;
  }
  periods.run_up_end = entry;
  if (!entry) return;
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

Periods find_periods(const Model& model, const LinkHistory& link, double tolerance) {
  Periods periods;
  periods.run_down_begin = link.speed.off_since();
  if (model.scene.sequence.repeat && periods.run_down_begin > link.outcome.t - clock_of(model))
    periods.run_down_begin.reset();  // a pause of a drive that is switched by the clock
  DrivenTime d = driven_time(model, link, periods);
  judge_steadiness(model, link, tolerance, d, periods);
  if (d.of.started >= periods.run_down_begin.value_or(link.outcome.t)) {
    periods.steady = false;
    periods.verdict = fmt::format("what drives is still being started, until {:.6g} s", d.of.started);
  }
  if (periods.steady && !link.speed.driven().empty()) find_run_up(model, link, d, tolerance, periods);
  if (periods.steady) periods.steady_speed = d.speed;
  periods.judged_until =
      periods.steady && d.last ? d.last->end : periods.run_down_begin.value_or(std::numeric_limits<double>::infinity());
  if (!periods.steady) periods.cycles = 1, periods.time = 0;
  if (periods.run_down_begin) find_standstill(model, link.speed.coasting(), link.outcome, tolerance, periods);
  return periods;
}

std::vector<CycleRecord> in_periods(const std::vector<CycleRecord>& cycles, int in_a_row, double until) {
  const auto n = static_cast<std::size_t>(in_a_row);
  const auto count = static_cast<std::size_t>(
      std::find_if(cycles.begin(), cycles.end(), [&](const CycleRecord& c) { return c.end > until; }) - cycles.begin());
  std::vector<CycleRecord> periods;
  for (std::size_t k = count % n; k + n <= count; k += n) {
    CycleRecord period = cycles[k];
    for (std::size_t j = 1; j < n && cycles[k + j].begin == period.end; ++j) period.append(cycles[k + j]);
    if (period.end == cycles[k + n - 1].end) periods.push_back(std::move(period));
  }
  return periods;
}

double drift_of(const CycleRecord& last, const CycleRecord& before, double tolerance) {
  const auto range = [](const CycleRecord& c) { return std::abs(c.omega_max - c.omega_min); };
  const double change =
      std::max(std::abs(last.mid_speed() - before.mid_speed()), std::abs(range(last) - range(before)));
  if (change <= noise_of_tolerance * tolerance * std::abs(last.mid_speed())) return 0;
  return change / range(last);
}

}  // namespace kurbel
