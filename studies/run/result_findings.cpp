// result_findings.cpp — tables after the figures: energy, cost, limits of steps, events; a run for programs.
#include "engine/scene/text.h"
#include "studies/run/run_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

#include "engine/run/recorders.h"
#include "engine/scene/units.h"
#include "studies/claims/headline.h"
#include "studies/duty/work_periods.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/trace.h"
#include "studies/run/periods.h"
#include "studies/tables/trajectory_rows.h"

namespace kurbel {
namespace {

// --- tables ---

std::string time_of(const Result& r, std::size_t event) {
  if (r.event_errors.empty()) return with_error({r.events[event].t}, "");
  const std::optional<double>& error = r.event_errors[event];
  return with_error({r.events[event].t, error}, "") + (error ? "" : " (in the finer run only)");
}

// One row for all that read alike, at the place of the first.
Rows events_table(const Result& r) {
  struct Kind {
    std::size_t first = 0, last = 0, count = 0;
  };
  std::vector<Kind> kinds;
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> known;
  for (std::size_t i = 0; i < r.events.size(); ++i) {
    const Event& e = r.events[i];
    const auto [kind, is_new] = known.try_emplace({e.component, e.from, e.what}, kinds.size());
    if (is_new) kinds.push_back({i});
    kinds[kind->second].last = i, ++kinds[kind->second].count;
  }
  Lines lines;
  constexpr std::size_t most = 500;
  const bool all = kinds.size() <= most;
  if (!all) kinds.resize(most);
  for (const auto& [first, last, count] : kinds) {
    const Event& e = r.events[first];
    const double interval = count > 1 ? (r.events[last].t - e.t) / static_cast<double>(count - 1) : NAN;
    lines.push_back({e.component, e.from, e.what, time_of(r, first), fmt::format("{}", count),
                     count > 1 ? time_of(r, last) : "", count > 1 ? read_as(interval, {.digits = 4}) : ""});
  }
  Rows table =
      words_table(fmt::format("Events, {} model ({}{})", r.label, r.events.size(),
                              all ? "" : fmt::format("; the first {} kinds", most)),
                  {"component", "from", "to", "first at [s]", "times", "last at [s]", "mean interval [s]"}, lines);
  table.folded = true;
  table.text_columns = 3;
  return table;
}

// One row per quantity, the models side by side.
class SideBySide {
 public:
  SideBySide(std::string title, const Results& results) : title_(std::move(title)), results_(results) {
    for (const Result* r : results) headings_.push_back(r->label);
  }
  template <class Get>
  void row(const std::string& name, Get value) {
    lines_.push_back({name});
    for (const Result* r : results_) lines_.back().push_back(read_as(value(*r)));
  }
  Rows rows() const { return words_table(title_, headings_, lines_); }

