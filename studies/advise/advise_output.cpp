// advise_output.cpp — error bought and time saved on one plane, the screens and the runs behind the advice.
#include "studies/advise/advise_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "studies/findings/json_text.h"
#include "studies/findings/text_table.h"

namespace kurbel {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

constexpr double least_shown = 1e-6;  // percent

std::string percent(double relative) {
  return std::isfinite(relative) ? fmt::format("{:.3g} %", 100 * relative) : "lost";
}

Rows effect_rows(const Advice& a) {
  Rows rows = {{"effect", "advice", "screens"}};
  if (a.kept_because.empty()) return rows;
  for (std::size_t k = 0; k < a.units.size(); ++k) {
    std::string screens;
    for (const Screen& s : a.screens[k]) screens += (screens.empty() ? "" : "; ") + s.verdict;
    rows.push_back({a.units[k].words, a.kept_because[k], screens.empty() ? "none applies" : screens});
  }
  return rows;
}

Rows tried_rows(const Advice& a) {
  Rows rows = {{"effects on", "deviation", "in", "time [ms]", "states", "within"}};
  std::vector<const TriedSet*> order;
  for (const TriedSet& t : a.tried) order.push_back(&t);
  std::stable_sort(order.begin(), order.end(),
                   [](const TriedSet* x, const TriedSet* y) { return x->deviation < y->deviation; });
  for (const TriedSet* t : order)
    rows.push_back({t->words, t->refused.empty() ? percent(t->deviation) : "—", t->figure.empty() ? "—" : t->figure,
                    fmt::format("{:.3g}", 1e3 * t->cpu_seconds), fmt::format("{}", t->size.states),
                    !t->refused.empty()       ? "does not run"
                    : t == &a.tried[a.chosen] ? "yes, chosen"
                    : t->within               ? "yes"
                                              : "no"});
  return rows;
}

Rows held_out_rows(const Advice& a) {
  Rows rows = {{"held out", "deviation", "in", "within"}};
  for (const HeldOut& h : a.held_out)
    rows.push_back({h.what, h.refused.empty() ? percent(h.deviation) : "—", h.figure.empty() ? "—" : h.figure,
                    h.within            ? "yes"
                    : h.refused.empty() ? "no"
                                        : h.refused});
  return rows;
}

std::string table_of(const Advice& a) {
  std::string text =
      a.title + "\n" + a.conclusion + "\n\n" + aligned(effect_rows(a), 2) + "\n" + aligned(tried_rows(a), 1);
  if (!a.held_out.empty()) text += "\n" + aligned(held_out_rows(a), 1);
  for (const std::string& warning : a.warnings) text += "warning: " + warning + "\n";
  return text;
}

std::string json_of(const Advice& a) {
  Json j;
  j["title"] = a.title;
  j["conclusion"] = a.conclusion;
  j["within"] = a.tolerance;
  j["complete"] = a.complete;
  Json effects = Json::array();
  for (std::size_t k = 0; k < a.units.size() && k < a.kept_because.size(); ++k) {
    Json screens = Json::array();
    for (const Screen& s : a.screens[k])
      screens.push_back({{"name", s.name}, {"number", s.number}, {"verdict", s.verdict}, {"needed", s.needed}});
    effects.push_back({{"effect", a.units[k].name},
                       {"on", static_cast<bool>(a.tried[a.chosen].on[k])},
                       {"why", a.kept_because[k]},
                       {"screens", screens}});
  }
  j["effects"] = effects;
  Json tried = Json::array();
  for (std::size_t i = 0; i < a.tried.size(); ++i) {
    const TriedSet& t = a.tried[i];
    Json set = {{"effects", t.words}, {"cpu_seconds", t.cpu_seconds}, {"states", t.size.states}, {"within", t.within}};
    if (t.refused.empty()) {
      if (std::isfinite(t.deviation)) set["deviation"] = t.deviation;
      set["figure"] = t.figure;
    } else {
      set["refused"] = t.refused;
    }
    set["chosen"] = i == a.chosen;
    tried.push_back(set);
  }
  j["tried"] = tried;
  Json held = Json::array();
  for (const HeldOut& h : a.held_out)
    held.push_back({{"what", h.what}, {"deviation", h.deviation}, {"figure", h.figure}, {"within", h.within}});
  j["held_out"] = held;
  j["warnings"] = a.warnings;
  return json_text(j) + "\n";
}

Plot plane(const Advice& a) {
  Plot plot{.title = "Error bought against time saved: every set that was run",
            .x = {"processor time of a run", "ms", true},
            .y = {"greatest deviation from the full model", "%", true},
            .series = {}};
  const auto add = [&](const std::string& name, Role role, auto belongs) {
    Series series{.name = name, .role = role, .x = {}, .y = {}, .points = true, .line = false};
    for (std::size_t i = 0; i < a.tried.size(); ++i) {
      const TriedSet& t = a.tried[i];
      if (!t.refused.empty() || !std::isfinite(t.deviation) || !belongs(i, t)) continue;
      series.x.push_back(1e3 * t.cpu_seconds);
      series.y.push_back(std::max(100 * t.deviation, least_shown));
    }
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  };
  add("full model", Role::reference, [&](std::size_t i, const TriedSet&) { return i == 0; });
  add("chosen: " + a.tried[a.chosen].words, Role::green,
      [&](std::size_t i, const TriedSet&) { return i == a.chosen && i > 0; });
  add("within the tolerance", Role::elastic,
      [&](std::size_t i, const TriedSet& t) { return i > 0 && i != a.chosen && t.within; });
  add("outside", Role::vermillion, [&](std::size_t i, const TriedSet& t) { return i > 0 && !t.within; });
  double low = HUGE_VAL, high = 0;
  for (const Series& s : plot.series)
    for (const double x : s.x) low = std::min(low, x), high = std::max(high, x);
  plot.series.push_back({.name = fmt::format("tolerance {:.3g} %", 100 * a.tolerance),
                         .role = Role::rigid,
                         .x = {low, high},
                         .y = {100 * a.tolerance, 100 * a.tolerance},
                         .dashed = true});
  plot.note = fmt::format("Deviations below {:g} % are drawn there.", least_shown);
  return plot;
}

Table as_table(const std::string& title, Rows rows, std::size_t text_columns = 1, bool folded = false) {
  Table table{.title = title, .columns = rows.front(), .rows = {}, .folded = folded, .text_columns = text_columns};
  table.rows.assign(rows.begin() + 1, rows.end());
  return table;
}

Report report_of(const Advice& a) {
  Report report{.title = a.title,
                .subtitle = fmt::format("Which effects are needed for {:.3g} %", 100 * a.tolerance),
                .conclusion = a.conclusion,
                .complete = a.complete};
  const TriedSet &full = a.tried.front(), &chosen = a.tried[a.chosen];
  report.figures = {{"deviation", 100 * chosen.deviation, "", {}, "% at most, measured", 3},
                    {"time of the full model", 1e3 * full.cpu_seconds, "", {}, "ms a run", 3},
                    {"time of the lean model", 1e3 * chosen.cpu_seconds, "", {}, "ms a run", 3},
                    {"sets run", static_cast<double>(a.tried.size()), "", {}, "", 3}};
  ReportSection& main = report.add("Advice");
  main.cards.push_back(plane(a));
  main.cards.push_back(as_table("Each effect", effect_rows(a), 3));
  if (!a.held_out.empty())
    main.cards.push_back(as_table("Figures and operating points that took no part in the choice", held_out_rows(a)));
  std::string warnings;
  for (const std::string& warning : a.warnings) warnings += warning + "\n";
  if (!warnings.empty()) main.cards.push_back(Text{.title = "Warnings", .body = warnings});
  report.add("Runs").cards.push_back(as_table("Every set that was run", tried_rows(a)));
  report.add("Lean scene")
      .cards.push_back(
          Text{.title = "The scene with these effects", .body = a.lean_scene, .verbatim = true, .folded = true});
  return report;
}

}  // namespace

StudyOutput output_of(const Advice& advice) {
  StudyOutput output;
  output.conclusion = advice.conclusion;
  output.table = table_of(advice);
  output.json = json_of(advice);
  output.report = [&advice] { return report_of(advice); };
  output.complete = advice.complete;
  output.diagnosis = advice.full.diagnosis;
  return output;
}

}  // namespace kurbel
