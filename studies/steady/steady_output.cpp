// steady_output.cpp — words, tables and plots of steady cycles.
#include "studies/steady/steady_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/json_text.h"
#include "studies/findings/text_table.h"
#include "studies/findings/trace.h"
#include "studies/run/run_report.h"

namespace kurbel {
namespace {

using Json = nlohmann::ordered_json;

constexpr double per_minute = 30 / std::numbers::pi, degrees = 180 / std::numbers::pi;

std::string number(double value, int digits = 7) { return fmt::format("{:.{}g}", value, digits); }
std::string percent(double part) { return fmt::format("{:.4g} %", 100 * part); }
Json optional_json(const std::optional<double>& v) { return v ? Json(*v) : Json(); }

Role role_of(const SteadyCycle& c) { return c.model->elastic.empty() ? Role::rigid : Role::elastic; }

std::string complex_text(std::complex<double> z) {
  if (z.imag() == 0) return fmt::format("{:.6g}", z.real());
  return fmt::format("{:.6g} {} {:.6g} i", z.real(), z.imag() < 0 ? "−" : "+", std::abs(z.imag()));
}

// --- words ---

std::vector<std::string> words_of(const SteadyCycle& c) {
  std::vector<std::string> words;
  if (!c.found) return {fmt::format("NOT found: {}", c.why)};
  words.push_back(c.stability);
  words.push_back(fmt::format(
      "{} unknown{} on the section at {:.4g}°; found in {} rounds ({} with derivative), {:.3g} cycles' worth ({:.0f} "
      "aimed at), {:.3g} ms; P(z) − z = {:.1e}; works of the cycle close to {:.1e}",
      c.unknowns, c.unknowns == 1 ? "" : "s", c.section * degrees, c.point.rounds, c.point.derivatives, c.cost,
      c.cost_limit, 1e3 * c.cpu_seconds, c.point.residual, c.work_residual));
  if (c.point.grazed)
    words.push_back("an event is only just touched on the way: there the multipliers depend on the side");
  for (const MotorUse& m : c.motors)
    words.push_back(fmt::format("drive \"{}\": torque {} in the mean, {} RMS, {} at most{}", m.component,
                                with_unit(m.mean, "N*m", 5), with_unit(m.rms, "N*m", 5), with_unit(m.peak, "N*m", 5),
                                m.rated ? fmt::format("; thermal use RMS/rated = {} of {}", percent(*m.thermal()),
                                                      with_unit(*m.rated, "N*m", 5))
                                        : ""));
  if (!c.added_at.empty())
    words.push_back(fmt::format("the demanded mean speed needs {} N·m beside the scene's drive at \"{}\"{}",
                                number(c.added_torque), c.added_at,
                                std::abs(c.added_torque) < 1e-6 * c.model->torque_scale
                                    ? ": nothing, the machine has a cycle of this speed as it is"
                                    : ""));
  return words;
}

// Rounding of differences beside the other slope reads as zero.
std::string beside(double value, double other) {
  return number(std::abs(value) < 1e-9 * std::abs(other) ? 0.0 : value, 4);
}

std::vector<std::string> words_of_diagram(const SteadyStudy& s) {
  if (!s.diagram) return {"no operating diagram: " + s.no_diagram};
  std::vector<std::string> words;
  const OperatingDiagram& d = *s.diagram;
  for (const OperatingPoint& p : d.points)
    words.push_back(fmt::format("operating point {} rpm at {}, {}: dM_d/dω = {} {} dM_c/dω = {} N·m·s/rad",
                                number(p.mean.omega * per_minute, 6), with_unit(p.mean.load, "N*m", 6),
                                p.stable() ? "stable" : "unstable", beside(p.drive_slope, p.load_slope),
                                p.stable() ? "<" : "≥", beside(p.load_slope, p.drive_slope)));
  if (const OperatingPoint* p = d.working_point(); p && d.margin(*p) > 1 + 1e-6)
    words.push_back(fmt::format(
        "margin: the drive gives at most {} in the mean (at {} rpm), {}", with_unit(d.strongest.drive, "N*m", 5),
        number(d.strongest.omega * per_minute, 5),
        std::isfinite(d.margin(*p)) ? number(d.margin(*p), 4) + " times what it needs" : "and it needs nothing"));
  if (const std::string none = d.why_none(s.link); !none.empty() && d.uses_speed) words.push_back(none);
  return words;
}

std::vector<std::string> words_of_start(const SteadyStudy& s) {
  std::vector<std::string> words;
  if (s.start)
    words.push_back(s.start->reached ? fmt::format("start: from rest to 95 % of the steady speed in {}",
                                                   with_unit(s.start->time, "s", 5))
                                     : "start: " + s.start->why);
  for (const RatioSearch& r : s.ratios)
    words.push_back(fmt::format(
        "fastest start with ratio {} of \"{}\"{}: {}; {}", number(r.best, 5), r.gearbox,
        r.at_bound ? " (the end of what was tried)" : "", with_unit(r.best_time, "s", 5),
        r.present_time > 0 ? fmt::format("its ratio is {}: {}", number(r.present, 5), with_unit(r.present_time, "s", 5))
                           : fmt::format("with its ratio of {} the machine does not start", number(r.present, 5))));
  return words;
}

std::vector<std::string> names_of_figures(const SteadyStudy& s) {
  std::vector<std::string> names;
  for (const SteadyCycle& c : s.cycles)
    for (const Figure& f : c.figures)
      if (std::find(names.begin(), names.end(), f.name) == names.end()) names.push_back(f.name);
  return names;
}

std::vector<std::vector<std::string>> figure_rows(const SteadyStudy& s) {
  std::vector<std::vector<std::string>> rows = {{"figure"}};
  for (const SteadyCycle& c : s.cycles) {
    rows[0].push_back(c.label);
    rows[0].push_back("error");
  }
  rows[0].push_back("unit");
  for (const std::string& name : names_of_figures(s)) {
    std::vector<std::string> row = {name};
    std::string unit;
    for (const SteadyCycle& c : s.cycles) {
      const Figure* f = c.find(name);
      row.push_back(f ? figure_text(f->value, f->error).value : "—");
      row.push_back(f ? error_cell(f->value, f->error) : "");
      if (f) unit = pretty_unit(f->unit);
    }
    row.push_back(unit);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string table_text(const SteadyStudy& s) {
  std::string text = s.title + "\n" + s.conclusion + "\n\n";
  for (const SteadyCycle& c : s.cycles) {
    text += fmt::format("{} ({})\n", c.label, c.effects == "none" ? "no effects on" : "effects: " + c.effects);
    for (const std::string& line : words_of(c)) text += "  " + line + "\n";
  }
  for (const std::string& line : words_of_diagram(s)) text += line + "\n";
  for (const std::string& line : words_of_start(s)) text += line + "\n";
  if (!names_of_figures(s).empty()) text += "\n" + aligned(figure_rows(s), 1);
  for (const std::string& note : s.notes) text += "note: " + note + "\n";
  return text;
}

// --- JSON ---

Json cycle_json(const SteadyCycle& c) {
  Json j = {{"label", c.label}, {"effects", c.effects}, {"found", c.found}};
  if (!c.found) {
    j["why"] = c.why;
    return j;
  }
  j["stability"] = c.stability;
  j["stable"] = c.point.largest() < 1 && !c.neutral;
  j["halving_cycles"] = optional_json(c.halving);
  j["multipliers"] = Json::array();
  for (const std::complex<double>& m : c.point.multipliers)
    j["multipliers"].push_back({{"real", m.real()}, {"imaginary", m.imag()}, {"magnitude", std::abs(m)}});
  j["figures"] = Json::array();
  for (const Figure& f : c.figures)
    j["figures"].push_back({{"name", f.name}, {"value", f.value}, {"unit", f.unit}, {"error", optional_json(f.error)}});
  j["drives"] = Json::array();
  for (const MotorUse& m : c.motors)
    j["drives"].push_back({{"component", m.component},
                           {"mean_torque", m.mean},
                           {"rms_torque", m.rms},
                           {"peak_torque", m.peak},
                           {"rated_torque", optional_json(m.rated)},
                           {"thermal_use", optional_json(m.thermal())}});
  if (!c.added_at.empty()) j["added_torque"] = {{"component", c.added_at}, {"value", c.added_torque}, {"unit", "N*m"}};
  j["statistics"] = {{"unknowns", c.unknowns},       {"section", c.section},
                     {"rounds", c.point.rounds},     {"derivatives", c.point.derivatives},
                     {"cost_in_cycles", c.cost},     {"cost_allowed", c.cost_limit},
                     {"residual", c.point.residual}, {"work_residual", c.work_residual},
                     {"cpu_seconds", c.cpu_seconds}};
  return j;
}

Json study_json(const SteadyStudy& s) {
  Json j = {{"title", s.title}, {"scene", s.scene_file}, {"complete", s.complete}, {"conclusion", s.conclusion}};
  if (!s.complete) j["diagnosis"] = s.diagnosis;
  j["cycles"] = Json::array();
  for (const SteadyCycle& c : s.cycles) j["cycles"].push_back(cycle_json(c));
  j["operating_points"] = Json::array();
  if (s.diagram)
    for (const OperatingPoint& p : s.diagram->points)
      j["operating_points"].push_back({{"speed", p.mean.omega},
                                       {"torque", p.mean.load},
                                       {"drive_slope", p.drive_slope},
                                       {"load_slope", p.load_slope},
                                       {"stable", p.stable()},
                                       {"margin", s.diagram->margin(p)}});
  if (s.start) j["start"] = {{"reached", s.start->reached}, {"time", s.start->reached ? Json(s.start->time) : Json()}};
  j["fastest_ratios"] = Json::array();
  for (const RatioSearch& r : s.ratios)
    j["fastest_ratios"].push_back({{"gearbox", r.gearbox},
                                   {"ratio", r.best},
                                   {"time", r.best_time},
                                   {"present_ratio", r.present},
                                   {"present_time", r.present_time > 0 ? Json(r.present_time) : Json()}});
  j["notes"] = s.notes;
  return j;
}

// --- CSV ---

std::string diagram_csv(const OperatingDiagram& d) {
  std::string text = "speed [rad/s],drive_torque [N*m],load_torque [N*m]\n";
  for (const MeanTorques& m : d.curve) text += fmt::format("{:.12g},{:.12g},{:.12g}\n", m.omega, m.drive, m.load);
  return text;
}

const CycleTraces* whole_cycle(const SteadyCycle& c) {
  return c.traces && !c.traces->last_cycles.empty() ? &c.traces->last_cycles.back() : nullptr;
}

double at_angle(const Trace& trace, double angle) {
  const auto after = std::lower_bound(trace.x.begin(), trace.x.end(), angle);
  if (after == trace.x.begin()) return trace.y.front();
  if (after == trace.x.end()) return trace.y.back();
  const auto i = static_cast<std::size_t>(after - trace.x.begin());
  const double width = trace.x[i] - trace.x[i - 1];
  return width > 0 ? trace.y[i - 1] + (trace.y[i] - trace.y[i - 1]) * (angle - trace.x[i - 1]) / width : trace.y[i];
}

std::string cycle_csv(const SteadyCycle& c) {
  const CycleTraces& cycle = *whole_cycle(c);
  std::string text = "angle [rad]";
  for (const Trace& t : cycle.traces) text += fmt::format(",{} [{}]", t.name, t.unit);
  text += "\n";
  constexpr int rows = 720;
  for (int i = 0; i <= rows; ++i) {
    const double angle = c.model->cycle * i / rows;
    text += fmt::format("{:.12g}", angle);
    for (const Trace& t : cycle.traces) text += fmt::format(",{:.10g}", at_angle(t, angle));
    text += "\n";
  }
  return text;
}

// --- report ---

std::optional<Plot> over_angle(const SteadyStudy& s, const std::string& channel, const std::string& title,
                               const std::string& label) {
  std::vector<std::pair<const SteadyCycle*, const Trace*>> found;
  double largest = 0;
  for (const SteadyCycle& c : s.cycles)
    if (const CycleTraces* cycle = whole_cycle(c))
      for (const Trace& t : cycle->traces)
        if (t.name == channel) {
          found.emplace_back(&c, &t);
          for (const double y : t.y) largest = std::max(largest, std::abs(y));
        }
  if (found.empty()) return {};
  const ReadableUnit unit = readable_unit(largest, found.front().second->unit);
  Plot plot{.title = title, .x = {s.link + " angle", "°"}, .y = {label, unit.unit}, .series = {}};
  for (const auto& [c, trace] : found) {
    Series series{.name = c->label, .role = role_of(*c), .x = trace->x, .y = trace->y};
    for (double& x : series.x) x *= degrees;
    for (double& y : series.y) y *= unit.factor;
    plot.series.push_back(std::move(series));
  }
  return plot;
}

Plot diagram_plot(const SteadyStudy& s) {
  const OperatingDiagram& d = *s.diagram;
  double largest = 0;
  for (const MeanTorques& m : d.curve) largest = std::max({largest, std::abs(m.drive), std::abs(m.load)});
  const ReadableUnit unit = readable_unit(largest, "N*m");
  Plot plot{.title = "Operating points: where the drive's mean torque meets the loads'",
            .x = {"speed of " + s.link, "1/min"},
            .y = {"mean torque over a cycle", unit.unit},
            .series = {}};
  Series drive{.name = "drive M_d", .role = Role::green, .x = {}, .y = {}},
      load{.name = "loads M_c", .role = Role::orange, .x = {}, .y = {}};
  for (const MeanTorques& m : d.curve) {
    drive.x.push_back(m.omega * per_minute);
    drive.y.push_back(m.drive * unit.factor);
    load.x.push_back(m.omega * per_minute);
    load.y.push_back(m.load * unit.factor);
  }
  plot.series = {drive, load};
  for (const bool stable : {true, false}) {
    Series marks{.name = stable ? "stable" : "unstable",
                 .role = stable ? Role::elastic : Role::vermillion,
                 .x = {},
                 .y = {},
                 .points = true,
                 .line = false};
    for (const OperatingPoint& p : d.points)
      if (p.stable() == stable) {
        marks.x.push_back(p.mean.omega * per_minute);
        marks.y.push_back(p.mean.load * unit.factor);
      }
    if (!marks.x.empty()) plot.series.push_back(std::move(marks));
  }
  plot.note = "Mean over a cycle at constant speed, reduced to " + s.link + "; stable where the drive's falls below.";
  return plot;
}

Plot multiplier_plot(const SteadyStudy& s) {
  Plot plot{.title = "Floquet multipliers: inside the unit circle deviations fade",
            .x = {"real part", ""},
            .y = {"imaginary part", ""},
            .series = {},
            .equal_axes = true};
  Series circle{.name = "unit circle", .role = Role::reference, .x = {}, .y = {}, .dashed = true};
  for (int i = 0; i <= 180; ++i) {
    circle.x.push_back(std::cos(i * std::numbers::pi / 90));
    circle.y.push_back(std::sin(i * std::numbers::pi / 90));
  }
  plot.series.push_back(std::move(circle));
  for (const SteadyCycle& c : s.cycles) {
    if (!c.found) continue;
    Series marks{.name = c.label, .role = role_of(c), .x = {}, .y = {}, .points = true, .line = false};
    for (const std::complex<double>& m : c.point.multipliers) {
      marks.x.push_back(m.real());
      marks.y.push_back(m.imag());
    }
    plot.series.push_back(std::move(marks));
  }
  return plot;
}

Plot start_plot(const SteadyStudy& s) {
  Series speed{.name = "rigid", .role = Role::rigid, .x = s.start->t, .y = s.start->w};
  for (double& w : speed.y) w *= per_minute;
  return {.title = "Start from rest to 95 % of the steady speed",
          .x = {"time", "s"},
          .y = {"speed of " + s.link, "1/min"},
          .series = {speed}};
}

Plot ratio_plot(const RatioSearch& r) {
  return {.title = fmt::format("Start time over the ratio of \"{}\"", r.gearbox),
          .x = {"ratio", "", true},
          .y = {"time to 95 % of the steady speed", "s"},
          .series = {{.name = "simulated", .role = Role::rigid, .x = r.ratio, .y = r.time, .points = true},
                     {.name = "fastest",
                      .role = Role::vermillion,
                      .x = {r.best},
                      .y = {r.best_time},
                      .points = true,
                      .line = false}}};
}

Table multiplier_table(const SteadyCycle& c) {
  Table table{.title = fmt::format("Floquet multipliers, {} model", c.label),
              .columns = {"multiplier", "magnitude", "halves in cycles"},
              .rows = {},
              .folded = c.point.multipliers.size() > 6};
  for (const std::complex<double>& m : c.point.multipliers) {
    const double size = std::abs(m);
    table.rows.push_back({complex_text(m), fmt::format("{:.6g}", size),
                          size < 1 - 1e-6 && size > 0 ? fmt::format("{:.4g}", std::log(2.0) / -std::log(size)) : "—"});
  }
  return table;
}

Table shaft_table(const SteadyStudy& s) {
  Table table{.title = "Speed fluctuation δ at every shaft", .columns = {"shaft", "ratio to the link"}, .rows = {}};
  for (const SteadyCycle& c : s.cycles)
    if (c.found) {
      table.columns.push_back("mean [1/min], " + c.label);
      table.columns.push_back("δ, " + c.label);
    }
  for (std::size_t i = 0; i < s.cycles.front().shafts.size(); ++i) {
    const ShaftFluctuation& first = s.cycles.front().shafts[i];
    std::vector<std::string> row = {first.shaft, number(first.ratio, 5)};
    for (const SteadyCycle& c : s.cycles)
      if (c.found && i < c.shafts.size()) {
        row.push_back(number(c.shafts[i].mean() * per_minute, 6));
        row.push_back(number(c.shafts[i].delta(), 6));
      }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table figure_table(const SteadyStudy& s) {
  std::vector<std::vector<std::string>> rows = figure_rows(s);
  Table table{.title = "Every figure of the steady cycle", .columns = rows.front(), .rows = {}, .folded = true};
  table.rows.assign(rows.begin() + 1, rows.end());
  return table;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

void add_key_figures(Report& report, const SteadyStudy& s) {
  for (const SteadyCycle& c : s.cycles) {
    if (!c.found) continue;
    if (const Figure* mean = c.find("mean_speed." + s.link))
      report.figures.push_back({"mean speed, " + c.label, mean->value * per_minute, "rpm",
                                mean->error ? std::optional(*mean->error * per_minute) : std::nullopt});
    if (const Figure* delta = c.find("delta." + s.link))
      report.figures.push_back({"speed fluctuation δ, " + c.label, delta->value, "", delta->error});
    report.figures.push_back({"largest multiplier, " + c.label, c.point.largest(), "", {}, c.stability, 4});
  }
  for (const SteadyCycle& c : s.cycles)
    for (const MotorUse& m : c.motors)
      if (c.found && m.rated && &c == &s.cycles.back())
        report.figures.push_back({"thermal use of " + m.component, 100 * *m.thermal(), "%", {}, "RMS over rated", 4});
}

void add_plots(Report& report, const SteadyStudy& s) {
  ReportSection& section = report.add("Steady cycle");
  const auto add = [&](std::optional<Plot> plot) {
    if (plot) section.cards.push_back(std::move(*plot));
  };
  add(over_angle(s, "speed." + s.link, "Speed of " + s.link + " over a steady cycle", "speed"));
  const SteadyCycle& last = s.cycles.back();
  constexpr std::size_t most_plots = 8;
  for (std::size_t i = 0; i < last.model->torque_joints.size() && i < most_plots; ++i) {
    const std::string& name = last.model->torque_joints[i].component;
    add(over_angle(s, "torque." + name, "Torque in " + name + " over a steady cycle", "transmitted torque"));
  }
  for (const MotorUse& m : last.motors)
    add(over_angle(s, "torque." + m.component, "Torque of " + m.component + " over a steady cycle", "torque"));
}

void add_formulas(ReportSection& section, const SteadyStudy& s) {
  for (const SteadyCycle& c : s.cycles) {
    const Figure *delta = c.find("delta." + s.link), *max = c.find("max_speed." + s.link),
                 *min = c.find("min_speed." + s.link);
    if (!delta || !max || !min) continue;
    section.cards.push_back(
        Formula{.title = fmt::format("Speed fluctuation of {}, {} model (theory 2.6)", s.link, c.label),
                .symbols = "δ = (ω_max − ω_min) / ω_m,   ω_m = (ω_max + ω_min)/2",
                .numbers = fmt::format("δ = ({:.6g} − {:.6g}) rad/s / {:.6g} rad/s = {}", max->value, min->value,
                                       0.5 * (max->value + min->value), with_error(delta->value, delta->error, "")),
                .note = ""});
  }
}

Report report_of(const SteadyStudy& s) {
  Report report{.title = s.title,
                .subtitle = "Steady motion found directly: return map and its multipliers",
                .conclusion = s.conclusion,
                .complete = s.complete};
  const bool any = std::any_of(s.cycles.begin(), s.cycles.end(), [](const SteadyCycle& c) { return c.found; });
  add_key_figures(report, s);
  if (any) add_plots(report, s);
  ReportSection& operation = report.add("Operating points (theory 4.15)");
  if (s.diagram) operation.cards.push_back(diagram_plot(s));
  operation.cards.push_back(Text{.title = "", .body = joined(words_of_diagram(s))});
  if (s.start && s.start->t.size() > 1) operation.cards.push_back(start_plot(s));
  for (const RatioSearch& r : s.ratios) operation.cards.push_back(ratio_plot(r));
  if (const auto words = words_of_start(s); !words.empty())
    operation.cards.push_back(Text{.title = "", .body = joined(words)});
  if (any) {
    ReportSection& stability = report.add("Stability (theory 11.4)");
    stability.cards.push_back(multiplier_plot(s));
    for (const SteadyCycle& c : s.cycles)
      if (c.found) stability.cards.push_back(multiplier_table(c));
    ReportSection& figures = report.add("Figures");
    figures.cards.push_back(shaft_table(s));
    add_formulas(figures, s);
    figures.cards.push_back(figure_table(s));
  }
  ReportSection& how = report.add("How it was found");
  for (const SteadyCycle& c : s.cycles)
    how.cards.push_back(Text{.title = c.label + " model", .body = joined(words_of(c))});
  if (!s.notes.empty()) report.add("Notes").cards.push_back(Text{.title = "", .body = joined(s.notes)});
  return report;
}

}  // namespace

StudyOutput output_of(const SteadyStudy& s) {
  StudyOutput output{s.conclusion, table_text(s), json_text(study_json(s)), [&s] { return report_of(s); }, {},
                     s.complete,   s.diagnosis};
  if (s.diagram) output.csv.push_back({"operating_points.csv", [&s] { return diagram_csv(*s.diagram); }});
  for (const SteadyCycle& c : s.cycles)
    if (whole_cycle(c)) output.csv.push_back({"steady." + c.label + ".csv", [&c] { return cycle_csv(c); }});
  return output;
}

}  // namespace kurbel