 private:
  std::string title_;
  const Results& results_;
  std::vector<std::string> headings_ = {""};
  Lines lines_;
};

Rows statistics_table(const Results& results) {
  SideBySide table("What it cost", results);
  table.row("coordinates", [](const Result& r) { return r.coordinates; });
  table.row("method", [](const Result& r) { return r.statistics.method; });
  table.row("steps", [](const Result& r) { return r.statistics.stepper.steps; });
  table.row("rejected steps", [](const Result& r) { return r.statistics.stepper.rejected; });
  table.row("evaluations of the equations", [](const Result& r) { return r.statistics.stepper.flow_calls; });
  table.row("events", [](const Result& r) { return r.statistics.events; });
  table.row("processor time of a run [ms]",
            [](const Result& r) { return fmt::format("{:.3g}", 1e3 * r.statistics.cpu_seconds); });
  table.row("runs", [](const Result& r) { return r.runs; });
  table.row("requested accuracy", [](const Result& r) { return fmt::format("{:.1e}", r.accuracy); });
  table.row("accuracy measured", [](const Result& r) {
    return r.errors_measured ? fmt::format("{:.1e}", r.measured_accuracy) : std::string("—");
  });
  table.row("energy balance closes to", [](const Result& r) {
    return !has_works(r)                   ? std::string("—")
           : nothing_turned_over(r.energy) ? std::string("no energy converted")
           : r.energy.relative > 0         ? fmt::format("{:.1e}", r.energy.relative)
                                           : std::string("0");
  });
  return table.rows();
}

Rows energy_table(const Results& results) {
  SideBySide table("Energy audit [J] (theory 1.3)", results);
  const auto row = [&](const std::string& name, auto value) {
    table.row(name, [&](const Result& r) { return fmt::format("{:.6g}", value(r.energy)); });
  };
  std::set<std::string> accounts;
  for (const Result* r : results)
    for (const auto& [name, work] : r->energy.by_account) accounts.insert(name);
  for (const std::string& name : accounts)
    row("work of " + name, [&](const EnergyBalance& e) {
      const auto found = e.by_account.find(name);
      return found == e.by_account.end() ? 0.0 : found->second;
    });
  row("kinetic energy at the start", [](const EnergyBalance& e) { return e.kinetic_start; });
  row("kinetic energy at the end", [](const EnergyBalance& e) { return e.kinetic_end; });
  row("stored in springs at the start", [](const EnergyBalance& e) { return e.stored_start; });
  row("stored in springs at the end", [](const EnergyBalance& e) { return e.stored_end; });
  row("residual", [](const EnergyBalance& e) { return e.residual; });
  return table.rows();
}

// Causes of short steps, ranked.
Rows limits_table(const Result& r) {
  constexpr std::size_t most = 12, most_states = 3;
  return table_of("", fmt::format("What kept the steps short, {} model", r.label), r.statistics.limits)
      .people_see_first(most)
      .text_in(3)
      .column("element", "element", &LimitedSteps::element,
              [](const std::string& element) { return element.empty() ? "—" : element; })
      .column("by", "by", &LimitedSteps::by)
      .column("states", "states", &LimitedSteps::states,
              [](const std::vector<std::string>& all) {
                std::string states;
                for (std::size_t k = 0; k < all.size() && k < most_states; ++k) states += (k ? ", " : "") + all[k];
                return states + (all.size() > most_states ? ", …" : "");
              })
      .column("steps", "steps", &LimitedSteps::steps)
      .column("share", "share", &LimitedSteps::share,
              [](double share) { return fmt::format("{:.1f} %", 100 * share); });
}

// --- for programs ---

Record figure_record(const Figure& f) {
  return {{"name", f.name},   {"value", f.value}, {"unit", f.unit},
          {"error", f.error}, {"at", f.at},       {"at_error", f.at_error}};
}

Record state_record(const ComponentState& s) {
  Record r = {{"angle", s.angle}, {"speed", s.speed}};
  if (s.angle_out) r.push_back({"angle_out", *s.angle_out});
  if (s.speed_out) r.push_back({"speed_out", *s.speed_out});
  return r;
}

Record event_record(const Result& r, std::size_t k) {
  const Event& e = r.events[k];
  Record record = {{"t", e.t}, {"component", e.component}, {"kind", name_of(e.kind)}, {"what", e.what}};
  if (!e.from.empty()) record.push_back({"from", e.from});
  if (e.value) record.push_back({"value", *e.value});
  record.push_back({"error", r.event_errors.empty() ? Value() : Value(r.event_errors[k])});
  if (!r.event_errors.empty() && !r.event_errors[k]) record.push_back({"only_in_finer_run", true});
  return record;
}

template <class Map, class Of>
Record named(const Map& map, Of of) {
  Record record;
  for (const auto& [name, value] : map) record.push_back({name, of(value)});
  return record;
}

Record energy_record(const EnergyBalance& e) {
  const auto work = [](double w) { return w; };
  return {{"work", named(e.by_line, work)},
          {"work_by_component", named(e.by_account, work)},
          {"kinetic_start", e.kinetic_start},
          {"kinetic_end", e.kinetic_end},
          {"stored_start", e.stored_start},
          {"stored_end", e.stored_end},
          {"residual", e.residual},
          {"relative", e.relative},
          {"bodies_against_reduced", e.reduction_residual},
          {"free_bodies", e.free_bodies},
          {"check_points", e.checks},
          {"unit", "J"}};
}

Record statistics_record(const Result& r) {
  const StepperStatistics& s = r.statistics.stepper;
  return {{"method", r.statistics.method},
          {"reason", r.statistics.reason},
          {"steps", s.steps},
          {"rejected", s.rejected},
          {"flow_calls", s.flow_calls},
          {"jacobian_calls", s.jacobian_calls},
          {"factorisations", s.factorisations},
          {"events", r.statistics.events},
          {"cpu_seconds", r.statistics.cpu_seconds},
          {"cpu_seconds_all_runs", r.cpu_total},
          {"runs", r.runs},
          {"limits", limits_table(r).list()}};
}

}  // namespace

Record result_record(const Result& r) {
  std::vector<Figure> figures = r.figures;
  std::erase_if(figures, [&](const Figure& f) { return !is_reported(f, r); });
  const Periods& p = r.periods;
  return {{"model", Record{{"label", r.label},
                           {"effects", r.effects},
                           {"coordinates", r.coordinates},
                           {"states", r.states},
                           {"explanation", r.explanation}}},
          {"figures", each(figures, figure_record)},
          {"final", named(r.final_state, state_record)},
          {"events", each(numbers_below(r.events.size()), [&](std::size_t k) { return event_record(r, k); })},
          {"periods", Record{{"run_up_end", p.run_up_end},
                             {"run_down_begin", p.run_down_begin},
                             {"standstill", p.standstill},
                             {"steady", p.steady},
                             {"repeats_after", p.steady ? Value(p.cycles) : Value()},
                             {"period_of_time", p.time > 0 ? Value(p.time) : Value()},
                             {"remaining_to_limit", p.remaining},
                             {"verdict", p.verdict}}},
          {"cycles", each(r.cycles,
                          [](const CycleRecord& c) {
                            return Record{{"begin", c.begin},
                                          {"end", c.end},
                                          {"max_speed", c.omega_max},
                                          {"min_speed", c.omega_min},
                                          {"fluctuation", c.fluctuation()}};
                          })},
          {"energy_balance", energy_record(r.energy)},
          {"accuracy", Record{{"asked", r.accuracy},
                              {"measured", r.errors_measured ? Value(r.measured_accuracy) : Value()},
                              {"confirmed", r.confirmation_asked ? Value(r.accuracy_confirmed) : Value()},
                              {"tolerance", r.tolerance}}},
          {"statistics", statistics_record(r)},
          {"notes", r.notes}};
}

DataTable trajectory_data(const Result& r) {
  DataTable table{.remark = r.complete ? "" : "incomplete: " + r.diagnosis,
                  .columns = {{"time", "s"}},
                  .each_row = [&t = *r.trajectory](const std::function<void(DataRow)>& take) {
                    std::vector<DataCell> cells(t.channels().size() + 1);
                    for_each_row(t, [&](double time, std::span<const double> values) {
                      cells.front() = time;
                      std::copy(values.begin(), values.end(), cells.begin() + 1);
                      take(cells);
                    });
                  }};
  for (const Channel& channel : r.trajectory->channels()) table.columns.push_back({channel.name.text, channel.unit});
  return table;
}

std::string coarse_rows_note(const TrajectoryRecorder& t, std::int64_t steps) {
  constexpr double tolerable = 0.05, alike = 1e-6;
  const std::size_t columns = t.channels().size();
  std::size_t worst = 0;
  double missed = 0;
  for (std::size_t k = 0; k < columns; ++k) {
    double held = 0, reached = 0;
    for (std::size_t row = 0; row < t.time().size(); ++row) held = std::max(held, std::abs(t.value(row, k)));
    for (const TrajectoryRecorder::Row& peak : t.peaks()) reached = std::max(reached, std::abs(peak.values[k]));
    if (reached > 0 && 1 - held / reached > missed + alike) worst = k, missed = 1 - held / reached;
  }
  if (!(missed > tolerable) || t.time().size() < 2) return {};
  const double enough = std::max(std::pow(10, std::ceil(std::log10(2.0 * static_cast<double>(steps)))),
                                 10 * static_cast<double>(t.time().size()));
  const std::string beyond = missed < 1
                                 ? fmt::format("exceeds them by {:.0f} % in between", 100 * missed / (1 - missed))
                                 : "is zero in all of them";
  return fmt::format(
      "the rows of trajectory.csv, one every {}, are too coarse for the motion: {} {}; its peaks have rows of their "
      "own; samples = {:.0f} gives sufficient rows",
      short_text(t.time()[1] - t.time()[0], "s"), t.channels()[worst].name.text, beyond, std::min(enough, 1e6));
}

// --- chapters of the page ---

void show_motion(Findings& f, const Results& results) {
  if (!drawable(results)) return;
  f.draw(f.chapter(""), [results] { return Cards{machine_view(results)}; });
  const bool over_angle =
      std::any_of(results.begin(), results.end(), [](const Result* r) { return !r->traces->last_cycles.empty(); });
  const Chapter plots =
      f.chapter(over_angle ? "Over time and over the " + angle_of_link(*results.back()) : std::string("Over time"));
  f.draw(plots, [results] { return motion_plots(results); });
  f.draw(f.chapter("What drives, slips and heats"), [results] { return drive_plots(results); });
  if (const std::size_t all = couplings(*results.back()).size(); all > most_torque_plots)
    f.show(plots, Text{.title = "Further couplings",
                       .body = fmt::format("Torques are plotted for the {} couplings with the largest peaks, of {}; "
                                           "trajectory.csv holds the others.",
                                           most_torque_plots, all)});
}

void show_works_of_periods(Findings& f, Chapter in, const Result& r) {
  if (!r.model || !r.complete) return;
  Lines lines;
  for (const WorkPeriod& p : three_periods(r.periods, r.begins_at, r.until)) {
    const std::string words = std::string("work_of_") + p.name;
    std::vector<std::string> line = {as_words(p.name), read_as(p.begin), read_as(p.end)};
    WorkPeriod reported = p;
    for (std::size_t i = 0; i < 5; ++i) {
      constexpr std::array kinds = {"driving", "useful", "harmful", "weight", "energy"};
      const Figure* figure = r.find(words + "." + kinds[i]);
      if (!figure) return;
      line.push_back(figure_text(*figure).value);
      (i < reported.work.size() ? reported.work[i] : reported.energy) = figure->value;
    }
    line.push_back(fmt::format("{:.1e}", reported.residual()));
    const std::optional<double> efficiency = reported.efficiency();
    line.push_back(efficiency ? fmt::format("{:.4g} %", 100 * *efficiency) : "—");
    lines.push_back(std::move(line));
  }
  if (lines.empty()) return;
  Rows table = words_table(
      fmt::format("Works by period [J], {} model (theory 1.3)", r.label),
      {"period", "from [s]", "to [s]", "driving", "useful", "harmful", "weight", "ΔE", "open", "efficiency"}, lines);
  table.heading = "works by period [J]";
  f.say(in, std::move(table));
}

void show_delta_formulas(Findings& f, Chapter in, const Results& results) {
  for (const Result* r : results) {
    if (r->cycles.empty()) continue;
    const Figure* delta = first_of(*r, quantities::delta);
    if (!delta) delta = first_of(*r, quantities::cycle_fluctuation);
    if (!delta || !delta->at) continue;
    const std::vector<CycleRecord> periods = in_periods(r->cycles, r->periods.cycles, *delta->at);
    if (periods.empty()) continue;
    const CycleRecord* cycle = &periods.back();
    const SpeedUnit speed = speed_unit_of(*r);
    const bool repeats = delta->what == quantities::delta;
    const std::string symbol = repeats ? "δ" : "Δω/ω_mid";
    f.show(in, Formulas()
                   .add(fmt::format("Speed fluctuation, {} model (theory 2.6)", r->label),
                        symbol + " = (ω_max − ω_min) / ω_mid,   ω_mid = (ω_max + ω_min)/2",
                        "{} = ({:.5g} − {:.5g}) {} / {} = {}", symbol, speed.of(cycle->omega_max),
                        speed.of(cycle->omega_min), pretty_unit(speed.name), speed.text(cycle->mid_speed(), 5),
                        sure(*delta))
                   .note(fmt::format("{} from {:.5g} to {:.5g} s{}.", capitalised(cycle_of_figures(*r)), cycle->begin,
                                     cycle->end, repeats ? "" : "; the motion does not repeat, so this is no δ")));
  }
}

void show_background(Findings& f, const Results& results) {
  const Chapter audit = f.chapter(chapter_of_cost), model = f.chapter(chapter_of_model);
  const auto say = [&](Rows rows) {
    rows.terminal = false;
    f.say(audit, std::move(rows));
  };
  if (results.back()->energy.checks > 0) say(energy_table(results));
  say(statistics_table(results));
  for (const Result* r : results) say(limits_table(*r));
  for (const Result* r : results)
    if (!r->events.empty()) say(events_table(*r));
  std::string method;
  for (const Result* r : results) {
    f.show(model, Text{.title = fmt::format("{} model", r->label), .body = r->explanation, .verbatim = true});
    method += fmt::format("{}: {} — {}\n", r->label, r->statistics.method, r->statistics.reason);
  }
  f.show(model, Text{.title = "How it was integrated", .body = method, .verbatim = true});
  if (const auto& last = *results.back(); last.model && !last.model->scene.text.empty())
    f.show_scene(last.scene_file, last.model->scene.text);
}

std::vector<LimitedSteps> limits_of(const RunOutcome& outcome, Equations& equations) {
  if (outcome.state.empty()) return {};
  try {
    return outcome.limits.ranked(equations, outcome.t, outcome.state);
  } catch (const std::runtime_error&) {
    return {};
  }
}

}  // namespace kurbel
