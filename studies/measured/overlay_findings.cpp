// overlay_findings.cpp — comparison of a measurement with the simulation in tables, plots, JSON and a line on the terminal.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/tables/heading.h"
#include "studies/answers/measured_names.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/plots.h"
#include "studies/measured/overlay.h"

namespace kurbel {
namespace {

// A row of the table: a signal over a model.
struct Row {
  const MeasuredSignal* signal;
  const ModelOverlay* model;
  const Residuals* left;
};

std::vector<Row> rows_of(const Overlay& o) {
  std::vector<Row> rows;
  for (std::size_t k = 0; k < o.measurement.signals.size(); ++k)
    for (const ModelOverlay& m : o.models) rows.push_back({&o.measurement.signals[k], &m, &m.alignment.signals[k]});
  return rows;
}

// A speed in the scene's unit; without an error if unknown.
std::string reported(const Estimate& value, const std::string& unit, const SpeedUnit& speed) {
  const FigureCells cells = figure_cells(value, unit, speed);
  return cells.value + (value.error ? " " + cells.error : "") + (cells.unit.empty() ? "" : " " + cells.unit);
}

std::string percent(const std::optional<double>& share) { return share ? fmt::format("{:.3g} %", 100 * *share) : "—"; }

Rows table_of(const Overlay& o) {
  auto table =
      kurbel::table_of("", fmt::format("{} over the simulation: measured − simulated", o.measurement.file), rows_of(o))
          .headed("measured, " + o.measurement.file)
          .text_in(2)
          .only_for_people("column → channel",
                           [](const Row& r) { return fmt::format("{} → {}", r.signal->column, r.signal->channel); })
          .only_for_people("model", [](const Row& r) { return r.model->label; })
          .only_for_people("points", [](const Row& r) { return r.left->time.size(); })
          .only_for_people("rms", [&](const Row& r) { return short_text(r.left->rms, r.signal->unit, o.speed); })
          .only_for_people("of the range", [](const Row& r) { return percent(r.left->relative); })
          .only_for_people("largest",
                           [&](const Row& r) { return short_text(r.left->largest, r.signal->unit, o.speed); })
          .only_for_people("at", [](const Row& r) { return short_text(r.left->at, "s"); });
  return table.only_for_people("offset",
                               [&](const Row& r) { return reported(r.left->offset, r.signal->unit, o.speed); });
}

std::string shift_in_words(const Overlay& o, const ModelOverlay& m) {
  if (o.measurement.over_angle && !o.measurement.shift.fit)
    return m.label + " model: laid over it by the link's angle; time 0: the link passes its zero";
  return fmt::format("{} model: simulated time = measured time {} {}{}{}", m.label,
                     m.alignment.shift.value < 0 ? "−" : "+", reported(abs(m.alignment.shift), "s", {}),
                     o.measurement.shift.fit ? ", found by least squares" : "",
                     o.of_cycle ? "; time 0: the link passes its zero" : "");
}

std::vector<std::string> words_of(const Overlay& o) {
  std::vector<std::string> lines;
  for (const ModelOverlay& m : o.models) lines.push_back(shift_in_words(o, m));
  return lines;
}

// Lines for the short form.
std::vector<std::string> short_words(const Overlay& o) {
  constexpr std::size_t most = 3;
  std::vector<std::string> lines;
  const std::vector<Row> rows = rows_of(o);
  for (std::size_t i = 0; i < rows.size() && i < most; ++i) {
    const Row& r = rows[i];
    const auto in_short = [&](double value) { return short_text(value, r.signal->unit, o.speed); };
    lines.push_back(fmt::format("measured − simulated, {}: rms {}{}, largest {} at {}", r.signal->channel,
                                in_short(r.left->rms),
                                r.left->relative ? fmt::format(" ({} of its range)", percent(r.left->relative)) : "",
                                in_short(r.left->largest), short_text(r.left->at, "s")));
  }
  if (rows.size() > most) lines.push_back(fmt::format("{} more columns: --all, or the report", rows.size() - most));
  const Alignment& a = o.models.back().alignment;
  if (a.shift.error) lines.push_back("record shifted by " + reported(a.shift, "s", {}));
  return lines;
}

// --- plots ---

// Points of a record that covers a cycle more than once are markers, else a line.
Series measured_series(const Residuals& r, const std::vector<double>& y, const std::string& name, Role role) {
  std::vector<std::size_t> order(r.time.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const bool ascends = std::is_sorted(r.time.begin(), r.time.end());
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return r.time[a] < r.time[b]; });
  Series series{.name = name, .role = role};
  for (const std::size_t i : order) series.x.push_back(r.time[i]), series.y.push_back(y[i]);
  return ascends ? series : marks(std::move(series));
}

Axis time_axis(const Overlay& o) { return {o.of_cycle ? "time in the cycle" : "time", "s"}; }

Plot overlay_plot(const Overlay& o, std::size_t k) {
  const MeasuredSignal& s = o.measurement.signals[k];
  const Residuals& last = o.models.back().alignment.signals[k];
  Plot plot{.title = fmt::format("{} measured and simulated: {} rms between them", s.channel,
                                 short_text(last.rms, s.unit, o.speed)),
            .x = time_axis(o),
            .y = {s.channel, ""}};
  const auto [from, to] = std::minmax_element(last.time.begin(), last.time.end());
  for (const ModelOverlay& m : o.models) {
    const Signal& signal = m.simulated[k];
    Series series{.name = m.label, .role = m.role};
    for (std::size_t i = 0; i < signal.time().size(); ++i)
      if (o.of_cycle || (signal.time()[i] >= *from && signal.time()[i] <= *to))
        series.add(signal.time()[i], signal.value()[i]);
    plot.series.push_back(std::move(series));
  }
  plot.series.push_back(dashed(measured_series(last, last.measured, "measured", Role::reference)));
  plot.note = fmt::format(
      "Column {} of {}{}.", s.column, o.measurement.file,
      last.offset.value != 0 ? fmt::format(", {} taken off", reported({last.offset.value}, s.unit, o.speed)) : "");
  return in_readable_unit(std::move(plot), s.unit, o.speed);
}

Plot residual_plot(const Overlay& o, std::size_t k) {
  const MeasuredSignal& s = o.measurement.signals[k];
  const Residuals& last = o.models.back().alignment.signals[k];
  Plot plot{.title = fmt::format("Residual of {}: at most {} at {}", s.channel,
                                 short_text(std::abs(last.largest), s.unit, o.speed), short_text(last.at, "s")),
            .x = time_axis(o),
            .y = {"measured − simulated", ""}};
  for (const ModelOverlay& m : o.models) {
    const Residuals& r = m.alignment.signals[k];
    std::vector<double> left;
    for (std::size_t i = 0; i < r.time.size(); ++i) left.push_back(r.measured[i] - r.simulated[i]);
    plot.series.push_back(measured_series(r, left, m.label, m.role));
  }
  return in_readable_unit(std::move(plot), s.unit, o.speed);
}

std::vector<Plot> plots_of(const Overlay& o) {
  std::vector<Plot> plots;
  for (std::size_t k = 0; k < o.measurement.signals.size(); ++k) {
    plots.push_back(overlay_plot(o, k));
    plots.push_back(residual_plot(o, k));
  }
  return plots;
}

// --- for programs ---

Record signal_record(const Overlay& o, const ModelOverlay& m, std::size_t k) {
  const MeasuredSignal& s = o.measurement.signals[k];
  const Residuals& r = m.alignment.signals[k];
  return {{"column", s.column},
          {"channel", s.channel},
          {"unit", s.unit},
          {"points", r.time.size()},
          {"rms", r.rms},
          {"mean", r.mean},
          {"relative", r.relative},
          {"largest", r.largest},
          {"at", r.at},
          {"offset", r.offset.value},
          {"offset_error", r.offset.error},
          {"offset_found", s.offset.fit}};
}

Record model_record(const Overlay& o, const ModelOverlay& m) {
  return {{"label", m.label},
          {"shift", m.alignment.shift.value},
          {"shift_error", m.alignment.shift.error},
          {"shift_found", o.measurement.shift.fit},
          {"signals",
           each(numbers_below(o.measurement.signals.size()), [&](std::size_t k) { return signal_record(o, m, k); })}};
}

}  // namespace

