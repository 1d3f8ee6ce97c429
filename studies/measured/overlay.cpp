// overlay.cpp — signals from runs and cycles; residuals as figures.
#include "studies/measured/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "engine/run/recorders.h"
#include "studies/answers/measured_names.h"
#include "studies/findings/thin.h"
#include "studies/findings/trace.h"
#include "studies/run/compare.h"
#include "studies/tables/trajectory_rows.h"

namespace kurbel {
namespace {

std::vector<KnownChannel> known(const Model& model, const std::vector<std::string>& components,
                                const std::function<bool(const Channel&)>& has) {
  std::vector<KnownChannel> list;
  for (const Channel& c : channels_of(model, components))
    if (has(c)) list.push_back({c.name.text, c.unit});
  return list;
}

// Points in order of time; of two at the same time the later one comes last.
struct Points {
  std::vector<double> time, value;
  void add(double t, double v) { time.push_back(t), value.push_back(v); }
  Signal signal(std::optional<double> period = {}) const {
    std::vector<std::size_t> order(time.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return time[a] < time[b]; });
    std::vector<double> t, v;
    for (const std::size_t i : order) t.push_back(time[i]), v.push_back(value[i]);
    return {std::move(t), std::move(v), period};
  }
};

// The last whole period of a cycle, from the zero of the link's angle.
std::optional<Signal> signal_of(const SteadyCycle& c, const std::string& channel) {
  if (!c.found || !c.traces || c.traces->last_cycles.empty()) return {};
  const Trace* trace = c.traces->find(channel);
  const double end = c.traces->last_cycles.back().end, begin = end - c.cycle_time;
  if (!trace || trace->x.size() < 2) return {};
  const Signal all(trace->x, trace->y);
  Points points;
  points.add(0, all.at(begin));
  for (std::size_t i = 0; i < trace->x.size(); ++i)
    if (trace->x[i] > begin && trace->x[i] < end) points.add(trace->x[i] - begin, trace->y[i]);
  points.add(c.cycle_time, all.at(end));
  return points.signal(c.cycle_time);
}

void add_figures(std::vector<Figure>& figures, const Measurement& m, const Alignment& a) {
  const auto add = [&](const std::string& name, const Estimate& value, const std::string& unit,
                       std::optional<double> at = {}) {
    Figure figure = Figure::of_name(Name{quantities::other, "", name}, value.value, unit);
    figure.error = value.error, figure.at = at;
    figures.push_back(std::move(figure));
  };
  if (a.shift.error || a.shift.value != 0) add("measured_shift", a.shift, "s");
  for (std::size_t k = 0; k < m.signals.size(); ++k) {
    const MeasuredSignal& s = m.signals[k];
    const Residuals& r = a.signals[k];
    add("residual_rms." + s.channel, {r.rms}, s.unit);
    add("residual_largest." + s.channel, {r.largest}, s.unit, r.at);
    if (r.relative) add("residual_relative." + s.channel, {*r.relative}, "");
    if (r.offset.error || r.offset.value != 0) add("measured_offset." + s.channel, r.offset, s.unit);
  }
}

constexpr std::size_t most_drawn = 16'000;

Trace trace_of(const MeasuredSignal& s, std::vector<double> x, std::vector<double> y) {
  Trace trace{.name = measured_trace(s.channel), .unit = s.unit, .x = std::move(x), .y = std::move(y)};
  thin_by_extremes(trace.x, trace.y, most_drawn);
  return trace;
}

// For a cycle whose mean speed differs from the record's; empty: it does not, or the record has no speed.
std::string other_speed(const SteadyCycle& c, const Measurement& m, const Alignment& a) {
  constexpr double alike = 0.01;
  const auto mean = [](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  };
  for (std::size_t k = 0; k < m.signals.size(); ++k) {
    const Residuals& r = a.signals[k];
    if (!m.signals[k].channel.starts_with("speed.") || r.measured.empty()) continue;
    const double here = mean(r.simulated), record = mean(r.measured) + r.offset.value;
    if (!(std::abs(here - record) > alike * std::abs(record))) continue;
    const SpeedUnit& unit = c.model->scene.speed_unit;
    return fmt::format(
        "{} model: its {} is {} on average, the record's {}: torques and fluctuations are those of another "
        "speed; --mean-speed finds the cycle at that of the record",
        c.label, m.signals[k].channel, unit.text(here, 4), unit.text(record, 4));
  }
  return {};
}

std::string none_in_common(const Measurement& m) {
  return fmt::format("{} is not laid over it: {}", m.file,
                     m.shift.fit ? "no shift can be found of what does not vary" : "there is no time in common");
}

// Over the link's angle in the last whole cycle.
void add_over_angle(SteadyCycle& c, const Measurement& m, const Alignment& a) {
  const auto angle = signal_of(c, "angle");
  if (!angle) return;
  const auto traces = std::make_shared<Traces>(*c.traces);
  for (std::size_t k = 0; k < m.signals.size(); ++k) {
    std::vector<double> x;
    for (const double t : a.signals[k].time) {
      const double turned = angle->at(t) - angle->at(0);
      x.push_back(turned - c.model->cycle * std::floor(turned / c.model->cycle));
    }
    traces->last_cycles.back().traces.push_back({.name = measured_trace(m.signals[k].channel),
                                                 .unit = m.signals[k].unit,
                                                 .x = std::move(x),
                                                 .y = a.signals[k].measured});
  }
  c.traces = traces;
}

// A record over the link's angle, in the time of the cycle. Empty: the link turns back, and passes an angle repeatedly.
std::optional<Measurement> in_time(Measurement m, const SteadyCycle& c) {
  if (!m.over_angle) return m;
  const auto angle = signal_of(c, "angle");
  if (!angle || !std::is_sorted(angle->value().begin(), angle->value().end())) return {};
  const Signal time(angle->value(), angle->time());
  for (double& at : m.time) {
    const double turned = at + m.shift.value, whole = std::floor(turned / c.model->cycle);
    at = whole * c.cycle_time + time.at(angle->value().front() + turned - whole * c.model->cycle);
  }
  m.shift.value = 0;
  return m;
}

}  // namespace

