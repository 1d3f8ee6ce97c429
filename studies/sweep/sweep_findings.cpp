// sweep_findings.cpp — findings of a sweep.
#include "studies/sweep/sweep_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "engine/scene/keys.h"
#include "studies/claims/ranges.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/thin.h"
#include "studies/sweep/sweep_plots.h"

namespace kurbel {
namespace {

constexpr std::size_t most_influences = 12, most_worst = 10;

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

// All three end at the same digit, by the width of the interval.
std::string interval_words(const Index& i) {
  if (i.low == i.high) return figure_text({i.value}, 3).value;
  if (std::abs(i.value) < 1e-4 && i.high < 1e-3) return fmt::format("{:.1g} ({:.1g} … {:.1g})", i.value, i.low, i.high);
  const std::string value = figure_text({i.value, 0.5 * (i.high - i.low)}, 3).value;
  const std::size_t point = value.find('.'), places = point == std::string::npos ? 0 : value.size() - point - 1;
  return fmt::format("{} ({:.{}f} … {:.{}f})", value, i.low, places, i.high, places);
}

// A count with thousands separators, "10,007": a headline rounds a plain number.
std::string counted(std::size_t count) {
  std::string text = fmt::format("{}", count);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
  return text;
}

// --- limits ---

// Meaning of a share's interval for points distributed more evenly than random ones.
std::vector<std::string> notes_on_limits(const SweepStudyResult& s) {
  const std::string design = s.identity.reported("design");
  if (s.limits.empty() || !(is_shifted_sobol(s.identity) || design.starts_with("lhs"))) return {};
  return {
      fmt::format("The share that holds is given the interval of {} random points (Clopper and Pearson, 95 %). The "
                  "points of {} lie more evenly, so that as a rule the share is known better than that",
                  s.tally.rows, design)};
}

// --- influence ---

struct InfluenceRow {
  std::string figure, parameter;
  Influence influence;
};

std::vector<InfluenceRow> influence_rows(const SweepStudyResult& s) {
  std::vector<InfluenceRow> rows;
  for (const FigureInfluence& f : s.influences)
    for (std::size_t k = 0; k < f.ranked.size() && k < most_influences; ++k)
      rows.push_back(
          {s.identity.figures[f.figure].name, s.identity.parameters[f.ranked[k].parameter].path, f.ranked[k]});
  return rows;
}

Rows influence_table(const SweepStudyResult& s) {
  auto table =
      table_of("influence", "What moves each figure: Sobol's indices, 95 %", influence_rows(s))
          .text_in(2)
          .column("figure", "figure", &InfluenceRow::figure)
          .column("parameter", "parameter", &InfluenceRow::parameter)
          .only_for_people("first order", [](const InfluenceRow& r) { return interval_words(r.influence.first); })
          .only_for_people(
              "total",
              [](const InfluenceRow& r) { return r.influence.total ? interval_words(*r.influence.total) : "—"; })
          .only_for_programs("first", [](const InfluenceRow& r) { return r.influence.first.value; })
          .only_for_programs("first_low", [](const InfluenceRow& r) { return r.influence.first.low; })
          .only_for_programs("first_high", [](const InfluenceRow& r) { return r.influence.first.high; });
  const auto of_total = [](double Index::*what) {
    return [what](const InfluenceRow& r) {
      return r.influence.total ? std::optional((*r.influence.total).*what) : std::nullopt;
    };
  };
  table.only_for_programs("total", of_total(&Index::value));
  table.only_for_programs("total_low", of_total(&Index::low));
  table.only_for_programs("total_high", of_total(&Index::high));
  constexpr std::size_t most_at_once = 24;
  return table.fold(table.count > most_at_once);
}

// --- figures ---

std::vector<Spread> spreads_of(const SweepStudyResult& s) {
  std::vector<Spread> spreads = s.tally.spreads;
  std::erase_if(spreads, [](const Spread& spread) { return spread.rows == 0; });
  return spreads;
}

Rows figure_table(const SweepStudyResult& s) {
  auto table = table_of("figures", "Figures over all variants", spreads_of(s));
  table.column("figure", "figure", [](const Spread& f) { return f.figure.name; });
  // Speeds in the scene's unit for people; each ends where the largest error of a row begins.
  const auto cells = [&s](const Spread& f, double value, int digits) {
    return figure_cells({value, f.error}, f.figure.unit, s.speed_unit, digits);
  };
  const auto add = [&](const char* key, double Spread::*of, int digits) {
    table.only_for_programs(key, of).only_for_people(
        key, [&, of, digits](const Spread& f) { return cells(f, f.*of, digits).value; });
  };
  add("least", &Spread::least, digits_in_tables);
  add("mean", &Spread::mean, 5);
  add("greatest", &Spread::greatest, digits_in_tables);
  add("deviation", &Spread::deviation, 3);
  return table.only_for_programs("largest_error", &Spread::error)
      .only_for_people("numerical error", [&](const Spread& f) { return cells(f, 0, digits_in_tables).error; })
      .column(
          "unit", "unit", [](const Spread& f) { return f.figure.unit; },
          [&s](const std::string& unit) { return s.reported(unit); })
      .column("rows", "rows", &Spread::rows);
}

// --- failures ---

Rows failure_table(const SweepStudyResult& s) {
  return table_of("failures", "What did not come out, by reason", s.tally.failures)
      .text_in(2)
      .column("state", "", [](const Failures& f) { return name_of(f.first.state); })
      .column("diagnosis", "diagnosis (of the first)", [](const Failures& f) { return f.first.diagnosis; })
      .column("count", "rows", &Failures::count)
      .column("row", "first row", [](const Failures& f) { return f.first.row; })
      .column("line", "computed alone", [&s](const Failures& f) { return line_of(s.identity, f.first); });
}

// --- worst machines ---

struct Worst : Estimate {
  std::string figure, unit;
  const SweepRow* row = nullptr;
};

std::vector<Worst> worst_of(const SweepStudyResult& s) {
  std::vector<Worst> list;
  for (std::size_t k = 0; k < s.identity.figures.size(); ++k)
    for (const SweepRow& r : s.tally.worst[k])
      if (list.size() < most_worst)
        list.push_back({figure_in(r, k), s.identity.figures[k].name, s.identity.figures[k].unit, &r});
  return list;
}

Rows worst_table(const SweepStudyResult& s) {
  return table_of("worst", s.limits.empty() ? "Where each figure is greatest" : "The worst machines", worst_of(s))
      .column("figure", "figure", &Worst::figure)
      .only_for_programs("value", &Worst::value)
      .only_for_programs("error", &Worst::error)
      .value_and_error("value",
                       [&s](const Worst& w, int digits) { return figure_cells(w, w.unit, s.speed_unit, digits); })
      .column("unit", "unit", &Worst::unit, [&s](const std::string& unit) { return s.reported(unit); })
      .column("row", "row", [](const Worst& w) { return w.row->row; })
      .column("line", "computed alone", [&s](const Worst& w) { return line_of(s.identity, *w.row); });
}

// --- all of it ---

// Of the figure that is limited, else of the first that varies.
const FigureInfluence* influence_to_tell(const SweepStudyResult& s) {
  const FigureInfluence* told = nullptr;
  for (const FigureInfluence& f : s.influences) {
    if (f.ranked.empty()) continue;
    if (!s.limits.empty() && f.figure == s.limits.front().figure) return &f;
    if (!told) told = &f;
  }
  return told;
}

// "a, b and c".
std::string one_after_another(const std::vector<std::string>& words) {
  std::string text = words.front();
  for (std::size_t i = 1; i < words.size(); ++i) text += (i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

// Several whose intervals overlap (without intervals: within a tenth) are not ranked.
std::string influence_words(const SweepStudyResult& s) {
  const FigureInfluence* f = influence_to_tell(s);
  if (!f) return "";
  constexpr double alike = 0.9;
  constexpr std::size_t most_named = 3;
  const Index& first = f->ranked.front().first;
  std::vector<std::string> names, parts;
  for (const Influence& i : f->ranked) {
    const bool has_interval = first.low < first.high;
    if (has_interval ? i.first.high < first.low : i.first.value < alike * first.value) continue;
    names.push_back(s.identity.parameters[i.parameter].path);
    parts.push_back(percent(std::clamp(i.first.value, 0.0, 1.0)));
  }
  const std::string& figure = s.identity.figures[f->figure].name;
  if (names.size() == 1) return fmt::format("; {} depends most on {} ({} of its variance)", figure, names[0], parts[0]);
  if (names.size() > most_named)
    return fmt::format("; {} depends on {} parameters alike, at most {} of its variance by one alone", figure,
                       names.size(), parts[0]);
  return fmt::format("; {} depends on {} together ({} of its variance by each alone)", figure, one_after_another(names),
                     one_after_another(parts));
}

std::string conclusion_of(const SweepStudyResult& s) {
  std::string text = counted(s.tally.rows);
  if (s.tally.rows < s.wanted) text += " of " + counted(s.wanted);
  text += " variants computed";
  if (s.tally.failed) text += fmt::format(", {} failed", counted(s.tally.failed));
  if (s.tally.unconfirmed) text += fmt::format(", {} not confirmed", counted(s.tally.unconfirmed));
  for (const LimitCount& c : s.tally.limits)
    if (c.decided() == 0 && c.undecided == 0)
      text += fmt::format("; {}: no variant has that figure", limit_in_words(c.limit));
    else
      text += fmt::format("; {} holds in {} of {}{}", limit_in_words(c.limit), counted(c.holds), counted(c.decided()),
                          c.undecided ? fmt::format(", {} undecided", counted(c.undecided)) : "");
  return text + influence_words(s);
}

void fill(std::vector<DataCell>& cells, const SweepStudyResult& s, const SweepRow& r) {
  cells = {static_cast<double>(r.row), name_of(r.state), r.seconds};
  for (std::size_t k = 0; k < r.parameters.size(); ++k) {
    const SweptParameter& p = s.identity.parameters[k];
    if (p.words.empty())
      cells.emplace_back(r.parameters[k]);
    else
      cells.emplace_back(p.words[static_cast<std::size_t>(r.parameters[k])]);
  }
  for (std::size_t k = 0; k < s.identity.figures.size(); ++k) {
    const double v = value_in(r, k);
    cells.emplace_back(std::isfinite(v) ? v : NAN);
    cells.emplace_back(figure_in(r, k).error.value_or(NAN));
  }
}

// One table, or for a large sweep one per rows_in_table, so that they are not in memory together.
std::vector<NamedTable> variant_tables(const SweepStudyResult& s) {
  std::vector<NamedTable> tables;
  const std::vector<std::size_t>& begins = s.tally.pieces;
  for (std::size_t i = 0; i < std::max<std::size_t>(begins.size(), 1); ++i) {
    const std::size_t from = i == 0 ? 0 : begins[i], to = i + 1 < begins.size() ? begins[i + 1] : SweepStore::all;
    const std::string name = i == 0 ? "variants" : fmt::format("variants_{}", i + 1);
    tables.push_back({name, [&s, from, to] { return variants_data(s, from, to); }});
  }
  return tables;
}

// Which findings refer to all rows, and which to those held.
std::vector<std::string> notes_on_rows(const SweepStudyResult& s) {
  if (s.holds_all()) return {};
  std::vector<std::string> notes = {fmt::format(
      "Indices and pictures are of {} of the {} rows, drawn by chance; counts, ends and worst machines of all",
      counted(s.rows.size()), counted(s.tally.rows))};
  if (s.tally.pieces.size() > 1)
    notes.push_back(fmt::format("The variants stand in {} tables of {} rows, variants.csv, variants_2.csv …",
                                s.tally.pieces.size(), counted(rows_in_table)));
  return notes;
}

}  // namespace

DataTable variants_data(const SweepStudyResult& s, std::size_t from, std::size_t to, bool with_diagnosis) {
  DataTable table{.columns = {{.name = "row"}, {.name = "state", .words = true}, {.name = "seconds", .format = {4}}},
                  .each_row = [&s, from, to, with_diagnosis](const std::function<void(DataRow)>& take) {
                    std::vector<DataCell> cells;
                    const auto take_row = [&](const SweepRow& r) {
                      fill(cells, s, r);
                      if (with_diagnosis) cells.emplace_back(r.diagnosis);
                      take(cells);
                    };
                    s.each_row(take_row, from, to);
                  }};
  for (const SweptParameter& p : s.identity.parameters)
    table.columns.push_back(
        {.name = p.path, .unit = p.unit.empty() ? std::nullopt : std::optional(p.unit), .words = !p.words.empty()});
  for (const SweptFigure& f : s.identity.figures) {
    table.columns.push_back({f.name, f.unit});
    table.columns.push_back({"error of " + f.name, f.unit, {3}});
  }
  if (with_diagnosis) table.columns.push_back({.name = "diagnosis", .words = true});
  return table;
}

void SweepStudyResult::each_row(const std::function<void(const SweepRow&)>& visit, std::size_t from,
                                std::size_t to) const {
  if (!holds_all()) {
    store->each([&](SweepRow&& row) { visit(row); }, from, to);
    return;
  }
  for (const SweepRow& row : rows)
    if (row.row >= from && row.row < to) visit(row);
}

SweepStudyResult study_of(const SweepStore& store, const std::vector<std::string>& limits, std::size_t held) {
  SweepStudyResult s{.identity = store.identity(),
                     .rows = {},
                     .tally = {},
                     .store = &store,
                     .limits = {},
                     .influences = {},
                     .into = store.file().string()};
  for (const std::string& limit : limits) s.limits.push_back(parse_limit(limit, s.identity.figures));
  s.tally = tally_of(store, s.limits);
  s.wanted = s.tally.rows;
  const bool saltelli = s.identity.reported("design").starts_with("saltelli");
  // From Saltelli's design whole groups are selected.
  const std::size_t group = saltelli ? s.identity.parameters.size() + 2 : 1;
  const std::size_t groups = (saltelli ? s.identity.rows : s.tally.rows) / group;
  std::vector<bool> drawn(groups + 1, s.tally.rows <= held);
  if (s.tally.rows > held)
    for (const std::size_t i : drawn_by_chance(groups, held / group)) drawn[i] = true;
  std::size_t number = 0;
  store.each([&](SweepRow&& row) {
    if (drawn[std::min(saltelli ? row.row / group : number, groups)]) s.rows.push_back(std::move(row));
    ++number;
  });
  for (std::size_t k = 0; k < s.identity.figures.size(); ++k)
    s.influences.push_back(influence_on(k, s.identity, s.rows, saltelli));
  return s;
}

std::string line_of(const SweepIdentity& identity, const SweepRow& row) {
  const std::string of = identity.reported("of");
  std::string line = fmt::format("kurbel {} {}", of, identity.reported("scene file"));
  if (of == "size" && !identity.reported("delta").empty()) line += " --delta " + identity.reported("delta");
  std::istringstream settings(identity.reported("settings"));
  for (std::string setting; std::getline(settings, setting);) line += fmt::format(" --set '{}'", setting);
  for (std::size_t k = 0; k < identity.parameters.size(); ++k)
    line += fmt::format(" --set '{}'", identity.parameters[k].setting(row.parameters[k]));
  return line;
}

Rows limit_table(const std::string& title, const std::vector<LimitCount>& limits, const std::string& unknown,
                 const std::string& from) {
  return table_of("limits", title, limits)
      .column("limit", "limit", &LimitCount::limit, limit_in_words)
      .column("holds", "hold", &LimitCount::holds)
      .column("undecided", "within their error", &LimitCount::undecided)
      .column("beyond", "beyond", &LimitCount::beyond)
      .column(unknown, "without the figure", &LimitCount::unknown)
      .column("low", from, [](const LimitCount& c) { return c.interval.low; }, {.factor = 100, .digits = 3})
      .column("high", "to [%]", [](const LimitCount& c) { return c.interval.high; }, {.factor = 100, .digits = 3});
}

Claims share_claims(const std::vector<LimitCount>& limits, std::size_t failed, std::size_t machines) {
  Claims claims;
  add(claims, claimed_aside(Predicate::machines_failed, fmt::format("{} of {} machines failed", failed, machines), {},
                            {.value = static_cast<double>(failed), .limit = 0}));
  for (const LimitCount& c : limits)
    if (const auto decided = static_cast<double>(c.decided()); decided > 0) {
      const bool by_chance = std::isfinite(c.interval.low);  // a grid has no interval
      add(claims,
          claimed_aside(
              Predicate::share_holds,
              limit_in_words(c.limit) + (by_chance ? fmt::format(" holds in {} % of such machines",
                                                                 range_text(100 * c.interval.low, 100 * c.interval.high,
                                                                            c.interval.high > 0.9995 ? 4 : 3))
                                                   : fmt::format(" holds in {} of {} machines", c.holds, c.decided())),
              {},
              {.value = static_cast<double>(c.holds) / decided,
               .error = by_chance ? std::optional(0.5 * (c.interval.high - c.interval.low)) : std::nullopt}));
    }
  return claims;
}

Findings findings_of(const SweepStudyResult& s) {
  Findings f{.title = s.identity.reported("title"),
             .subtitle = fmt::format("Sweep of {} by {}", s.identity.reported("of"), s.identity.reported("design")),
             .scene_file = s.identity.reported("scene file"),
             .complete = !s.interrupted && s.tally.rows >= s.wanted,
             .diagnosis = s.interrupted ? "interrupted; the same command goes on where it ended"
                                        : "rows are missing; the same command goes on"};
  f.conclude(true, conclusion_of(s));
  f.claim(share_claims(s.tally.limits, s.tally.failed, s.tally.rows));
  for (const Spread& spread : spreads_of(s))
    if (f.figures.size() < 4)
      f.figures.push_back({s.reported(1, spread.figure.unit) * Estimate{spread.greatest, spread.error},
                           "greatest " + spread.figure.name,
                           spread.figure.unit == "rad/s" ? s.speed_unit.name : spread.figure.unit, "", 0,
                           spread.figure.name});
  const Chapter limits = f.chapter(s.limits.empty() ? "Over two parameters" : "Limits"),
                influence = f.chapter("What moves the figures"), curves = f.chapter("Response"),
                worst = f.chapter("Machines"), all = f.chapter("The sweep");
  if (!s.limits.empty())
    f.say(limits, limit_table("How many hold each limit", s.tally.limits, "unknown", "share that holds: from [%]"));
  f.note(limits, notes_on_limits(s));
  f.draw(limits, [&s] { return limit_maps(s); });
  f.say(influence, influence_table(s));
  f.draw(influence, [&s] { return influence_plots(s); });
  f.draw(curves, [&s] { return response_plots(s); });
  f.draw(curves, [&s] { return scatter_matrix(s); });
  f.say(worst, worst_table(s));
  f.say(worst, failure_table(s));
  f.say(all, figure_table(s));
  f.note(all, notes_on_rows(s));
  f.record("rows", s.tally.rows);
  f.record("failed", s.tally.failed);
  f.record("unconfirmed", s.tally.unconfirmed);
  f.record("design", s.identity.reported("design"));
  f.record("seed", s.identity.reported("seed"));
  f.record("shard", s.identity.shard);
  f.record("database", s.into);
  f.show_scene(s.identity.reported("scene file"), s.identity.reported("scene text"));
  f.tables = variant_tables(s);
  return f;
}

}  // namespace kurbel