void show(Findings& f, const Overlay& o) {
  const Chapter in = f.chapter_named(chapter_of_measurement);
  f.record("measured", Record{{"file", o.measurement.file},
                              {"models", each(o.models, [&](const ModelOverlay& m) { return model_record(o, m); })},
                              {"notes", o.notes}});
  f.say(in, Sentences{.lines = o.notes, .indent = "note: "});
  if (f.brief)
    for (const std::string& note : o.notes) f.brief->words.push_back(note);
  if (o.models.empty()) return;
  f.draw(in, [&o] { return plots_of(o); });
  f.say(in, table_of(o));
  f.say(in, Sentences{.lines = words_of(o), .indent = "  "});
  if (!f.brief) return;
  for (std::string& line : short_words(o)) f.brief->words.push_back(std::move(line));
}

namespace {

// Cycles and a measured record compared with them.
struct MeasuredCycles {
  SteadyStudy study;
  std::optional<Overlay> overlay = {};
};
Findings findings_of(const MeasuredCycles& measured) {
  Findings findings = findings_of(measured.study);
  if (measured.overlay) show(findings, *measured.overlay);
  return findings;
}

}  // namespace

StudyOutput cycles_under(const MeasurementRequest& request, const Scene& scene, const std::vector<Effects>& effects,
                         SteadyOptions options) {
  std::optional<Measurement> measurement;
  if (request.asked()) {
    MeasurementRequest asked = request;
    if (std::any_of(asked.maps.begin(), asked.maps.end(), [](const std::string& map) {
          return name_with_unit(map.substr(map.find('=') + 1)).name == "angle";
        }))
      asked.over = "angle", asked.over_unit = "rad";
    measurement = read_measurement(asked, channels_of_cycle(*compile(scene, effects.back())));
    options.traces = true;
  }
  MeasuredCycles cycles{steady(scene, effects, options)};
  if (measurement) cycles.overlay = lay_over(*measurement, cycles.study);
  return output_of(std::move(cycles));
}

}  // namespace kurbel
