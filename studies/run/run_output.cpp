// run_output.cpp — tables, JSON, CSV and reports of run and compare.
#include "studies/run/run_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/json_text.h"
#include "studies/findings/text_table.h"
#include "studies/run/run_report.h"

namespace kurbel {
namespace {

using Json = nlohmann::ordered_json;

std::string number(double value, int digits = 7) { return fmt::format("{:.{}g}", value, digits); }
std::string value_cell(const std::optional<double>& value, const std::optional<double>& error) {
  return value ? figure_text(*value, error).value : "—";
}
std::string error_cell(const std::optional<double>& value, const std::optional<double>& error) {
  return value ? kurbel::error_cell(*value, error) : "";
}
// The time of a period's end from the figure that has it, if one has.
std::string time_text(const Result& r, double t) {
  for (const Figure& f : r.figures)
    if (f.at && *f.at == t && (f.name == "run_up_time" || f.name == "run_down_time"))
      return with_error(t, f.error, "s");
  return with_unit(t, "s", 6);
}

std::string heading(const Result& r) {
  std::string text =
      fmt::format("{}: {} coordinate{}, {} — {}\n", r.label, r.coordinates, r.coordinates == 1 ? "" : "s",
                  r.effects == "none" ? "no effects on" : "effects: " + r.effects, r.statistics.method);
  text += fmt::format("  {}; {} steps, {:.3g} ms of processor time a run, {} run{}\n", r.statistics.reason,
                      r.statistics.stepper.steps, 1e3 * r.statistics.cpu_seconds, r.runs, r.runs == 1 ? "" : "s");
  if (const std::string limits = told(r.statistics.limits); !limits.empty())
    text += fmt::format("  what kept the steps short: {}\n", limits);
  if (!r.complete) text += fmt::format("  INCOMPLETE: {}\n", r.diagnosis);
  return text;
}

// What the figures of a cycle belong to, where there are any.
std::string of_last_cycle(const Result& r) {
  const bool any =
      std::any_of(r.figures.begin(), r.figures.end(), [](const Figure& f) { return f.name.starts_with("delta."); });
  return any && !r.periods.steady ? " (figures of a cycle are those of the last whole one)" : "";
}

std::string footing(const Result& r) {
  std::string text;
  const EnergyBalance& e = r.energy;
  if (has_works(r)) {
    text += "  work:";
    for (const auto& [line, work] : e.by_line) text += fmt::format(" {} {},", line, with_unit(work, "J", 5));
    text.back() = '\n';
    text += "  " + told(e);
    if (e.reduction_residual > 0) text += fmt::format("; bodies against reduced inertia {:.1e}", e.reduction_residual);
    text += "\n";
  }
  if (r.errors_measured)
    text += fmt::format("  accuracy: {:.1e} asked for, {:.1e} measured{}\n", r.accuracy, r.measured_accuracy,
                        r.accuracy_confirmed ? "" : " — NOT confirmed");
  else if (r.complete)
    text += r.unconfirmed() ? "  accuracy: errors could not be measured — NOT confirmed\n"
                            : "  errors were not measured (--no-error): digits are not what is sure\n";
  const Periods& p = r.periods;
  if (p.run_up_end)
    text += fmt::format("  run-up to {}", time_text(r, *p.run_up_end)) +
            (p.run_down_begin
                 ? fmt::format(", steady to {}, then run-down{}", with_unit(*p.run_down_begin, "s", 6),
                               p.standstill ? fmt::format(" to standstill at {}", time_text(r, *p.standstill)) : "")
                 : ", then steady motion") +
            "\n";
  if (r.complete && r.trajectory)
    text += fmt::format("  {}{}: {}\n", p.steady ? "steady motion" : "no steady motion within the time simulated",
                        of_last_cycle(r), p.verdict);
  for (const std::string& note : r.notes) text += "  note: " + note + "\n";
  return text;
}

Json optional_json(const std::optional<double>& v) { return v ? Json(*v) : Json(); }

Json figure_json(const Figure& f) {
  Json j = {{"name", f.name}, {"value", f.value}, {"unit", f.unit}};
  j["error"] = optional_json(f.error);
  j["at"] = optional_json(f.at);
  j["at_error"] = optional_json(f.at_error);
  return j;
}

Json state_json(const ComponentState& s) {
  Json j = {{"angle", s.angle}, {"speed", s.speed}};
  j["angle_error"] = optional_json(s.angle_error);
  j["speed_error"] = optional_json(s.speed_error);
  if (!s.angle_out) return j;
  j.update({{"angle_out", *s.angle_out}, {"speed_out", *s.speed_out}});
  j["angle_out_error"] = optional_json(s.angle_out_error);
  j["speed_out_error"] = optional_json(s.speed_out_error);
  return j;
}

Json event_json(const Result& r, std::size_t k) {
  const Event& e = r.events[k];
  Json j = {{"t", e.t}, {"component", e.component}, {"kind", name_of(e.kind)}, {"what", e.what}};
  if (!e.from.empty()) j["from"] = e.from;
  j["error"] = r.event_errors.empty() ? Json() : optional_json(r.event_errors[k]);
  if (!r.event_errors.empty() && !r.event_errors[k]) j["only_in_finer_run"] = true;
  return j;
}

Json result_json(const Result& r) {
  Json j;
  j["title"] = r.title;
  if (r.begins_at > 0) j["goes_on_from"] = r.begins_at;
  j["scene"] = r.scene_file;
  j["complete"] = r.complete;
  if (!r.complete) j["diagnosis"] = r.diagnosis;
  j["model"] = {{"label", r.label},
                {"effects", r.effects},
                {"coordinates", r.coordinates},
                {"states", r.states},
                {"explanation", r.explanation}};
  j["figures"] = Json::array();
  for (const Figure& f : r.figures)
    if (is_told(f, r)) j["figures"].push_back(figure_json(f));
  j["final"] = Json::object();
  auto& states = j["final"].get_ref<Json::object_t&>();
  for (const auto& [name, state] : r.final_state) {  // no name comes twice, and none is looked for
    const std::pair<const std::string, Json> entry(name, state_json(state));
    states.push_back(entry);
  }
  j["events"] = Json::array();
  for (std::size_t k = 0; k < r.events.size(); ++k) j["events"].push_back(event_json(r, k));
  j["periods"] = {{"run_up_end", optional_json(r.periods.run_up_end)},
                  {"run_down_begin", optional_json(r.periods.run_down_begin)},
                  {"standstill", optional_json(r.periods.standstill)},
                  {"steady", r.periods.steady},
                  {"remaining_to_limit", optional_json(r.periods.remaining)},
                  {"verdict", r.periods.verdict}};
  j["cycles"] = Json::array();
  for (const CycleRecord& c : r.cycles)
    j["cycles"].push_back({{"begin", c.begin},
                           {"end", c.end},
                           {"max_speed", c.omega_max},
                           {"min_speed", c.omega_min},
                           {"delta", c.delta()}});
  const EnergyBalance& e = r.energy;
  j["energy_balance"] = {{"work", e.by_line},
                         {"work_by_component", e.by_account},
                         {"kinetic_start", e.kinetic_start},
                         {"kinetic_end", e.kinetic_end},
                         {"stored_start", e.stored_start},
                         {"stored_end", e.stored_end},
                         {"residual", e.residual},
                         {"relative", e.relative},
                         {"bodies_against_reduced", e.reduction_residual},
                         {"check_points", e.checks},
                         {"unit", "J"}};
  const StepperStatistics& s = r.statistics.stepper;
  j["accuracy"] = {{"asked", r.accuracy},
                   {"measured", r.errors_measured ? Json(r.measured_accuracy) : Json()},
                   {"confirmed", r.confirmation_asked ? Json(r.accuracy_confirmed) : Json()},
                   {"tolerance", r.tolerance}};
  j["statistics"] = {{"method", r.statistics.method},
                     {"reason", r.statistics.reason},
                     {"steps", s.steps},
                     {"rejected", s.rejected},
                     {"flow_calls", s.flow_calls},
                     {"jacobian_calls", s.jacobian_calls},
                     {"factorisations", s.factorisations},
                     {"events", r.statistics.events},
                     {"cpu_seconds", r.statistics.cpu_seconds},
                     {"cpu_seconds_all_runs", r.cpu_total},
                     {"runs", r.runs}};
  j["statistics"]["limits"] = Json::array();
  for (const LimitedSteps& l : r.statistics.limits)
    j["statistics"]["limits"].push_back(
        {{"element", l.element}, {"by", l.by}, {"states", l.states}, {"steps", l.steps}, {"share", l.share}});
  j["notes"] = r.notes;
  return j;
}

Json rows_json(const std::vector<ComparisonRow>& rows, const Comparison& c) {
  Json list = Json::array();
  for (const ComparisonRow& row : rows)
    list.push_back({{"name", row.name},
                    {"unit", row.unit},
                    {c.a.label, optional_json(row.a)},
                    {c.a.label + "_error", optional_json(row.a_error)},
                    {c.b.label, optional_json(row.b)},
                    {c.b.label + "_error", optional_json(row.b_error)},
                    {"difference", row.difference},
                    {"ratio", optional_json(row.ratio)}});
  return list;
}

Json comparison_json(const Comparison& c) {
  Json j;
  j["title"] = c.title;
  j["conclusion"] = c.conclusion;
  j["models"] = {{c.a.label, result_json(c.a)}, {c.b.label, result_json(c.b)}};
  j["comparison"] = rows_json(c.rows, c);
  Json factors = Json::array();
  for (const ComparisonRow& row : c.amplification)
    factors.push_back({{"name", row.name}, {"value", *row.b}, {"unit", ""}, {"error", optional_json(row.b_error)}});
  j["amplification"] = factors;
  j["notes"] = c.notes;
  return j;
}

std::string csv_of(const Result& r) {
  const TrajectoryRecorder& t = *r.trajectory;
  std::string text = r.complete ? "" : "# incomplete: " + r.diagnosis + "\n";
  text += "time [s]";
  for (const Channel& channel : t.channels()) text += fmt::format(",{} [{}]", channel.name.text, channel.unit);
  text += "\n";
  for (std::size_t row = 0; row < t.time().size(); ++row) {
    text += fmt::format("{}", t.time()[row]);
    for (std::size_t k = 0; k < t.channels().size(); ++k) text += fmt::format(",{:.12g}", t.value(row, k));
    text += "\n";
  }
  return text;
}

std::string one_line(const Result& r) {
  if (!r.complete) return fmt::format("{}: INCOMPLETE: {}", r.title, r.diagnosis);
  const std::string accuracy = r.unconfirmed()     ? "NOT confirmed: " + r.accuracy_in_words()
                               : r.errors_measured ? fmt::format("accuracy {:.1e} measured", r.measured_accuracy)
                                                   : "errors not measured";
  std::string peak;
  for (const Figure& f : r.figures)
    if (peak.empty() && f.name.starts_with("peak_torque."))
      peak = fmt::format("peak torque in {} {}, ", f.name.substr(12), with_error(f.value, f.error, "N*m"));
  std::string balance;
  if (r.energy.checks > 0)
    balance = nothing_turned_over(r.energy) ? ", no energy turned over"
                                            : fmt::format(", energy balance {:.1e}", r.energy.relative);
  const std::string span = r.begins_at > 0
                               ? fmt::format("{} … {}", with_unit(r.begins_at, "s", 6), with_unit(r.until, "s", 6))
                               : with_unit(r.until, "s", 6);
  return fmt::format("{}: {} simulated, {}, {}{}{}", r.title, span, r.label, peak, accuracy, balance);
}

}  // namespace

std::string told(const EnergyBalance& e) {
  if (!nothing_turned_over(e))
    return fmt::format("energy balance closed to {:.1e} of the energy turned over", e.relative);
  return e.kinetic_end > 0
             ? fmt::format("no work is done and the kinetic energy stays {}: no balance of energy to prove anything by",
                           with_unit(e.kinetic_end, "J", 5))
             : std::string("nothing moves and no work is done: no balance of energy to prove anything by");
}

std::string table_of(const Result& r) {
  std::string text = r.title + "\n" + heading(r);
  std::vector<std::vector<std::string>> rows = {{"figure", "value", "error", "unit", "at"}};
  for (const Figure& f : r.figures)
    if (is_told(f, r))
      rows.push_back({f.name, value_cell(f.value, f.error), error_cell(f.value, f.error), pretty_unit(f.unit),
                      f.at ? "at " + with_error(*f.at, f.at_error, "s") : ""});
  return text + aligned(rows, 1) + footing(r);
}

std::string table_of(const Comparison& c) {
  std::string text =
      c.title + "\n" + c.conclusion + "\n\n" + heading(c.a) + footing(c.a) + heading(c.b) + footing(c.b) + "\n";
  std::vector<std::vector<std::string>> rows = {
      {"figure", c.a.label, "error", c.b.label, "error", "unit", c.b.label + "/" + c.a.label}};
  for (const ComparisonRow& row : c.rows)
    rows.push_back({row.name, value_cell(row.a, row.a_error), error_cell(row.a, row.a_error),
                    value_cell(row.b, row.b_error), error_cell(row.b, row.b_error), pretty_unit(row.unit),
                    row.ratio ? number(*row.ratio, 4) : ""});
  for (const ComparisonRow& row : c.amplification)
    rows.push_back({row.name, "1", "", value_cell(row.b, row.b_error), error_cell(row.b, row.b_error), "", ""});
  text += aligned(rows, 1);
  for (const std::string& note : c.notes) text += "note: " + note + "\n";
  return text;
}

std::string json_of(const Result& r) { return json_text(result_json(r)); }
std::string json_of(const Comparison& c) { return json_text(comparison_json(c)); }

StudyOutput output_of(const Result& r) {
  StudyOutput output{one_line(r), table_of(r), json_of(r), [&r] { return report_of(r); }, {}, r.complete, r.diagnosis};
  if (r.unconfirmed()) output.unconfirmed = r.accuracy_in_words();
  if (r.trajectory) output.csv.push_back({"trajectory.csv", [&r] { return csv_of(r); }});
  return output;
}

StudyOutput output_of(const Comparison& c) {
  StudyOutput output{c.conclusion, table_of(c), json_of(c), [&c] { return report_of(c); }};
  for (const Result* r : {&c.a, &c.b}) {
    if (r->trajectory) output.csv.push_back({"trajectory." + r->label + ".csv", [r] { return csv_of(*r); }});
    if (r->unconfirmed()) output.unconfirmed = fmt::format("{} model: {}", r->label, r->accuracy_in_words());
    if (r->complete) continue;
    output.complete = false;
    if (output.diagnosis.empty()) output.diagnosis = r->diagnosis;
  }
  return output;
}

}  // namespace kurbel
