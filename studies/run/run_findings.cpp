// run_findings.cpp — figures of one run; figures of two models side by side.
#include "studies/run/run_findings.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/scene/units.h"
#include "studies/answers/key_figures.h"
#include "studies/answers/measured_names.h"
#include "studies/answers/run_claims.h"
#include "studies/claims/headline.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/plots.h"
#include "studies/limits/limits_findings.h"
#include "studies/limits/ratings.h"

namespace kurbel {
namespace {

KeyFigure key_of(const Figure& f, const std::string& note, const SpeedUnit& speed) {
  if (f.unit != "rad/s") return {f, in_words(f), f.unit, note, 0, f.name};
  return {f / speed.size, in_words(f), speed.name, note, 0, f.name};
}

// --- one run ---

Rows rows_of_figures(const Result& r, std::vector<Figure> figures, bool on_terminal) {
  using F = const Figure&;
  std::erase_if(figures, [&](F f) { return !is_reported(f, r); });
  const SpeedUnit speed = speed_unit_of(r);
  const auto cells = [&](F f, int digits) { return figure_cells(without_rounding(f, f.scale), f.unit, speed, digits); };
  auto table = table_of("", fmt::format("All figures, {} model, with their measured errors (theory 15.1)", r.label),
                        std::move(figures))
                   .always()
                   .close()
                   .explained_by(&Figure::name)
                   .only_for_people("figure", &Figure::name)
                   .value_and_error("value", cells)
                   .only_for_people("unit", [&](F f) { return cells(f, digits_in_tables).unit; });
  // The page's heading contains the unit of time.
  if (on_terminal) return table.not_on_page().only_for_people("at", at_time);
  return table.not_on_terminal().only_for_people("at [s]", [](F f) {
    return has_known_time(f) ? with_error({*f.at, f.at_error}, "") : std::string();
  });
}

Rows figures_table(const Result& r, bool on_terminal) { return rows_of_figures(r, r.figures, on_terminal); }

// --- two models ---

// A row's figure of one model, as people read it.
FigureCells cells_of(const std::optional<Estimate>& figure, const std::string& unit, const SpeedUnit& speed,
                     int digits = digits_in_tables) {
  if (figure) return figure_cells(*figure, unit, speed, digits);
  return {"—", "", unit == "rad/s" ? speed.name : pretty_unit(unit)};
}

Rows comparison_table(const Comparison& c, const std::vector<ComparisonRow>& rows) {
  using R = const ComparisonRow&;
  const SpeedUnit speed = speed_unit_of(c.b);
  auto table = table_of("comparison", "Every figure of both models", rows).always().not_on_terminal();
  table.explained_by(&ComparisonRow::name);
  table.column("name", "figure", &ComparisonRow::name);
  table.only_for_programs(c.a.label, &ComparisonRow::a).only_for_programs(c.b.label, &ComparisonRow::b);
  table.value_and_error(c.a.label, [&](R row, int digits) { return cells_of(row.a, row.unit, speed, digits); })
      .value_and_error(c.b.label, [&](R row, int digits) { return cells_of(row.b, row.unit, speed, digits); })
      .column("unit", "unit", &ComparisonRow::unit,
              [&](const std::string& unit) { return cells_of({}, unit, speed).unit; })
      .only_for_programs("difference", &ComparisonRow::difference);
  return table.column("ratio", c.b.label + "/" + c.a.label, &ComparisonRow::ratio,
                      ReadAs{.digits = 4, .otherwise = ""});
}

// The same figure of both models differs by more than its errors and a thousandth.
bool differs(const ComparisonRow& row) {
  constexpr double least = 1e-3;
  if (!row.a || !row.b) return false;
  const double open = row.a->error.value_or(0) + row.b->error.value_or(0);
  return std::abs(row.difference) > open + least * std::max(std::abs(row.a->value), std::abs(row.b->value));
}

// Those of the leading figures that differ, as many as fit a screen; without angles, which depend on the length of
// the run.
std::vector<ComparisonRow> rows_that_differ(const Comparison& c) {
  std::vector<ComparisonRow> rows;
  for (std::size_t among = Brief::most_figures; rows.size() < Brief::most_figures; ++among) {
    const std::vector<std::size_t> chosen = chosen_figures(c.b, among);
    rows.clear();
    for (const std::size_t i : chosen)
      for (const ComparisonRow& row : c.rows)
        if (row.name == c.b.figures[i].name && row.unit != "rad" && differs(row)) rows.push_back(row);
    if (chosen.size() < among) break;
  }
  return rows;
}

// An elastic model has the torque lag of its motors without mention; beside a rigid one that has it, it is mentioned.
std::string effects_in_words(const Comparison& c, const Result& r) {
  const Effects& effects = r.model->effects;
  const bool mentioned = effects.torque_lag && effects.lags_rigid;
  return c.lag_in_both && !mentioned ? r.effects + ", with torque lag" : r.effects;
}
std::string models_in_words(const Comparison& c) {
  return fmt::format("{} ({}) against {} ({})", c.a.label, effects_in_words(c, c.a), c.b.label,
                     effects_in_words(c, c.b));
}

Brief brief_of(const Comparison& c) {
  const std::vector<ComparisonRow> rows = rows_that_differ(c);
  Brief brief{.about = c.title + ": " + models_in_words(c), .figures = comparison_table(c, rows), .notes = c.notes};
  for (const Result* r : {&c.a, &c.b})
    brief.words.push_back(r->errors_measured
                              ? fmt::format("{}: accuracy {:.1e} requested, {:.1e} measured; {}", r->label, r->accuracy,
                                            r->measured_accuracy, reported(r->energy))
                              : r->label + ": errors were not measured");
  brief.more = fmt::format("{} more figures of both models, works, periods, cost, notes: --all, or the report",
                           c.rows.size() - rows.size());
  return brief;
}

// On the terminal the amplification of torques is below the figures.
Rows with_amplification(const Comparison& c, const Rows& figures) {
  Lines lines = figures.texts(true);
  for (const ComparisonRow& row : c.amplification) {
    const FigureCells factor = cells_of(row.b, "", {});
    lines.push_back({row.name, "1", "", factor.value, factor.error, "", ""});
  }
  Rows table = words_table("", figures.headings(), lines);
  table.page = false;
  return table;
}

void show_amplification(Findings& f, Chapter in, const Comparison& c) {
  for (const ComparisonRow& row : c.amplification) {
    const std::string& joint = row.of;
    const Figure *a = c.a.find(quantities::peak_torque, joint), *b = c.b.find(quantities::peak_torque, joint);
    if (!a || !b || !row.b || largest_after_start(c.b, *b)) continue;
    f.show(in, Formulas()
                   .add(fmt::format("Torque amplification in {} (theory 14.2)", joint),
                        fmt::format("K = |τ_{}| / |τ_{}|", c.b.label, c.a.label), "K = |{}| / |{}| = {}",
                        figure_text(*b).value, figure_text(*a).value, with_error(*row.b, ""))
                   .note("Largest transmitted torques, each at its own time."));
  }
}

// In the form of a single run.
Record model_record(const Result& r) {
  Record record = {{"title", r.title}, {"scene", r.scene_file}, {"complete", r.complete}};
  if (r.begins_at > 0) record.push_back({"goes_on_from", r.begins_at});
  if (!r.complete) record.push_back({"diagnosis", r.diagnosis});
  for (Field& field : result_record(r)) record.push_back(std::move(field));
  return record;
}

void judge_completion(Findings& f, const Comparison& c) {
  for (const Result* r : {&c.a, &c.b}) {
    if (r->trajectory) f.tables.push_back({"trajectory." + r->label, [r] { return trajectory_data(*r); }});
    if (r->unconfirmed()) f.unconfirmed = fmt::format("{} model: {}", r->label, r->unconfirmed_in_words());
    if (r->complete) continue;
    f.complete = false;
    if (f.diagnosis.empty()) f.diagnosis = r->diagnosis;
  }
}

// Nothing is shown if there are no ratings.
void show_ratings(Findings& f, Chapter in, const Result& r) {
  const std::vector<Verdict> verdicts = judge_ratings(r);
  if (verdicts.empty()) return;
  Rows table = verdict_table(verdicts);
  table.key = "ratings", table.heading = "ratings";
  f.say(in, std::move(table));
  f.claim(limit_claims(verdicts, "rating"));
}

// Short form for one terminal screen.
Brief brief_of(const Result& r) {
  const std::vector<std::size_t> chosen = chosen_figures(r, Brief::most_figures);
  std::vector<Figure> figures;
  for (const std::size_t i : chosen) figures.push_back(r.figures[i]);
  const auto all = static_cast<std::size_t>(
      std::count_if(r.figures.begin(), r.figures.end(), [&](const Figure& f) { return is_reported(f, r); }));
  Brief brief{.about = fmt::format("{} ({}, {})", r.title, r.label,
                                   r.effects == "none" ? "no effects on" : "effects: " + r.effects),
              .figures = rows_of_figures(r, std::move(figures), true),
              .notes = r.notes};
  // Omits notes already in the conclusion.
  std::erase_if(brief.notes, [&](const std::string& note) {
    return std::any_of(r.claims.begin(), r.claims.end(),
                       [&](const Claim& c) { return c.in_conclusion && c.text == note; });
  });
  std::string sure = r.errors_measured
                         ? fmt::format("accuracy {:.1e} requested, {:.1e} measured", r.accuracy, r.measured_accuracy)
                         : std::string("errors were not measured");
  if (has_works(r)) sure += "; " + reported(r.energy);
  brief.words = {std::move(sure)};
  if (all > chosen.size())
    brief.more = fmt::format("{} more figure{}, works, periods, cost: --all, or the report", all - chosen.size(),
                             all - chosen.size() == 1 ? "" : "s");
  return brief;
}

}  // namespace

std::vector<KeyFigure> key_figures_of(const Result& r) {
  constexpr std::size_t most = 5;
  std::vector<KeyFigure> figures;
  for (const std::size_t i : chosen_figures(r, most)) {
    const Figure& f = r.figures[i];
    figures.push_back(
        key_of(f, f.what == quantities::peak_torque ? at_time(f) + words_of_start(r, f) : "", speed_unit_of(r)));
  }
  figures.push_back(key_figure("coordinates", {static_cast<double>(r.coordinates)}, "coordinates",
                               duration_text(r.statistics.cpu_seconds) + " of processor time a run"));
  return figures;
}

std::vector<KeyFigure> key_figures_of(const Comparison& c) {
  std::vector<KeyFigure> figures;
  const auto add = [&](const Figure* figure) {
    if (!figure) return;
    const Figure* other = c.a.find(figure->name);
    const SpeedUnit speed = speed_unit_of(c.b);
    std::string note;
    if (other) {
      // In the unit of the tile.
      const ReadableUnit unit =
          figure->unit == "rad/s" ? ReadableUnit{speed.name, speed.of(1)} : unit_on_tile(figure->value, figure->unit);
      note = fmt::format("{}: {}{}{}", c.a.label, headline_number(unit.factor * other->value),
                         unit.unit.empty() ? "" : " " + pretty_unit(unit.unit),
                         other->value != 0 ? fmt::format(" · ratio {:.3f}", figure->value / other->value) : "");
    }
    figures.push_back(key_of(*figure, note, speed));
  };
  for (const std::string& joint : drawable({&c.a, &c.b}) ? couplings(c.b) : std::vector<std::string>{})
    if (const Figure* peak = c.b.find("peak_torque." + joint);
        figures.size() < 3 && peak && !largest_after_start(c.b, *peak))
      add(peak);
  add(first_of(c.b, quantities::delta));
  add(first_of(c.b, quantities::cycle_fluctuation));
  add(first_of(c.b, quantities::mid_speed));
  const bool short_run = c.b.statistics.cpu_seconds < 1;
  const Estimate time{(short_run ? 1e3 : 1) * c.b.statistics.cpu_seconds};
  figures.push_back({time, "processor time of a run", short_run ? "ms" : "s",
                     fmt::format("{}: {}", c.a.label, duration_text(c.a.statistics.cpu_seconds)), 3, "processor_time"});
  return figures;
}

Findings findings_of(const Result& r, const Result* rigid) {
  Findings f{
      .title = r.title,
      .subtitle = fmt::format("{} model, {}", r.label, r.effects == "none" ? "no effects on" : "effects: " + r.effects),
      .scene_file = r.scene_file,
      .speed_unit = speed_unit_of(r).name,
      .complete = r.complete,
      .diagnosis = r.diagnosis,
      .unconfirmed = r.unconfirmed_in_words(),
      .opening = Findings::Opening::title_and_conclusion,
      .footer = report_footer()};
  f.claims = run_claims(r);
  f.conclude(true, capitalised(figures_in_words(r)));
  f.brief = brief_of(r);
  f.figures = key_figures_of(r);
  show_motion(f, rigid && drawable({rigid}) ? Results{rigid, &r} : Results{&r});
  f.chapter(chapter_of_measurement);
  const Chapter figures = f.chapter("Figures");
  f.chapter(chapter_of_rigid);
  f.chapter(chapter_of_trials);
  const Chapter notes = f.chapter("Notes");
  f.say(figures, Sentences{.lines = model_words(r), .page = false});
  f.say(figures, figures_table(r, true));
  f.say(figures, Sentences{.lines = balance_words(r), .page = false});
  f.say(figures, Sentences{.lines = r.notes, .indent = "  note: ", .page = false});
  f.say(figures, figures_table(r, false));
  show_ratings(f, figures, r);
  show_works_of_periods(f, figures, r);
  show_delta_formulas(f, figures, {&r});
  std::vector<std::string> lines = r.notes;
  if (!r.complete) lines.push_back("incomplete: " + r.diagnosis);
  if (r.complete && !r.periods.verdict.empty())
    lines.push_back(fmt::format("{}: {}", r.periods.steady ? "steady motion" : "no steady motion", r.periods.verdict));
  f.say(notes, Sentences{.lines = lines, .terminal = false});
  show_background(f, {&r});
  if (r.begins_at > 0) f.record("goes_on_from", r.begins_at);
  for (Field& field : result_record(r)) f.record(std::move(field.key), std::move(field.value));
  if (r.trajectory) f.tables.push_back({"trajectory", [&r] { return trajectory_data(r); }});
  return f;
}

Findings findings_of(const Comparison& c) {
  const Results results = {&c.a, &c.b};
  Findings f{.title = c.title,
             .subtitle = models_in_words(c),
             .speed_unit = speed_unit_of(c.b).name,
             .opening = Findings::Opening::title_and_conclusion,
             .reports_diagnosis = false,
             .reports_complete = false,
             .footer = report_footer()};
  judge_completion(f, c);
  for (const Result* r : results)
    for (Claim& claim : run_claims(*r, r->label + " model: "))
      if (claim.is_bad() || r == &c.b) f.claims.push_back(std::move(claim));
  if (c.a.complete && c.b.complete) f.conclude(true, c.conclusion);
  f.figures = key_figures_of(c);
  show_motion(f, results);
  const Chapter figures = f.chapter("Figures");
  f.chapter(chapter_of_trials);
  const Chapter notes = f.chapter("Notes");
  for (const Result* r : results) {
    f.say(figures, Sentences{.lines = model_words(*r), .page = false, .apart = r == &c.a});
    f.say(figures, Sentences{.lines = balance_words(*r), .page = false});
  }
  f.record("in_both", c.in_both);
  f.record("models", Record{{c.a.label, model_record(c.a)}, {c.b.label, model_record(c.b)}});
  if (c.a.complete && c.b.complete) f.brief = brief_of(c);
  const Rows table = comparison_table(c, c.rows);
  f.say(figures, table);
  f.say(figures, with_amplification(c, table));
  f.record("amplification", each(c.amplification, [](const ComparisonRow& row) {
             return Record{{"name", row.name}, {"value", row.b->value}, {"unit", ""}, {"error", row.b->error}};
           }));
  show_ratings(f, figures, c.b);
  show_amplification(f, figures, c);
  for (const Result* r : results) show_works_of_periods(f, figures, *r);
  show_delta_formulas(f, figures, results);
  std::vector<std::string> lines = c.notes;
  for (const Result* r : results)
    for (const std::string& note : r->notes) {
      const auto same = std::find(lines.begin(), lines.end(), c.a.label + ": " + note);
      if (r == &c.b && same != lines.end())
        *same = note;  // of both models
      else
        lines.push_back(r->label + ": " + note);
    }
  f.say(notes, Sentences{.lines = lines, .indent = "note: ", .key = "notes"});
  show_background(f, results);
  return f;
}

}  // namespace kurbel
