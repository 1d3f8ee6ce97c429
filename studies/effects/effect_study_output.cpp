// effect_study_output.cpp — effects ranked: what changes without each, what each adds, what each costs.
#include "studies/effects/effect_study_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/scene/units.h"
#include "studies/findings/json_text.h"
#include "studies/findings/text_table.h"

namespace kurbel {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

constexpr std::size_t most_figures = 8;  // columns of the matrix of changes
constexpr double least_shown = 1e-6;     // percent; smaller changes lie on the axis

std::string percent(const FigureChange& change) {
  return change.from_nothing && change.relative > 1 ? std::string("from zero")
                                                    : fmt::format("{:.3g} %", 100 * change.relative);
}

Rows ranking(const EffectStudy& s) {
  Rows rows = {{"left out", "greatest change", "in", "states", "nonzeros", "guards", "events", "time ×", ""}};
  for (const LeftOut& l : s.left_out) {
    if (!l.refused.empty()) {
      rows.push_back({l.effect.words, "—", "—", "", "", "", "", "", "does not run: " + l.refused});
      continue;
    }
    const bool any = !l.changes.empty();
    rows.push_back({l.effect.words, any ? percent(l.changes.front()) : "—", any ? l.changes.front().figure : "—",
                    fmt::format("{}", l.saved.states), fmt::format("{}", l.saved.nonzeros),
                    fmt::format("{}", l.saved.guards), fmt::format("{:+d}", l.events_added),
                    fmt::format("{:.2f}", l.time_ratio), ""});
  }
  return rows;
}

// The figures that any effect changes most.
std::vector<std::string> figures_shown(const EffectStudy& s) {
  std::vector<std::pair<double, std::string>> most;
  for (const Figure& f : s.full.figures) {
    double change = -1;
    for (const LeftOut& l : s.left_out)
      for (const FigureChange& c : l.changes)
        if (c.figure == f.name) change = std::max(change, c.relative);
    if (change >= 0) most.emplace_back(change, f.name);
  }
  std::stable_sort(most.begin(), most.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> names;
  for (std::size_t k = 0; k < most.size() && k < most_figures; ++k) names.push_back(most[k].second);
  return names;
}

Rows matrix(const EffectStudy& s) {
  const std::vector<std::string> figures = figures_shown(s);
  Rows rows(1);
  rows[0].push_back("change when left out");
  for (const std::string& name : figures) rows[0].push_back(name);
  for (const LeftOut& l : s.left_out) {
    if (!l.refused.empty()) continue;
    std::vector<std::string> row = {l.effect.words};
    for (const std::string& name : figures) {
      const auto found =
          std::find_if(l.changes.begin(), l.changes.end(), [&](const FigureChange& c) { return c.figure == name; });
      row.push_back(found == l.changes.end() ? "—" : percent(*found));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string table_of(const EffectStudy& s) {
  std::string text = s.title + "\n" + s.conclusion + "\n\n";
  text +=
      fmt::format("full model: {}; {} states, {} nonzeros, {} guards, {} events, {:.3g} ms of processor time a run\n",
                  s.full.effects, s.size.states, s.size.nonzeros, s.size.guards, s.full.statistics.events,
                  1e3 * s.full.statistics.cpu_seconds);
  text += aligned(ranking(s), 1);
  const std::vector<std::string> figures = figures_shown(s);
  if (!figures.empty()) text += "\n" + aligned(matrix(s), 1);
  return text;
}

std::string json_of(const EffectStudy& s) {
  Json j;
  j["title"] = s.title;
  j["conclusion"] = s.conclusion;
  j["complete"] = s.full.complete;
  j["full"] = {{"effects", s.full.effects},          {"states", s.size.states},
               {"nonzeros", s.size.nonzeros},        {"guards", s.size.guards},
               {"events", s.full.statistics.events}, {"cpu_seconds", s.full.statistics.cpu_seconds}};
  Json effects = Json::array();
  for (const LeftOut& l : s.left_out) {
    Json e = {{"effect", l.effect.name}};
    if (!l.refused.empty()) {
      e["refused"] = l.refused;
    } else {
      e["states"] = l.saved.states;
      e["nonzeros"] = l.saved.nonzeros;
      e["guards"] = l.saved.guards;
      e["events_added"] = l.events_added;
      e["time_ratio"] = l.time_ratio;
      Json changes = Json::array();
      for (const FigureChange& c : l.changes)
        changes.push_back({{"figure", c.figure},
                           {"unit", c.unit},
                           {"full", c.full},
                           {"without", c.without},
                           {"relative", c.relative}});
      e["changes"] = changes;
    }
    effects.push_back(e);
  }
  j["effects"] = effects;
  return json_text(j) + "\n";
}

// Change against cost: what lies on the left above costs little and matters.
Plot plane(const EffectStudy& s) {
  Plot plot{.title = "What each effect changes, and what it costs (theory 14.1)",
            .x = {"time with the effect over time without", "×"},
            .y = {"greatest change of a figure without it", "%", true},
            .series = {}};
  std::size_t k = 0;
  for (const LeftOut& l : s.left_out) {
    if (!l.refused.empty() || l.changes.empty()) continue;
    plot.series.push_back({.name = l.effect.words + " (" + l.changes.front().figure + ")",
                           .role = further_role(k++),
                           .x = {l.time_ratio},
                           .y = {std::max(100 * l.changes.front().relative, least_shown)},
                           .points = true,
                           .line = false});
  }
  plot.note = fmt::format("Changes below {:g} % are drawn there.", least_shown);
  return plot;
}

Report report_of(const EffectStudy& s) {
  Report report{.title = s.title,
                .subtitle = "What each effect changes and costs",
                .conclusion = s.conclusion,
                .complete = s.full.complete};
  for (const LeftOut& l : s.left_out)
    if (l.refused.empty() && !l.changes.empty() && report.figures.size() < 4)
      report.figures.push_back({"without " + l.effect.words,
                                100 * l.changes.front().relative,
                                "",
                                {},
                                "% off in " + l.changes.front().figure,
                                3});
  ReportSection& main = report.add("Effects, ranked");
  main.cards.push_back(plane(s));
  Rows rows = ranking(s);
  Table ranked{.title = "Each effect left out of the full model", .columns = rows.front(), .rows = {}};
  ranked.rows.assign(rows.begin() + 1, rows.end());
  main.cards.push_back(std::move(ranked));
  rows = matrix(s);
  Table changes{.title = "Change of each figure", .columns = rows.front(), .rows = {}};
  changes.rows.assign(rows.begin() + 1, rows.end());
  if (changes.columns.size() > 1) main.cards.push_back(std::move(changes));
  report.add("The full model").cards.push_back(Text{.title = "", .body = s.full.explanation, .verbatim = true});
  report.add("Scene").cards.push_back(
      Text{.title = s.scene_file, .body = s.scene_text, .verbatim = true, .folded = true});
  return report;
}

}  // namespace

StudyOutput output_of(const EffectStudy& study) {
  StudyOutput output;
  output.conclusion = study.conclusion;
  output.table = table_of(study);
  output.json = json_of(study);
  output.report = [&study] { return report_of(study); };
  output.complete = study.full.complete;
  output.diagnosis = study.full.diagnosis;
  return output;
}

}  // namespace kurbel
