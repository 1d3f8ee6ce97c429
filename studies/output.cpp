// output.cpp — tables, JSON, CSV, reports.
#include "studies/output.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/units.h"
#include "studies/report/run_report.h"

namespace kurbel {
namespace {

using Json = nlohmann::ordered_json;

// Display width: UTF-8 continuation bytes take no column.
std::size_t width(const std::string& text) {
  std::size_t n = 0;
  for (const char c : text) n += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  return n;
}
std::string padded(const std::string& text, std::size_t columns) {
  return text + std::string(columns > width(text) ? columns - width(text) : 0, ' ');
}
std::string right(const std::string& text, std::size_t columns) {
  return std::string(columns > width(text) ? columns - width(text) : 0, ' ') + text;
}

std::string aligned(const std::vector<std::vector<std::string>>& rows, std::size_t text_columns) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width(row[k]));
  }
  std::string text;
  for (const auto& row : rows) {
    text += " ";
    for (std::size_t k = 0; k < row.size(); ++k)
      text += " " + (k < text_columns || k + 1 == row.size() ? padded(row[k], k + 1 == row.size() ? 0 : widths[k])
                                                             : right(row[k], widths[k]));
    while (text.ends_with(' ')) text.pop_back();
    text += "\n";
  }
  return text;
}

std::string number(double value, int digits = 7) { return fmt::format("{:.{}g}", value, digits); }
std::string error_of(const std::optional<double>& error) { return error ? "± " + number(*error, 2) : ""; }

std::string heading(const Result& r) {
  std::string text =
      fmt::format("{}: {} coordinate{}, {} — {}\n", r.label, r.coordinates, r.coordinates == 1 ? "" : "s",
                  r.effects == "none" ? "no effects on" : "effects: " + r.effects, r.statistics.method);
  text += fmt::format("  {}; {} steps, {:.3g} ms of processor time a run, {} run{}\n", r.statistics.reason,
                      r.statistics.stepper.steps, 1e3 * r.statistics.cpu_seconds, r.runs, r.runs == 1 ? "" : "s");
  if (!r.complete) text += fmt::format("  INCOMPLETE: {}\n", r.diagnosis);
  return text;
}

std::string footing(const Result& r) {
  std::string text;
  const EnergyBalance& e = r.energy;
  if (e.checks > 0) {
    text += "  work:";
    for (const auto& [line, work] : e.by_line) text += fmt::format(" {} {},", line, with_unit(work, "J", 5));
    text.back() = '\n';
    text += fmt::format(
        "  energy balance closed to {:.1e} of the energy turned over; bodies against reduced inertia {:.1e}\n",
        e.relative, e.reduction_residual);
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
  for (const Event& e : r.events) j["events"].push_back({{"t", e.t}, {"component", e.component}, {"what", e.what}});
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

// A result appears under its name only when it is whole.
void write_whole(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path temporary = path.string() + ".part";
  std::ofstream out(temporary, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(fmt::format("cannot write {}: is there room and permission?", temporary.string()));
  std::filesystem::rename(temporary, path);
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

void make_folder(const std::string& folder) {
  std::error_code status;
  std::filesystem::create_directories(folder, status);
  if (status) throw std::runtime_error(fmt::format("cannot make the folder {}: {}", folder, status.message()));
}

void write_report(const Report& report, const std::string& folder, bool plots) {
  write_html(report, (std::filesystem::path(folder) / "report.html").string());
  if (plots) write_gnuplot(report, (std::filesystem::path(folder) / "plots").string());
}

}  // namespace

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

void write_results(const Result& r, const std::string& folder, bool plots) {
  make_folder(folder);
  if (r.trajectory) write_whole(std::filesystem::path(folder) / "trajectory.csv", csv_of(r));
  write_whole(std::filesystem::path(folder) / "summary.json", json_of(r) + "\n");
  write_report(report_of(r), folder, plots);
}

void write_results(const Comparison& c, const std::string& folder, bool plots) {
  make_folder(folder);
  for (const Result* r : {&c.a, &c.b})
    if (r->trajectory) write_whole(std::filesystem::path(folder) / ("trajectory." + r->label + ".csv"), csv_of(*r));
  write_whole(std::filesystem::path(folder) / "summary.json", json_of(c) + "\n");
  write_report(report_of(c), folder, plots);
}

}  // namespace kurbel