Signal signal_of(const Result& r, const std::string& channel) {
  Points points;
  const double end = r.trajectory->time().back();
  if (const Trace* trace = r.traces ? r.traces->find(channel) : nullptr)
    for (std::size_t i = 0; i < trace->x.size(); ++i)
      if (trace->x[i] <= end) points.add(trace->x[i], trace->y[i]);
  const auto& channels = r.trajectory->channels();
  const auto found =
      std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == channel; });
  const auto k = static_cast<std::size_t>(found - channels.begin());
  for_each_row(*r.trajectory, [&](double t, std::span<const double> values) { points.add(t, values[k]); });
  return points.signal();
}

std::vector<KnownChannel> channels_of_run(const Model& model) {
  return known(model, model.scene.run.output, [](const Channel&) { return true; });
}

std::vector<KnownChannel> channels_of_cycle(const Model& model) {
  return known(
      model, model.network.components.size() > 60 ? std::vector<std::string>{} : model.network.components,
      [](const Channel& c) { return c.name.what != quantities::angle && c.name.what != quantities::spring_torque; });
}

Overlay lay_over(const Measurement& measurement, Result& run) {
  Overlay overlay{.measurement = measurement, .models = {}};
  if (measurement.rows_left_out > 0) overlay.notes.push_back(measurement.gaps());
  overlay.speed = run.model->scene.speed_unit;
  ModelOverlay model{.label = run.label, .simulated = {}, .alignment = {}};
  if (!is_elastic(*run.model)) model.role = Role::rigid;
  if (!run.trajectory || run.trajectory->time().size() < 2) {
    overlay.notes.push_back(
        fmt::format("{} is not laid over it: the run broke off at its beginning", measurement.file));
    return overlay;
  }
  for (const MeasuredSignal& s : measurement.signals) model.simulated.push_back(signal_of(run, s.channel));
  const std::optional<Alignment> alignment = align(measurement, model.simulated);
  if (!alignment) {
    overlay.notes.push_back(none_in_common(measurement));
    return overlay;
  }
  add_figures(run.figures, measurement, *alignment);
  if (run.traces) {
    const auto traces = std::make_shared<Traces>(*run.traces);
    for (std::size_t k = 0; k < measurement.signals.size(); ++k)
      traces->over_time.push_back(
          trace_of(measurement.signals[k], alignment->signals[k].time, alignment->signals[k].measured));
    run.traces = traces;
  }
  model.alignment = *alignment;
  overlay.models.push_back(std::move(model));
  return overlay;
}

Overlay lay_over(const Measurement& measurement, SteadyStudy& study) {
  Overlay overlay{.measurement = measurement, .models = {}, .of_cycle = true};
  if (measurement.rows_left_out > 0) overlay.notes.push_back(measurement.gaps());
  for (SteadyCycle& c : study.cycles) {
    overlay.speed = c.model->scene.speed_unit;
    ModelOverlay model{.label = c.label, .simulated = {}, .alignment = {}};
    if (!is_elastic(*c.model)) model.role = Role::rigid;
    for (const MeasuredSignal& s : measurement.signals)
      if (auto signal = signal_of(c, s.channel)) model.simulated.push_back(std::move(*signal));
    if (model.simulated.size() < measurement.signals.size()) {
      overlay.notes.push_back(fmt::format("{} model: {} is not laid over it: it has no whole cycle of {}", c.label,
                                          measurement.file, measurement.signals.front().channel));
      continue;
    }
    const std::optional<Measurement> here = in_time(measurement, c);
    const std::optional<Alignment> alignment = here ? align(*here, model.simulated) : std::nullopt;
    if (!alignment) {
      overlay.notes.push_back(c.label + " model: " +
                              (here ? none_in_common(measurement)
                                    : measurement.file + " is not laid over it: its link turns back within the cycle"));
      continue;
    }
    if (std::string other = other_speed(c, *here, *alignment); !other.empty()) overlay.notes.push_back(other);
    add_figures(c.figures, *here, *alignment);
    add_over_angle(c, *here, *alignment);
    model.alignment = *alignment;
    overlay.models.push_back(std::move(model));
  }
  return overlay;
}

}  // namespace kurbel
