// effect_study_findings.cpp — effects ranked: what changes without each, what each adds, what each costs.
#include "engine/base/find_by.h"
#include "studies/effects/effect_study.h"

#include <fmt/format.h>

#include <algorithm>

namespace kurbel {
namespace {

constexpr std::size_t most_figures = 8;  // columns of the matrix of changes
constexpr double least_shown = 1e-6;     // percent; smaller changes lie on the axis
constexpr int digits_of_percent = 3;

FigureText in_percent(const FigureChange& change) {
  return figure_text({100 * change.relative, 100 * change.error}, digits_of_percent);
}

std::string percent(const FigureChange& change) {
  if (100 * std::abs(change.relative) < least_shown) return "0";
  return change.from_nothing && change.relative > 1 ? std::string("from zero") : in_percent(change).value + " %";
}

// The error separately: the uncertainty of the change from the runs.
std::string error_of(const FigureChange& change) {
  return change.from_nothing && change.relative > 1 ? std::string("—") : in_percent(change).error + " %";
}

std::string words_of(const OmittedEffect& l) {
  return l.in_place_of.empty() ? l.effect.words : fmt::format("{} (in place of {})", l.effect.words, l.in_place_of);
}

Rows ranking(const EffectStudy& s) {
  Lines lines;
  for (const OmittedEffect& l : s.omitted) {
    if (!l.failed.empty()) {
      lines.push_back({words_of(l), "—", "—", "—", "", "", "", "", "", "does not run: " + l.failed});
      continue;
    }
    const bool any = !l.changes.empty();
    lines.push_back({words_of(l), any ? percent(l.changes.front()) : "—", any ? error_of(l.changes.front()) : "—",
                     any ? l.changes.front().figure : "—", fmt::format("{}", l.saved.states),
                     fmt::format("{}", l.saved.nonzeros), fmt::format("{}", l.saved.guards),
                     fmt::format("{:+d}", l.events_added), fmt::format("{:.2f}", l.time_ratio), ""});
  }
  Rows table = words_table(
      "The full model without one effect at a time",
      {"omitted", "greatest change", "numerical error", "in", "states", "nonzeros", "guards", "events", "time ×", ""},
      lines);
  table.apart = false;
  return table;
}

// The figures that any effect changes most.
std::vector<std::string> figures_shown(const EffectStudy& s) {
  std::vector<std::pair<double, std::string>> most;
  for (const Figure& f : s.full.figures) {
    double change = -1;
    for (const OmittedEffect& l : s.omitted)
      for (const FigureChange& c : l.changes)
        if (c.figure == f.name) change = std::max(change, c.sure());
    if (change >= 0) most.emplace_back(change, f.name);
  }
  std::stable_sort(most.begin(), most.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> names;
  for (std::size_t k = 0; k < most.size() && k < most_figures; ++k) names.push_back(most[k].second);
  return names;
}

Rows matrix(const EffectStudy& s) {
  std::vector<OmittedEffect> ran = s.omitted;
  std::erase_if(ran, [](const OmittedEffect& l) { return !l.failed.empty(); });
  const std::vector<std::string> figures = figures_shown(s);
  auto table = table_of("", "Change of each figure", ran);
  table.even_if_empty = !figures.empty();
  table.people_see_it_if(!figures.empty()).only_for_people("change when omitted", words_of);
  for (const std::string& name : figures)
    table.only_for_people(name, [&](const OmittedEffect& l) {
      const auto* const found = find_by(l.changes, &FigureChange::figure, name);
      return found ? percent(*found) : "—";
    });
  return table;
}

Record omitted_record(const OmittedEffect& l) {
  Record record = {{"effect", l.effect.name}};
  if (!l.in_place_of.empty()) record.push_back({"in_place_of", l.in_place_of});
  if (!l.failed.empty()) {
    record.push_back({"refused", l.failed});
    return record;
  }
  const Record reported = {{"states", l.saved.states},
                           {"nonzeros", l.saved.nonzeros},
                           {"guards", l.saved.guards},
                           {"events_added", l.events_added},
                           {"time_ratio", l.time_ratio},
                           {"changes", each(l.changes, [](const FigureChange& c) {
                              return Record{{"figure", c.figure},   {"unit", c.unit},         {"full", c.full},
                                            {"without", c.without}, {"relative", c.relative}, {"error", c.error}};
                            })}};
  record.insert(record.end(), reported.begin(), reported.end());
  return record;
}

// Change against cost: at the upper left are effects with low cost and large influence.
Plot plane(const EffectStudy& s) {
  Plot plot{.title = "What each effect changes, and what it costs (theory 14.1)",
            .x = {"time with the effect over time without", "×"},
            .y = {"greatest change of a figure without it", "%", true}};
  std::size_t k = 0;
  for (const OmittedEffect& l : s.omitted) {
    if (!l.failed.empty() || l.changes.empty()) continue;
    plot.series.push_back({.name = words_of(l) + " (" + l.changes.front().figure + ")",
                           .role = further_role(k++),
                           .x = {l.time_ratio},
                           .y = {std::max(100 * l.changes.front().relative, least_shown)},
                           .points = true,
                           .line = false});
  }
  for (const Series& drawn : plot.series)
    if (drawn.y.front() <= least_shown) plot.note = "Smaller changes are drawn at 10⁻⁶ %.";
  return plot;
}

std::string full_model(const EffectStudy& s) {
  return fmt::format("full model: {}; {} states, {} nonzeros, {} guards, {} event{}, {} of processor time a run",
                     s.full.effects, s.size.states, s.size.nonzeros, s.size.guards, s.full.statistics.events,
                     s.full.statistics.events == 1 ? "" : "s", duration_text(s.full.statistics.cpu_seconds));
}

}  // namespace

Findings findings_of(const EffectStudy& s) {
  Findings f{.title = s.title,
             .subtitle = "What each effect changes and costs",
             .complete = s.complete,
             .diagnosis = s.diagnosis,
             .opening = Findings::Opening::title_and_conclusion,
             .reports_diagnosis = false};
  f.conclude(s.complete, s.conclusion);
  for (const OmittedEffect& l : s.omitted)
    if (l.failed.empty() && !l.changes.empty() && f.figures.size() < 4) {
      const FigureChange& most = l.changes.front();
      f.figures.push_back({Estimate{100 * most.relative, 100 * most.error}, "without " + words_of(l), "%",
                           (most.from_nothing ? "of the rated value, from zero: " : "change of ") + most.figure, 3,
                           "change_without"});
    }
  const Chapter ranked = f.chapter("Effects, ranked"), full = f.chapter("The full model");
  f.say(ranked, Sentences{.lines = {full_model(s)}, .page = false, .apart = true});
  f.draw(ranked, [&s] { return plane(s); });
  f.say(ranked, ranking(s));
  f.say(ranked, matrix(s));
  f.record("full", Record{{"effects", s.full.effects},
                          {"states", s.size.states},
                          {"nonzeros", s.size.nonzeros},
                          {"guards", s.size.guards},
                          {"events", s.full.statistics.events},
                          {"cpu_seconds", s.full.statistics.cpu_seconds}});
  f.record("effects", each(s.omitted, omitted_record));
  f.say(full, Sentences{.lines = s.notes, .title = "Notes", .indent = "note: ", .key = "notes"});
  f.show(full, Text{.title = "", .body = s.full.explanation, .verbatim = true});
  f.show_scene(s.scene_file, s.scene_text);
  return f;
}

}  // namespace kurbel
