// book.cpp — what the benches found as table, JSON and page.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/benches.h"
#include "studies/accuracy/machine_info.h"
#include "studies/findings/figure_text.h"
#include "studies/report/render.h"

namespace kurbel::bench {
namespace {

using Json = nlohmann::ordered_json;
constexpr double goals[] = {1e-3, 1e-6, 1e-9};

std::string time_text(double seconds) {
  if (!std::isfinite(seconds)) return "—";
  return seconds < 1e-3 ? fmt::format("{:.3g} µs", 1e6 * seconds)
         : seconds < 1  ? fmt::format("{:.3g} ms", 1e3 * seconds)
                        : fmt::format("{:.3g} s", seconds);
}

std::vector<std::string> problems_of(const BenchBook& book) {
  std::vector<std::string> names;
  for (const BenchCurve& c : book.curves)
    if (std::find(names.begin(), names.end(), c.problem) == names.end()) names.push_back(c.problem);
  return names;
}

// Times to 1e-3, 1e-6, 1e-9, and the ratio to kurbel's best that steps over time.
Table goal_table(const BenchBook& book, const std::string& problem) {
  Table table{.title = fmt::format("{}: time to an error of", problem),
              .columns = {"solver", "1e-3", "ratio", "1e-6", "ratio", "1e-9", "ratio"},
              .rows = {}};
  const auto ours = [](const BenchCurve& c) { return !c.peer && c.solver.find("work") == std::string::npos; };
  for (const BenchCurve& c : book.curves) {
    if (c.problem != problem) continue;
    std::vector<std::string> row = {c.solver};
    for (const double goal : goals) {
      const double time = c.time_to(goal), best = book.best(problem, goal, ours);
      row.push_back(time_text(time));
      row.push_back(std::isfinite(time) && std::isfinite(best) ? fmt::format("{:.3g} ×", time / best) : "—");
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Plot goal_plot(const BenchBook& book, const std::string& problem) {
  Plot plot{.title = fmt::format("{}: processor time over error", problem),
            .x = {"error", "", true},
            .y = {"processor time", "ms", true},
            .series = {}};
  std::size_t colour = 0;
  for (const BenchCurve& c : book.curves) {
    if (c.problem != problem) continue;
    Series s{.name = c.solver, .role = further_role(colour++), .x = {}, .y = {}, .dashed = c.peer, .points = true};
    for (const BenchPoint& p : c.points) {
      if (!(p.error > 0) || !(p.seconds > 0)) continue;
      s.x.push_back(p.error);
      s.y.push_back(1e3 * p.seconds);
      s.labels.push_back(fmt::format("{} at {:.0e}, {} steps", c.solver, p.setting, p.steps));
    }
    if (!s.x.empty()) plot.series.push_back(std::move(s));
  }
  plot.note = "Dashed: peers. Errors against references of 12 digits (tests/cases/reference.toml).";
  return plot;
}

std::string text_of(const Table& table) {
  std::vector<std::vector<std::string>> rows = {table.columns};
  rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  return table.title + "\n" + aligned(rows, table.text_columns) + "\n";
}

Table target_table(const BenchBook& book) {
  Table table{.title = "Targets", .columns = {"what", "target", "measured", ""}, .rows = {}, .text_columns = 4};
  for (const BenchTarget& t : book.targets)
    table.rows.push_back({t.what, t.wanted, t.measured, t.met ? "met" : "missed"});
  return table;
}

}  // namespace

double BenchCurve::time_to(double error) const {
  double least = HUGE_VAL;
  for (const BenchPoint& p : points)
    if (p.error <= error) least = std::min(least, p.seconds);
  return least;
}

std::string BenchBook::text() const {
  std::string text = machine_info() + "\n\n";
  for (const std::string& problem : problems_of(*this)) text += text_of(goal_table(*this, problem)) + "\n";
  for (const Table& table : tables) text += text_of(table) + "\n";
  if (!targets.empty()) text += text_of(target_table(*this));
  return text;
}

std::string BenchBook::json() const {
  Json j = {{"machine", machine_info()}};
  j["curves"] = Json::array();
  for (const BenchCurve& c : curves) {
    Json curve = {{"problem", c.problem}, {"solver", c.solver}, {"peer", c.peer}, {"points", Json::array()}};
    for (const BenchPoint& p : c.points)
      curve["points"].push_back({{"setting", p.setting},
                                 {"error", p.error},
                                 {"seconds", p.seconds},
                                 {"fastest", p.fastest},
                                 {"slowest", p.slowest},
                                 {"steps", p.steps}});
    j["curves"].push_back(std::move(curve));
  }
  j["tables"] = Json::array();
  const auto add = [&](const Table& t) {
    j["tables"].push_back({{"title", t.title}, {"columns", t.columns}, {"rows", t.rows}});
  };
  for (const Table& t : tables) add(t);
  for (const ReportSection& section : sections)
    for (const Card& card : section.cards)
      if (const Table* t = std::get_if<Table>(&card)) add(*t);
  j["targets"] = Json::array();
  for (const BenchTarget& t : targets)
    j["targets"].push_back({{"what", t.what}, {"target", t.wanted}, {"measured", t.measured}, {"met", t.met}});
  return j.dump(2) + "\n";
}

Report BenchBook::report() const {
  const auto met = std::count_if(targets.begin(), targets.end(), [](const BenchTarget& t) { return t.met; });
  Report report{
      .title = "kurbel_bench",
      .subtitle =
          "What accuracy, effects and size cost, whether the hard cases end right and stated errors cover true ones",
      .conclusion = conclusions};
  if (!targets.empty()) report.conclusion.push_back(fmt::format("{} of {} targets met.", met, targets.size()));
  if (!targets.empty()) report.add("Targets").cards.push_back(target_table(*this));
  for (const std::string& problem : problems_of(*this)) {
    ReportSection& section = report.add(problem);
    section.cards.push_back(goal_plot(*this, problem));
    section.cards.push_back(goal_table(*this, problem));
  }
  if (!plots.empty() || !tables.empty()) {
    ReportSection& rest = report.add("Measured");
    for (const Plot& plot : plots) rest.cards.push_back(plot);
    for (const Table& table : tables) rest.cards.push_back(table);
  }
  for (const ReportSection& section : sections) report.sections.push_back(section);
  report.footer = machine_info() + " · " + report_footer();
  return report;
}

void BenchBook::write(const std::string& folder) const {
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/bench.json") << json();
  const Report page = report();
  write_html(page, folder + "/report.html");
  write_gnuplot(page, folder + "/plots");
}

}  // namespace kurbel::bench
