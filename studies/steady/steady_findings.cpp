// steady_findings.cpp — words, tables and plots of steady cycles.
#include "engine/base/find_by.h"
#include "engine/numerics/angles.h"
#include "studies/run/compare.h"
#include "studies/run/run_findings.h"
#include "studies/steady/steady.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/units.h"
#include "studies/answers/measured_names.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/plots.h"
#include "studies/findings/trace.h"
#include "studies/limits/limits_findings.h"
#include "studies/steady/order_findings.h"
#include "studies/steady/steady_words.h"

namespace kurbel {
namespace {

Role role_of(const SteadyCycle& c) { return !is_elastic(*c.model) ? Role::rigid : Role::elastic; }

// --- figures and multipliers ---

std::vector<std::string> names_of_figures(const SteadyStudy& s) {
  std::vector<std::string> names;
  for (const SteadyCycle& c : s.cycles)
    for (const Figure& f : c.figures)
      if (!is_of_order(f) && std::find(names.begin(), names.end(), f.name) == names.end()) names.push_back(f.name);
  return names;
}

// One row per figure, the models side by side; orders have separate tables.
Rows figure_table(const SteadyStudy& s) {
  auto table = table_of("", "Every figure of the steady cycle", names_of_figures(s)).fold();
  const SpeedUnit speed = s.speed_unit;
  table.explained_by(std::identity()).only_for_people("figure", std::identity());
  for (const SteadyCycle& c : s.cycles)
    table.value_and_error(c.label, [&](const std::string& name, int digits) {
      const Figure* f = c.find(name);
      return f ? figure_cells(without_rounding(*f, f->scale), f->unit, speed, digits) : FigureCells{"—", "", ""};
    });
  return table.only_for_people("unit", [&](const std::string& name) {
    std::string unit;
    for (const SteadyCycle& c : s.cycles)
      if (const Figure* f = c.find(name)) unit = figure_cells(*f, f->unit, speed).unit;
    return unit;
  });
}

// By number, largest first; halving is given within the error.
auto multiplier_table(const SteadyCycle& c) {
  const std::vector<std::complex<double>>& all = c.point.multipliers;
  const auto error = [&c](std::size_t i) {
    return i < c.multiplier_errors.size() ? std::optional(c.multiplier_errors[i]) : std::nullopt;
  };
  // Not distinguished from zero.
  const auto is_nothing = [&, error](std::size_t i) { return std::abs(all[i]) <= error(i).value_or(0); };
  return table_of("", fmt::format("Floquet multipliers, {} model", c.label), numbers_below(all.size()))
      .fold(all.size() > 6)
      .not_on_terminal()
      .always()
      .only_for_people(
          "multiplier",
          [&, is_nothing](std::size_t i) { return is_nothing(i) ? std::string("0") : complex_text(all[i]); })
      .only_for_programs("real", [&](std::size_t i) { return all[i].real(); })
      .only_for_programs("imaginary", [&](std::size_t i) { return all[i].imag(); })
      .only_for_programs("magnitude", [&](std::size_t i) { return std::abs(all[i]); })
      .only_for_people("magnitude", [&, is_nothing](std::size_t i) { return is_nothing(i) ? 0 : std::abs(all[i]); })
      .only_for_people("numerical error",
                       [&, error](std::size_t i) {
                         return error_cell({std::abs(all[i]), error(i)});
                       })
      .only_for_programs("error", error)
      .only_for_people("halves in cycles", [&, is_nothing](std::size_t i) {
        const double size = std::abs(all[i]);
        return size < 1 - 1e-6 && size > 0 && !is_nothing(i) ? fmt::format("{:.4g}", std::log(2.0) / -std::log(size))
                                                             : std::string("—");
      });
}

Rows shaft_table(const SteadyStudy& s) {
  const std::vector<ShaftFluctuation>& first = s.cycles.front().shafts;
  auto table = table_of("", "Speeds of the shafts", numbers_below(first.size())).not_on_terminal();
  table.always();
  const SpeedUnit unit = s.speed_unit;
  table.only_for_people("shaft", [&](std::size_t i) { return first[i].shaft; });
  table.only_for_people("ratio to the link", [&](std::size_t i) { return first[i].ratio; }, {.digits = 5});
  for (const SteadyCycle& c : s.cycles)
    if (c.found) {
      if (c.kind != Orbit::Kind::equilibrium) table.title = "Speed fluctuation δ at every shaft";
      table.only_for_people(fmt::format("mid speed [{}], {}", unit.name, c.label),
                            [&](std::size_t i) { return unit.of(c.shafts[i].mid()); });
      if (c.kind != Orbit::Kind::equilibrium)  // there it is rounding
        table.only_for_people("δ, " + c.label, [&](std::size_t i) { return c.shafts[i].delta(); });
    }
  return table;
}

// --- for programs and files ---

Record figure_record(const Figure& f) {
  return {{"name", f.name}, {"value", f.value}, {"unit", f.unit}, {"error", f.error}};
}

List drive_list(const SteadyCycle& c) {
  return each(c.motors, [](const MotorUse& m) {
    return Record{{"component", m.component}, {"mean_torque", m.mean},   {"rms_torque", m.rms},
                  {"peak_torque", m.peak},    {"rated_torque", m.rated}, {"thermal_use", m.thermal()}};
  });
}

Record cycle_record(const SteadyCycle& c) {
  Record r = {{"label", c.label}, {"effects", c.effects}, {"found", c.found}};
  if (!c.orbit.empty())
    r.push_back({"steady_motion", Record{{"kind", name_of(c.kind)}, {"words", c.orbit}, {"cycles", c.run_cycles}}});
  const auto report = [&](const char* key, Value value) { r.push_back({key, std::move(value)}); };
  if (!c.found) {
    report("why", c.why);
    return r;
  }
  report("stability", c.stability);
  report("stable", c.uncertain ? Value() : Value(c.point.largest() < 1 && !c.neutral));
  report("halving_cycles", c.halving);
  report("multipliers", multiplier_table(c).list());
  report("figures", each(c.figures, figure_record));
  report("orders", orders_for_programs(c));
  report("drives", drive_list(c));
  if (!c.added_at.empty())
    report("added_torque", Record{{"component", c.added_at}, {"value", c.added_torque}, {"unit", "N*m"}});
  if (c.held_quantity)
    report("held_quantity", Record{{"key", c.held_quantity->key},
                                   {"value", c.held_quantity->value},
                                   {"scene_value", c.held_quantity->of_scene},
                                   {"unit", c.held_quantity->unit}});
  report("statistics", Record{{"unknowns", c.unknowns},
                              {"section", c.section},
                              {"iterations", c.point.periods},
                              {"derivatives", c.point.derivatives},
                              {"cost_in_cycles", c.cost},
                              {"cost_allowed", c.cost_limit},
                              {"residual", c.point.residual},
                              {"work_residual", c.work_residual},
                              {"cpu_seconds", c.cpu_seconds}});
  return r;
}

Record ratio_record(const RatioSearch& r) {
  return {{"gearbox", r.gearbox},
          {"ratio", r.best},
          {"time", r.best_time},
          {"present_ratio", r.present},
          {"present_time", r.present_time > 0 ? Value(r.present_time) : Value()}};
}

const CycleTraces* whole_cycle(const SteadyCycle& c) {
  return c.traces && !c.traces->last_cycles.empty() ? &c.traces->last_cycles.back() : nullptr;
}

DataTable cycle_data(const SteadyCycle& c) {
  constexpr int rows = 720;
  std::vector<double> angles;
  for (int i = 0; i <= rows; ++i) angles.push_back(c.model->cycle * i / rows);
  auto data = data_of(std::move(angles));
  data.in_file("angle", "rad", std::identity());
  for (const Trace& t : whole_cycle(c)->traces)
    if (!t.name.starts_with(measured_trace("")))
      data.in_file(
          t.name, t.unit, [&t](double angle) { return t.at(angle); }, 10);
  return data.data();
}

void add_tables(Findings& f, const SteadyStudy& s) {
  if (s.diagram)
    f.tables.push_back({"operating_points", [&s] {
                          return data_of(s.diagram->curve)
                              .in_file("speed", "rad/s", &MeanTorques::omega)
                              .in_file("drive_torque", "N*m", &MeanTorques::drive)
                              .in_file("load_torque", "N*m", &MeanTorques::load)
                              .data();
                        }});
  for (const SteadyCycle& c : s.cycles)
    if (whole_cycle(c)) f.tables.push_back({"steady." + c.label, [&c] { return cycle_data(c); }});
}

// --- plots ---

const Trace* trace_of(const SteadyCycle& c, const std::string& name) {
  const CycleTraces* const cycle = whole_cycle(c);
  if (!cycle) return nullptr;
  return find_by(cycle->traces, &Trace::name, name);
}

Series over_degrees(const std::string& name, Role role, const Trace& t) {
  Series series{.name = name, .role = role, .x = t.x, .y = t.y};
  for (double& x : series.x) x *= in_degrees;
  return series;
}

std::optional<Plot> over_angle(const SteadyStudy& s, const std::string& channel, const std::string& title,
                               const std::string& label) {
  Plot plot{.title = title, .x = {s.link + " angle", "°"}, .y = {label, ""}};
  std::string si_unit;
  for (const SteadyCycle& c : s.cycles)
    if (const Trace* t = trace_of(c, channel)) {
      if (plot.series.empty()) si_unit = t->unit;
      plot.series.push_back(over_degrees(c.label, role_of(c), *t));
    }
  if (const CycleTraces* last = whole_cycle(s.cycles.back()))
    for (const Trace& t : last->traces)
      if (t.name == measured_trace(channel)) plot.series.push_back(marks(over_degrees("measured", Role::reference, t)));
  if (plot.series.empty()) return {};
  return in_readable_unit(std::move(plot), si_unit, s.speed_unit);
}

// Torque times speed of a motor.
std::optional<Plot> power_over_angle(const SteadyStudy& s, const std::string& motor) {
  Plot plot{.title = fmt::format("Power of {} over a steady cycle", motor),
            .x = {s.link + " angle", "°"},
            .y = {"power", ""}};
  for (const SteadyCycle& c : s.cycles) {
    const Trace *torque = trace_of(c, "torque." + motor), *speed = trace_of(c, "speed." + motor);
    if (!torque || !speed) continue;
    Series& power = plot.series.emplace_back(over_degrees(c.label, role_of(c), *torque));
    for (std::size_t i = 0; i < power.y.size(); ++i) power.y[i] *= speed->at(torque->x[i]);
  }
  if (plot.series.empty()) return {};
  return in_readable_unit(std::move(plot), "W");
}

Plot diagram_plot(const SteadyStudy& s) {
  const OperatingDiagram& d = *s.diagram;
  const auto speed = [&d](const MeanTorques& m) { return d.speed_unit.of(m.omega); };
  Plot plot{.title = "Operating points: where the drive's mean torque meets the loads'",
            .x = {"speed of " + s.link, d.speed_unit.name},
            .y = {"mean torque over a cycle", ""},
            .series = {series_of("drive M_d", Role::green, d.curve, speed, &MeanTorques::drive),
                       series_of("loads M_c", Role::orange, d.curve, speed, &MeanTorques::load)},
            .note = "Mean over a cycle at constant speed, reduced to " + s.link +
                    "; stable where the drive's curve falls below the loads' as the speed rises." +
                    (d.estimate ? " An estimate: losses by the load, or states of the machine, are omitted." : "")};
  const double largest = largest_of(plot);
  for (const bool stable : {true, false}) {
    std::vector<OperatingPoint> points;
    for (const OperatingPoint& p : d.points)
      if (p.stable() == stable) points.push_back(p);
    if (!points.empty())
      plot.series.push_back(marks(series_of(
          stable ? "stable" : "unstable", stable ? Role::elastic : Role::vermillion, points,
          [&d](const OperatingPoint& p) { return d.speed_unit.of(p.speed.value); },
          [](const OperatingPoint& p) { return p.torque.value; })));
  }
  return in_readable_unit(std::move(plot), "N*m", largest);
}

Plot multiplier_plot(const SteadyStudy& s) {
  const auto real = [](const std::complex<double>& z) { return z.real(); };
  const auto imaginary = [](const std::complex<double>& z) { return z.imag(); };
  std::vector<std::complex<double>> circle;
  for (int i = 0; i <= 180; ++i)
    circle.emplace_back(std::cos(i * std::numbers::pi / 90), std::sin(i * std::numbers::pi / 90));
  Plot plot{.title = "Floquet multipliers: inside the unit circle deviations fade",
            .x = {"real part", ""},
            .y = {"imaginary part", ""},
            .series = {dashed(series_of("unit circle", Role::reference, circle, real, imaginary))},
            .equal_axes = true};
  for (const SteadyCycle& c : s.cycles)
    if (c.found) plot.series.push_back(marks(series_of(c.label, role_of(c), c.point.multipliers, real, imaginary)));
  return plot;
}

Plot start_plot(const SteadyStudy& s) {
  Series speed{.name = "rigid", .role = Role::rigid, .x = s.start->t, .y = s.start->w};
  const SpeedUnit unit = s.speed_unit;
  for (double& w : speed.y) w = unit.of(w);
  return {.title = s.start->falls_short ? "Start from rest: it does not reach the steady speed"
                                        : "Start from rest to 95 % of the steady speed",
          .x = {"time", "s"},
          .y = {"speed of " + s.link, unit.name},
          .series = {speed}};
}

Plot ratio_plot(const RatioSearch& r) {
  return {.title = fmt::format("Start time of the driven side over the ratio of \"{}\"", r.gearbox),
          .x = {"ratio", "", true},
          .y = {"time to 95 % of the present steady speed", "s"},
          .series = {{.name = "simulated", .role = Role::rigid, .x = r.ratio, .y = r.time, .points = true},
                     marks({.name = "fastest", .role = Role::vermillion, .x = {r.best}, .y = {r.best_time}})}};
}

std::vector<Plot> cycle_plots(const SteadyStudy& s) {
  std::vector<Plot> plots;
  const auto add = [&](const std::string& channel, const std::string& what, const std::string& label) {
    if (auto plot = over_angle(s, channel, what + " over a steady cycle", label)) plots.push_back(std::move(*plot));
  };
  add("speed." + s.link, "Speed of " + s.link, "speed");
  const SteadyCycle& last = s.cycles.back();
  constexpr std::size_t most_plots = 8;
  for (std::size_t i = 0; i < last.model->torque_joints.size() && i < most_plots; ++i) {
    const std::string& name = last.model->torque_joints[i].component;
    add("torque." + name, "Torque in " + name, "transmitted torque");
  }
  for (const MotorUse& m : last.motors) {
    add("torque." + m.component, "Torque of " + m.component, "torque");
    if (auto power = power_over_angle(s, m.component)) plots.push_back(std::move(*power));
  }
  const CycleTraces* shown = whole_cycle(last);
  for (const Trace& t : shown ? shown->traces : std::vector<Trace>{}) {
    constexpr double least_slip = 1e-9;  // of the machine's speed: less is rounding of what holds
    const double least = t.what == quantities::slip ? least_slip * last.model->speed_scale : 0;
    const bool moves = std::any_of(t.y.begin(), t.y.end(), [least](double y) { return std::abs(y) > least; });
    if (t.what == quantities::slip && moves) add(t.name, "Slip of " + t.of, "speed of one side against the other");
    if (t.what == quantities::force && moves)
      add(t.name, fmt::format("Force on the {} of {}", moved_part(*last.model, t.of), t.of), "force");
  }
  return plots;
}

// --- all of it ---

void add_key_figures(Findings& f, const SteadyStudy& s) {
  const SpeedUnit unit = s.speed_unit;
  for (const SteadyCycle& c : s.cycles) {
    if (!c.found) continue;
    if (const Figure* mean = c.find("mean_speed." + s.link))
      f.figures.push_back({*mean / unit.size, "mean speed, " + c.label, unit.name, "", 0, mean->name});
    if (const Figure* delta = c.find("delta." + s.link); delta && c.kind != Orbit::Kind::equilibrium)
      f.key("speed fluctuation δ, " + c.label, *delta, delta->name);
    if (!c.point.multipliers.empty())
      f.key(
          "deviation that remains after a cycle, " + c.label,
          {c.point.largest(), c.multiplier_errors.empty() ? std::nullopt : std::optional(c.multiplier_errors.front())},
          "largest_multiplier", c.stability, 4);
  }
  if (const SteadyCycle& last = s.cycles.back(); last.found)
    for (const MotorUse& m : last.motors)
      if (m.rated)
        f.figures.push_back(
            {{100 * *m.thermal()}, "thermal use of " + m.component, "%", "RMS over rated", 4, "thermal_use"});
}

void show_formulas(Findings& f, Chapter in, const SteadyStudy& s) {
  const SpeedUnit unit = s.speed_unit;
  for (const SteadyCycle& c : s.cycles) {
    const Figure *delta = c.find("delta." + s.link), *max = c.find("cycle_max_speed." + s.link),
                 *min = c.find("cycle_min_speed." + s.link);
    if (!delta || !max || !min || c.kind == Orbit::Kind::equilibrium) continue;
    f.show(in,
           Formulas().add(fmt::format("Speed fluctuation of {}, {} model (theory 2.6)", s.link, c.label),
                          "δ = (ω_max − ω_min) / ω_mid,   ω_mid = (ω_max + ω_min)/2",
                          "δ = ({:.6g} − {:.6g}) {} / {} = {}", unit.of(max->value), unit.of(min->value),
                          pretty_unit(unit.name), unit.text(0.5 * (max->value + min->value)), with_error(*delta, "")));
  }
}

void say_operation(Findings& f, Chapter in, const SteadyStudy& s) {
  if (s.diagram) f.draw(in, [&s] { return diagram_plot(s); });
  f.say(in, Sentences{.lines = words_of_diagram(s)});
  if (s.start && s.start->t.size() > 1) f.draw(in, [&s] { return start_plot(s); });
  for (const RatioSearch& r : s.ratios) f.draw(in, [&r] { return ratio_plot(r); });
  f.say(in, Sentences{.lines = words_of_start(s)});
  f.record("operating_points",
           s.diagram ? each(s.diagram->points, [&](const OperatingPoint& p) { return operating_point(*s.diagram, p); })
                     : List{});
  if (s.start)
    f.record("start", Record{{"reached", s.start->reached},
                             {"time", s.start->reached ? Value(s.start->time.value) : Value()},
                             {"error", s.start->time.error}});
  f.record("fastest_ratios", each(s.ratios, ratio_record));
}

}  // namespace

Findings findings_of(const SteadyStudy& s) {
  Findings f = Findings::of(s, "Steady motion found directly: return map and its multipliers");
  f.speed_unit = s.speed_unit.name, f.opening = Findings::Opening::title_and_conclusion;
  f.claims = claims_of(s);
  if (s.cycles.empty()) return f;  // interrupted before the first
  const std::vector<Verdict> ratings = steady_ratings(s.cycles.back());
  f.claim(limit_claims(ratings, "rating"));
  const Chapter cycle = f.chapter("Steady cycle");
  f.chapter(chapter_of_measurement);
  const Chapter orders = f.chapter("Orders of speeds and torques (theory 11.10)"),
                operation = f.chapter("Operating points (theory 4.15)"),
                stability = f.chapter("Stability (theory 11.4)"), figures = f.chapter("Figures"),
                how = f.chapter("How it was found"), notes = f.chapter("Notes");
  const bool any = std::any_of(s.cycles.begin(), s.cycles.end(), [](const SteadyCycle& c) { return c.found; });
  add_key_figures(f, s);
  for (const SteadyCycle& c : s.cycles)
    f.say(how, Sentences{.lines = words_of(c),
                         .title = c.label + " model",
                         .heading = fmt::format("{} ({})", c.label,
                                                c.effects == "none" ? "no effects on" : "effects: " + c.effects),
                         .indent = "  ",
                         .apart = &c == &s.cycles.front()});
  f.record("cycles", each(s.cycles, cycle_record));
  say_operation(f, operation, s);
  if (any) {
    f.draw(cycle, [&s] { return cycle_plots(s); });
    say_orders(f, orders, s);
    // Multipliers near zero are shown as dots.
    constexpr double seen = 0.05;
    if (std::any_of(s.cycles.begin(), s.cycles.end(),
                    [](const SteadyCycle& c) { return c.found && c.point.largest() > seen; }))
      f.draw(stability, [&s] { return multiplier_plot(s); });
    for (const SteadyCycle& c : s.cycles)
      if (c.found) f.say(stability, multiplier_table(c));
    if (!ratings.empty()) {
      Rows table = verdict_table(ratings);
      table.key = "ratings", table.heading = "ratings";
      f.say(figures, std::move(table));
    }
    f.say(figures, shaft_table(s));
    show_formulas(f, figures, s);
    f.say(figures, figure_table(s));
  }
  f.say(notes, Sentences{.lines = s.notes, .indent = "note: ", .key = "notes"});
  add_tables(f, s);
  return f;
}

}  // namespace kurbel
