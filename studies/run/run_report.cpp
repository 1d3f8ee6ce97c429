// run_report.cpp — conclusion, figures, motion and plots of one run or of two models side by side.
#include "studies/run/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/trace.h"

namespace kurbel {
namespace {

using Results = std::vector<const Result*>;
constexpr std::size_t most_torque_plots = 8;

bool drawable(const Results& results) {
  return std::all_of(results.begin(), results.end(), [](const Result* r) {
    return r->traces && r->model && r->traces->find("angle")->x.size() > 1 && r->traces->find("angle")->x.back() > 0;
  });
}

Role role_of(const Result& r, const Results& all) {
  const bool elastic = r.model && !r.model->elastic.empty();
  if (!elastic) return Role::rigid;
  // Two elastic models: the first steps back.
  return all.size() > 1 && &r == all.front() ? Role::orange : Role::elastic;
}

// "peak_torque.main_coupling" → "peak torque, main_coupling"
std::string in_words(const std::string& name) {
  const std::size_t dot = name.find('.');
  std::string words = name.substr(0, dot);
  std::replace(words.begin(), words.end(), '_', ' ');
  if (words == "delta") words = "speed fluctuation δ";
  return dot == std::string::npos ? words : words + ", " + name.substr(dot + 1);
}

std::string sure(const Figure& f) { return with_error(f.value, f.error, f.unit); }
// Time with its error: a column's heading names the unit.
std::string time_of(const Figure& f) { return f.at ? with_error(*f.at, f.at_error, "") : ""; }
std::string at_time(const Figure& f) { return f.at ? "at " + with_error(*f.at, f.at_error, "s") : ""; }

std::vector<EventMark> marks_of(const Result& r) {
  std::vector<EventMark> marks;
  for (const Event& e : r.events) marks.push_back({e.t, e.component + ": " + e.what});
  return marks;
}

std::string time_of(const Result& r, std::size_t event) {
  if (r.event_errors.empty()) return with_error(r.events[event].t, {}, "");
  const std::optional<double>& error = r.event_errors[event];
  return with_error(r.events[event].t, error, "") + (error ? "" : " (in the finer run only)");
}

double largest(const std::vector<const Trace*>& traces) {
  double value = 0;
  for (const Trace* trace : traces)
    for (const double y : trace->y) value = std::max(value, std::abs(y));
  return value;
}

Series series_of(const Trace& trace, const std::string& name, Role role, double x_factor, double y_factor) {
  Series s{.name = name, .role = role, .x = trace.x, .y = trace.y};
  for (double& x : s.x) x *= x_factor;
  for (double& y : s.y) y *= y_factor;
  return s;
}

// One quantity over time, the models over each other. Nothing if no model has it.
std::optional<Plot> over_time(const Results& results, const std::string& channel, const std::string& title,
                              const std::string& label) {
  std::vector<const Trace*> traces;
  for (const Result* r : results)
    if (const Trace* trace = r->traces->find(channel)) traces.push_back(trace);
  if (traces.empty()) return {};
  const ReadableUnit unit = readable_unit(largest(traces), traces.front()->unit);
  Plot plot{
      .title = title, .x = {"time", "s"}, .y = {label, unit.unit}, .series = {}, .marks = marks_of(*results.back())};
  for (const Result* r : results)
    if (const Trace* trace = r->traces->find(channel))
      plot.series.push_back(series_of(*trace, r->label, role_of(*r, results), 1, unit.factor));
  return plot;
}

// One quantity over the crank angle in the last whole cycle of each model.
std::optional<Plot> over_angle(const Results& results, const std::string& channel, const std::string& title,
                               const std::string& label) {
  std::vector<std::pair<const Result*, const Trace*>> found;
  for (const Result* r : results) {
    if (r->traces->last_cycles.empty()) continue;
    for (const Trace& trace : r->traces->last_cycles.back().traces)
      if (trace.name == channel) found.emplace_back(r, &trace);
  }
  if (found.empty()) return {};
  std::vector<const Trace*> traces;
  for (const auto& [r, trace] : found) traces.push_back(trace);
  const ReadableUnit unit = readable_unit(largest(traces), traces.front()->unit);
  Plot plot{.title = title, .x = {"crank angle", "°"}, .y = {label, unit.unit}, .series = {}};
  for (const auto& [r, trace] : found)
    plot.series.push_back(series_of(*trace, r->label, role_of(*r, results), 180 / std::numbers::pi, unit.factor));
  const CycleTraces& last = results.back()->traces->last_cycles.back();
  plot.note = fmt::format("Last whole cycle ({}: {:.4g} … {:.4g} s).", results.back()->label, last.begin, last.end);
  return plot;
}

std::string link_of(const Result& r) {
  return r.model->network.nodes[static_cast<std::size_t>(r.model->reduction_node)].component;
}

// Couplings by the size of their peak torque in the last model, the largest first.
std::vector<std::string> couplings(const Result& r) {
  std::vector<std::pair<double, std::string>> sorted;
  for (const TorqueJoint& joint : r.model->torque_joints) {
    const Figure* peak = r.find("peak_torque." + joint.component);
    if (r.traces->find("torque." + joint.component))
      sorted.emplace_back(peak ? -std::abs(peak->value) : 0, joint.component);
  }
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (const auto& [peak, name] : sorted) names.push_back(name);
  return names;
}

Plot energy_plot(const Result& r) {
  struct Line {
    const char *channel, *name;
    Role role;
  };
  constexpr Line lines[] = {
      {"kinetic_energy", "kinetic energy", Role::elastic}, {"stored_energy", "stored in springs", Role::sky},
      {"work.driving", "driving work", Role::green},       {"work.useful", "useful work", Role::orange},
      {"work.harmful", "harmful work", Role::vermillion},  {"work.weight", "work of weight", Role::purple}};
  std::vector<const Trace*> traces;
  std::vector<Line> found;
  for (const Line& line : lines)
    if (const Trace* trace = r.traces->find(line.channel)) {
      traces.push_back(trace);
      found.push_back(line);
    }
  const ReadableUnit unit = readable_unit(largest(traces), "J");
  Plot plot{.title = fmt::format("Where the energy goes, {} model", r.label),
            .x = {"time", "s"},
            .y = {"energy, work since the start", unit.unit},
            .series = {},
            .marks = marks_of(r)};
  for (std::size_t i = 0; i < traces.size(); ++i)
    if (largest({traces[i]}) > 0)
      plot.series.push_back(series_of(*traces[i], found[i].name, found[i].role, 1, unit.factor));
  if (r.energy.checks == 0 || nothing_turned_over(r.energy)) return plot;
  plot.note = fmt::format(
      "Kinetic and spring energy less all work since the start stays the same to {:.1e} of the energy turned over.",
      r.energy.relative);
  return plot;
}

// Title and label of what clearance and a flexible rod show; empty: the trace is something else.
std::pair<std::string, std::string> of_joint_or_rod(const std::string& trace) {
  const std::size_t dot = trace.find('.');
  if (dot == std::string::npos) return {};
  const std::string quantity = trace.substr(0, dot), component = trace.substr(dot + 1);
  for (const auto& [key, joint] :
       {std::pair("crank_pin", "crank pin"), std::pair("wrist_pin", "wrist pin"), std::pair("guide", "guide")}) {
    if (quantity == std::string(key) + "_force")
      return {fmt::format("Contact force, {} of {}", joint, component), "force"};
    if (quantity == std::string(key) + "_penetration")
      return {fmt::format("Depth of contact, {} of {}", joint, component), "depth"};
  }
  if (quantity == "rod_deflection")
    return {fmt::format("Deflection of the rod of {} at mid-span", component), "deflection"};
  if (quantity == "rod_bending_stress")
    return {fmt::format("Greatest bending stress in the rod of {}", component), "stress"};
  return {};
}

// A word that fits the plot's marks, where there are any.
void note_marks(Plot& plot) {
  if (!plot.marks.empty() && plot.note.empty())
    plot.note =
        fmt::format("Ticks below: {} event{}; hover to read.", plot.marks.size(), plot.marks.size() == 1 ? "" : "s");
}

Table events_table(const Result& r) {
  Table table{.title = fmt::format("Events, {} model ({})", r.label, r.events.size()),
              .columns = {"component", "from", "to", "time [s]"},
              .rows = {},
              .folded = true,
              .text_columns = 3};
  constexpr std::size_t most = 500;
  for (std::size_t i = 0; i < r.events.size() && i < most; ++i)
    table.rows.push_back({r.events[i].component, r.events[i].from, r.events[i].what, time_of(r, i)});
  if (r.events.size() > most)
    table.rows.push_back({"…", "", fmt::format("{} more in summary.json", r.events.size() - most), ""});
  return table;
}

Table statistics_table(const Results& results) {
  Table table{.title = "What it cost", .columns = {""}, .rows = {}};
  for (const Result* r : results) table.columns.push_back(r->label);
  const auto row = [&](const std::string& name, auto value) {
    std::vector<std::string> cells = {name};
    for (const Result* r : results) cells.push_back(value(*r));
    table.rows.push_back(std::move(cells));
  };
  row("coordinates", [](const Result& r) { return std::to_string(r.coordinates); });
  row("method", [](const Result& r) { return r.statistics.method; });
  row("steps", [](const Result& r) { return std::to_string(r.statistics.stepper.steps); });
  row("rejected steps", [](const Result& r) { return std::to_string(r.statistics.stepper.rejected); });
  row("evaluations of the equations", [](const Result& r) { return std::to_string(r.statistics.stepper.flow_calls); });
  row("events", [](const Result& r) { return std::to_string(r.statistics.events); });
  row("processor time of a run [ms]",
      [](const Result& r) { return fmt::format("{:.3g}", 1e3 * r.statistics.cpu_seconds); });
  row("runs", [](const Result& r) { return std::to_string(r.runs); });
  row("accuracy asked for", [](const Result& r) { return fmt::format("{:.1e}", r.accuracy); });
  row("accuracy measured", [](const Result& r) {
    return r.errors_measured ? fmt::format("{:.1e}", r.measured_accuracy) : std::string("—");
  });
  row("energy balance closes to", [](const Result& r) {
    return !has_works(r)                   ? std::string("—")
           : nothing_turned_over(r.energy) ? std::string("no energy turned over")
                                           : fmt::format("{:.1e}", r.energy.relative);
  });
  return table;
}

Table energy_table(const Results& results) {
  Table table{.title = "Energy audit [J] (theory 1.3)", .columns = {""}, .rows = {}};
  for (const Result* r : results) table.columns.push_back(r->label);
  const auto row = [&](const std::string& name, auto value) {
    std::vector<std::string> cells = {name};
    for (const Result* r : results) cells.push_back(fmt::format("{:.6g}", value(*r)));
    table.rows.push_back(std::move(cells));
  };
  std::set<std::string> accounts;
  for (const Result* r : results)
    for (const auto& [name, work] : r->energy.by_account) accounts.insert(name);
  for (const std::string& name : accounts)
    row("work of " + name, [&](const Result& r) {
      const auto found = r.energy.by_account.find(name);
      return found == r.energy.by_account.end() ? 0.0 : found->second;
    });
  row("kinetic energy at the start", [](const Result& r) { return r.energy.kinetic_start; });
  row("kinetic energy at the end", [](const Result& r) { return r.energy.kinetic_end; });
  row("stored in springs at the start", [](const Result& r) { return r.energy.stored_start; });
  row("stored in springs at the end", [](const Result& r) { return r.energy.stored_end; });
  row("residual", [](const Result& r) { return r.energy.residual; });
  return table;
}

// Machine, plots, audit, statistics, scene: common to both reports. Tables of figures come between.
void add_machine_and_plots(Report& report, const Results& results) {
  if (!drawable(results)) return;
  report.add("").cards.push_back(machine_view(results));
  ReportSection& plots =
      report.add(results.back()->traces->last_cycles.empty() ? "Over time" : "Over time and over the crank's angle");
  for (Plot& plot : motion_plots(results)) plots.cards.push_back(std::move(plot));
  if (const std::size_t all = couplings(*results.back()).size(); all > most_torque_plots)
    plots.cards.push_back(Text{
        .title = "Further couplings",
        .body = fmt::format(
            "Torques are plotted for the {} couplings with the largest peaks, of {}; trajectory.csv holds the others.",
            most_torque_plots, all)});
}

// What kept the steps short, ranked.
Table limits_table(const Result& r) {
  constexpr std::size_t most = 12, most_states = 3;
  Table table{.title = fmt::format("What kept the steps short, {} model", r.label),
              .columns = {"element", "by", "states", "steps", "share"},
              .rows = {}};
  for (const LimitedSteps& l : r.statistics.limits) {
    if (table.rows.size() == most) break;
    std::string states;
    for (std::size_t k = 0; k < l.states.size() && k < most_states; ++k) states += (k ? ", " : "") + l.states[k];
    if (l.states.size() > most_states) states += ", …";
    table.rows.push_back({l.element.empty() ? "—" : l.element, l.by, states, std::to_string(l.steps),
                          fmt::format("{:.1f} %", 100 * l.share)});
  }
  return table;
}

void add_background(Report& report, const Results& results) {
  ReportSection& audit = report.add("Energy, cost, events");
  if (results.back()->energy.checks > 0) audit.cards.push_back(energy_table(results));
  audit.cards.push_back(statistics_table(results));
  for (const Result* r : results)
    if (!r->statistics.limits.empty()) audit.cards.push_back(limits_table(*r));
  for (const Result* r : results)
    if (!r->events.empty()) audit.cards.push_back(events_table(*r));
  ReportSection& model = report.add("What was on, what was merged, and why");
  for (const Result* r : results)
    model.cards.push_back(Text{.title = fmt::format("{} model", r->label), .body = r->explanation, .verbatim = true});
  std::string method;
  for (const Result* r : results)
    method += fmt::format("{}: {} — {}\n", r->label, r->statistics.method, r->statistics.reason);
  model.cards.push_back(Text{.title = "How it was integrated", .body = method, .verbatim = true});
  if (results.back()->model && !results.back()->model->scene.text.empty())
    report.add("Scene").cards.push_back(Text{.title = results.back()->scene_file,
                                             .body = results.back()->model->scene.text,
                                             .verbatim = true,
                                             .folded = true});
}

void add_notes(Report& report, const std::vector<std::string>& notes) {
  if (notes.empty()) return;
  std::string body;
  for (const std::string& note : notes) body += note + "\n";
  report.add("Notes").cards.push_back(Text{.title = "", .body = body});
}

KeyFigure key_of(const Figure& f, const std::string& note) {
  return {in_words(f.name), f.value, f.unit, f.error, note};
}

// Largest peak of torque in any coupling.
const Figure* largest_peak(const Result& r) {
  const Figure* peak = nullptr;
  for (const Figure& f : r.figures)
    if (f.name.starts_with("peak_torque.") && is_told(f, r) && (!peak || std::abs(f.value) > std::abs(peak->value)))
      peak = &f;
  return peak;
}

const Figure* first_with(const Result& r, const std::string& prefix) {
  for (const Figure& f : r.figures)
    if (f.name.starts_with(prefix) && is_told(f, r)) return &f;
  return nullptr;
}

void add_delta_formula(ReportSection& section, const Results& results) {
  for (const Result* r : results) {
    if (r->cycles.empty()) continue;
    const Figure* delta = first_with(*r, "delta.");
    const CycleRecord* cycle = nullptr;
    for (const CycleRecord& c : r->cycles)
      if (delta && delta->at && c.end == *delta->at) cycle = &c;
    if (!cycle) continue;
    section.cards.push_back(
        Formula{.title = fmt::format("Speed fluctuation, {} model (theory 2.6)", r->label),
                .symbols = "δ = (ω_max − ω_min) / ω_m,   ω_m = (ω_max + ω_min)/2",
                .numbers = fmt::format("δ = ({:.5g} − {:.5g}) rad/s / {:.5g} rad/s = {}", cycle->omega_max,
                                       cycle->omega_min, cycle->mean_speed(), sure(*delta)),
                .note = fmt::format("Cycle from {:.5g} to {:.5g} s.", cycle->begin, cycle->end)});
  }
}

std::string conclusion_of(const Result& r) {
  if (!r.complete) return fmt::format("The run is incomplete: {}", r.diagnosis);
  std::string text;
  if (r.unconfirmed()) text = fmt::format("NOT confirmed: {}. ", r.accuracy_in_words());
  const std::size_t begin = text.size();
  if (const Figure* peak = largest_peak(r))
    text += fmt::format("The torque in {} reaches {}{}", peak->name.substr(std::string("peak_torque.").size()),
                        sure(*peak), peak->at ? " " + at_time(*peak) : "");
  if (const Figure* delta = first_with(r, "delta."))
    text += fmt::format("{} speed of {} fluctuates by δ = {}{}", text.size() == begin ? "The" : "; the",
                        delta->name.substr(6), sure(*delta),
                        r.periods.steady ? "" : " in the last cycle, which is not steady");
  if (text.size() == begin)
    if (const Figure* speed = first_with(r, "final_speed."))
      text += fmt::format("{} ends at {}", speed->name.substr(12), sure(*speed));
  if (has_works(r) && nothing_turned_over(r.energy))
    text += fmt::format("{}o work is done and no energy changes its form", text.size() == begin ? "N" : "; n");
  else if (has_works(r))
    text += fmt::format("{}he energy balance closes to {:.1e}", text.size() == begin ? "T" : "; t", r.energy.relative);
  return text + ".";
}

}  // namespace

bool nothing_turned_over(const EnergyBalance& e) {
  return e.kinetic_start == e.kinetic_end && e.stored_start == e.stored_end &&
         std::all_of(e.by_account.begin(), e.by_account.end(), [](const auto& account) { return account.second == 0; });
}

bool is_told(const Figure& f, const Result& r) { return r.complete || std::isfinite(f.value); }

bool has_works(const Result& r) {
  const auto finite = [](const auto& line) { return std::isfinite(line.second); };
  return r.energy.checks > 0 && (r.complete || (!nothing_turned_over(r.energy) && std::isfinite(r.energy.relative) &&
                                                std::all_of(r.energy.by_line.begin(), r.energy.by_line.end(), finite)));
}

std::vector<Plot> motion_plots(const Results& results) {
  std::vector<Plot> plots;
  if (!drawable(results)) return plots;
  const auto add = [&](std::optional<Plot> plot) {
    if (!plot) return;
    note_marks(*plot);
    plots.push_back(std::move(*plot));
  };
  const Result& front = *results.back();
  const std::string link = link_of(front);
  for (const char* end : {"", ".out"})
    add(over_time(results, "speed." + link + end, fmt::format("Speed of {}", link), "speed"));
  add(over_angle(results, "speed." + link, fmt::format("Speed of {} over its angle", link), "speed"));
  const std::vector<std::string> joints = couplings(front);
  for (std::size_t i = 0; i < joints.size() && i < most_torque_plots; ++i) {
    add(over_time(results, "torque." + joints[i], fmt::format("Torque in {}", joints[i]), "torque"));
    add(over_angle(results, "torque." + joints[i], fmt::format("Torque in {} over the crank's angle", joints[i]),
                   "torque"));
  }
  for (const Trace& trace : front.traces->over_time) {
    if (trace.name.starts_with("position."))
      add(over_time(results, trace.name,
                    fmt::format("{} of {}", trace.unit == "m" ? "Position of the slider" : "Angle of the rocker",
                                trace.name.substr(9)),
                    trace.unit == "m" ? "position" : "angle"));
    if (trace.name.starts_with("velocity."))
      add(over_time(
          results, trace.name,
          fmt::format("Speed of the {} of {}", trace.unit == "m/s" ? "slider" : "rocker", trace.name.substr(9)),
          trace.unit == "m/s" ? "slider speed" : "rocker speed"));
    if (trace.name.starts_with("load_torque.")) {
      add(over_time(results, trace.name, fmt::format("Load torque on the rocker of {}", trace.name.substr(12)),
                    "torque"));
      add(over_angle(results, trace.name,
                     fmt::format("Load torque on the rocker of {} over the crank's angle", trace.name.substr(12)),
                     "torque"));
    }
    if (trace.name.starts_with("force.")) {
      add(over_time(results, trace.name, fmt::format("Force on the slider of {}", trace.name.substr(6)), "force"));
      add(over_angle(results, trace.name,
                     fmt::format("Force on the slider of {} over the crank's angle", trace.name.substr(6)), "force"));
    }
    if (const auto [title, label] = of_joint_or_rod(trace.name); !title.empty())
      add(over_time(results, trace.name, title, label));
  }
  for (const Result* r : results) plots.push_back(energy_plot(*r));
  return plots;
}

Table figures_table(const Result& r, bool folded) {
  Table table{.title = fmt::format("All figures, {} model, with their measured errors (theory 15.1)", r.label),
              .columns = {"figure", "value", "error", "unit", "at [s]"},
              .rows = {},
              .folded = folded};
  for (const Figure& f : r.figures)
    if (is_told(f, r))
      table.rows.push_back(
          {f.name, figure_text(f.value, f.error).value, error_cell(f.value, f.error), pretty_unit(f.unit), time_of(f)});
  return table;
}

Report report_of(const Result& r) {
  Report report{
      .title = r.title,
      .subtitle = fmt::format("{} model, {}", r.label, r.effects == "none" ? "no effects on" : "effects: " + r.effects),
      .conclusion = conclusion_of(r),
      .complete = r.complete};
  if (const Figure* peak = largest_peak(r)) report.figures.push_back(key_of(*peak, at_time(*peak)));
  for (const char* prefix : {"delta.", "mean_speed.", "peak_force.", "run_up_time"})
    if (const Figure* f = first_with(r, prefix)) report.figures.push_back(key_of(*f, ""));
  report.figures.push_back({"coordinates",
                            static_cast<double>(r.coordinates),
                            "",
                            {},
                            fmt::format("{:.3g} ms of processor time a run", 1e3 * r.statistics.cpu_seconds)});
  add_machine_and_plots(report, {&r});
  ReportSection& figures = report.add("Figures");
  figures.cards.push_back(figures_table(r, false));
  add_delta_formula(figures, {&r});
  std::vector<std::string> notes = r.notes;
  if (r.complete && !r.periods.verdict.empty())
    notes.push_back(fmt::format("{}: {}", r.periods.steady ? "steady motion" : "no steady motion", r.periods.verdict));
  add_notes(report, notes);
  add_background(report, {&r});
  report.footer = report_footer();
  return report;
}

Report report_of(const Comparison& c) {
  const Results results = {&c.a, &c.b};
  Report report{.title = c.title,
                .subtitle = fmt::format("{} ({}) against {} ({})", c.a.label, c.a.effects, c.b.label, c.b.effects),
                .conclusion = c.conclusion,
                .complete = c.a.complete && c.b.complete};
  const auto add_key = [&](const Figure* f) {
    if (!f) return;
    const Figure* other = c.a.find(f->name);
    report.figures.push_back(
        key_of(*f, other ? fmt::format("{}: {}{}", c.a.label, with_error(other->value, other->error, ""),
                                       other->value != 0 ? fmt::format(" · ratio {:.3f}", f->value / other->value) : "")
                         : ""));
  };
  for (const std::string& joint : drawable(results) ? couplings(c.b) : std::vector<std::string>{})
    if (report.figures.size() < 3) add_key(c.b.find("peak_torque." + joint));
  add_key(first_with(c.b, "delta."));
  add_key(first_with(c.b, "mean_speed."));
  report.figures.push_back({"processor time of a run",
                            1e3 * c.b.statistics.cpu_seconds,
                            "ms",
                            {},
                            fmt::format("{}: {:.3g} ms", c.a.label, 1e3 * c.a.statistics.cpu_seconds),
                            3});
  add_machine_and_plots(report, results);

  ReportSection& figures = report.add("Figures");
  Table table{.title = "Every figure of both models",
              .columns = {"figure", c.a.label, "error", c.b.label, "error", "unit", c.b.label + "/" + c.a.label},
              .rows = {}};
  const auto number = [](const std::optional<double>& v, const std::optional<double>& e) {
    return v ? figure_text(*v, e).value : "—";
  };
  const auto error = [](const std::optional<double>& v, const std::optional<double>& e) {
    return v ? error_cell(*v, e) : "";
  };
  for (const ComparisonRow& row : c.rows)
    table.rows.push_back({row.name, number(row.a, row.a_error), error(row.a, row.a_error), number(row.b, row.b_error),
                          error(row.b, row.b_error), pretty_unit(row.unit),
                          row.ratio ? fmt::format("{:.4g}", *row.ratio) : ""});
  figures.cards.push_back(std::move(table));
  for (const ComparisonRow& row : c.amplification) {
    const std::string joint = row.name.substr(std::string("amplification.").size());
    const Figure *a = c.a.find("peak_torque." + joint), *b = c.b.find("peak_torque." + joint);
    if (!a || !b || !row.b) continue;
    figures.cards.push_back(
        Formula{.title = fmt::format("Torque amplification in {} (theory 14.2)", joint),
                .symbols = fmt::format("K = |τ_{}| / |τ_{}|", c.b.label, c.a.label),
                .numbers = fmt::format("K = |{}| / |{}| = {}", figure_text(b->value, b->error).value,
                                       figure_text(a->value, a->error).value, with_error(*row.b, row.b_error, "")),
                .note = "Largest transmitted torques, each at its own time."});
  }
  add_delta_formula(figures, results);
  std::vector<std::string> notes = c.notes;
  for (const Result* r : results)
    for (const std::string& note : r->notes) notes.push_back(r->label + ": " + note);
  add_notes(report, notes);
  add_background(report, results);
  report.footer = report_footer();
  return report;
}

}  // namespace kurbel
