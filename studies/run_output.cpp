// run_output.cpp — tables, JSON, CSV and reports of run and compare.
#include "studies/run_output.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "engine/units.h"
#include "studies/report/run_report.h"
#include "studies/text_table.h"

namespace kurbel {
namespace {

using Json = nlohmann::ordered_json;

std::string number(double value, int digits = 7) { return fmt::format("{:.{}g}", value, digits); }
std::string error_of(const std::optional<double>& error) { return error ? "± " + number(*error, 2) : ""; }

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
                        r.accuracy_confirmed ? "" : " — NOT reached");
  else if (r.complete)
    text += "  errors were not measured (--no-error)\n";
  const Periods& p = r.periods;
  if (p.run_up_end)
    text +=
        fmt::format("  run-up to {}", with_unit(*p.run_up_end, "s", 5)) +
        (p.run_down_begin
             ? fmt::format(", steady to {}, then run-down{}", with_unit(*p.run_down_begin, "s", 5),
                           p.standstill ? fmt::format(" to standstill at {}", with_unit(*p.standstill, "s", 5)) : "")
             : ", then steady motion") +
        "\n";
  else if (!p.steady && r.complete && r.trajectory)
    text += "  no steady motion within the time simulated\n";
  for (const std::string& note : r.notes) text += "  note: " + note + "\n";
  return text;
}

Json figure_json(const Figure& f) {
  Json j = {{"name", f.name}, {"value", f.value}, {"unit", f.unit}};
  j["error"] = f.error ? Json(*f.error) : Json();
  j["at"] = f.at ? Json(*f.at) : Json();
  return j;
}

Json optional_json(const std::optional<double>& v) { return v ? Json(*v) : Json(); }

Json result_json(const Result& r) {
  Json j;
  j["title"] = r.title;
  j["scene"] = r.scene_file;
  j["complete"] = r.complete;
  if (!r.complete) j["diagnosis"] = r.diagnosis;
  j["model"] = {{"label", r.label},
                {"effects", r.effects},
                {"coordinates", r.coordinates},
                {"states", r.states},
                {"explanation", r.explanation}};
  j["figures"] = Json::array();
  for (const Figure& f : r.figures) j["figures"].push_back(figure_json(f));
  j["final"] = Json::object();
  for (const auto& [name, state] : r.final_state) {
    j["final"][name] = {{"angle", state.angle}, {"speed", state.speed}};
    if (state.angle_out) j["final"][name].update({{"angle_out", *state.angle_out}, {"speed_out", *state.speed_out}});
  }
  j["events"] = Json::array();
  for (const Event& e : r.events) {
    Json event = {{"t", e.t}, {"component", e.component}, {"what", e.what}};
    if (!e.from.empty()) event["from"] = e.from;
    j["events"].push_back(event);
  }
  j["periods"] = {{"run_up_end", optional_json(r.periods.run_up_end)},
                  {"run_down_begin", optional_json(r.periods.run_down_begin)},
                  {"standstill", optional_json(r.periods.standstill)},
                  {"steady", r.periods.steady}};
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
                   {"confirmed", r.accuracy_confirmed},
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
  for (const Channel& channel : t.channels()) text += fmt::format(",{} [{}]", channel.name, channel.unit);
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
  const std::string accuracy =
      r.errors_measured ? fmt::format("accuracy {:.1e} measured{}", r.measured_accuracy,
                                      r.accuracy_confirmed ? "" : fmt::format(", {:.1e} NOT reached", r.accuracy))
                        : "errors not measured";
  std::string peak;
  for (const Figure& f : r.figures)
    if (peak.empty() && f.name.starts_with("peak_torque."))
      peak = fmt::format("peak torque in {} {}, ", f.name.substr(12), with_unit(f.value, "N*m", 6));
  std::string balance;
  if (r.energy.checks > 0)
    balance = nothing_turned_over(r.energy) ? ", no energy turned over"
                                            : fmt::format(", energy balance {:.1e}", r.energy.relative);
  return fmt::format("{}: {} simulated, {}, {}{}{}", r.title, with_unit(r.until, "s", 6), r.label, peak, accuracy,
                     balance);
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
    rows.push_back({f.name, number(f.value), error_of(f.error), pretty_unit(f.unit),
                    f.at ? fmt::format("at {}", with_unit(*f.at, "s", 6)) : ""});
  return text + aligned(rows, 1) + footing(r);
}

std::string table_of(const Comparison& c) {
  std::string text =
      c.title + "\n" + c.conclusion + "\n\n" + heading(c.a) + footing(c.a) + heading(c.b) + footing(c.b) + "\n";
  std::vector<std::vector<std::string>> rows = {
      {"figure", c.a.label, "error", c.b.label, "error", "unit", c.b.label + "/" + c.a.label}};
  for (const ComparisonRow& row : c.rows)
    rows.push_back({row.name, row.a ? number(*row.a) : "—", error_of(row.a_error), row.b ? number(*row.b) : "—",
                    error_of(row.b_error), pretty_unit(row.unit), row.ratio ? number(*row.ratio, 5) : ""});
  for (const ComparisonRow& row : c.amplification)
    rows.push_back({row.name, "1", "", number(*row.b), error_of(row.b_error), "", ""});
  text += aligned(rows, 1);
  for (const std::string& note : c.notes) text += "note: " + note + "\n";
  return text;
}

std::string json_of(const Result& r) { return result_json(r).dump(2); }
std::string json_of(const Comparison& c) { return comparison_json(c).dump(2); }

StudyOutput output_of(const Result& r) {
  StudyOutput output{one_line(r), table_of(r), json_of(r), [&r] { return report_of(r); }, {}, r.complete, r.diagnosis};
  if (r.trajectory) output.csv.push_back({"trajectory.csv", [&r] { return csv_of(r); }});
  return output;
}

StudyOutput output_of(const Comparison& c) {
  StudyOutput output{c.conclusion, table_of(c), json_of(c), [&c] { return report_of(c); }};
  for (const Result* r : {&c.a, &c.b}) {
    if (r->trajectory) output.csv.push_back({"trajectory." + r->label + ".csv", [r] { return csv_of(*r); }});
    if (r->complete) continue;
    output.complete = false;
    if (output.diagnosis.empty()) output.diagnosis = r->diagnosis;
  }
  return output;
}

}  // namespace kurbel
