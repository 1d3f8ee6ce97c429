// sweep_findings.cpp — what a sweep found, said once.
#include "studies/sweep/sweep_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "engine/scene/keys.h"
#include "studies/findings/figure_text.h"
#include "studies/sweep/sweep_plots.h"

namespace kurbel {
namespace {

constexpr std::size_t most_influences = 12, most_worst = 10;

std::string meta_of(const SweepIdentity& identity, const std::string& key) {
  const auto found = identity.meta.find(key);
  return found == identity.meta.end() ? "" : found->second;
}

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

std::string in_words(const Index& i) { return fmt::format("{:.3f} ({:.3f} … {:.3f})", i.value, i.low, i.high); }

// --- limits ---

// By a seed: as published (seed 0) its points are chosen, not drawn.
bool is_shifted_sobol(const SweepStudyResult& s) {
  return meta_of(s.identity, "design").starts_with("sobol") && meta_of(s.identity, "seed") != "0";
}

// What the interval of a share is where points lie more evenly than random ones.
std::vector<std::string> notes_on_limits(const SweepStudyResult& s) {
  const std::string design = meta_of(s.identity, "design");
  if (s.limits.empty() || !(is_shifted_sobol(s) || design.starts_with("lhs"))) return {};
  return {
      fmt::format("The share that holds is given the interval of {} random points (Clopper and Pearson, 95 %). The "
                  "points of {} lie more evenly, so that as a rule the share is known better than that",
                  s.rows.size(), design)};
}

struct LimitCount {
  std::string limit;
  std::size_t holds = 0, undecided = 0, beyond = 0, unknown = 0;
  Interval interval;
  std::size_t decided() const { return holds + beyond + undecided; }
};

LimitCount count_of(const FigureLimit& limit, const SweepStudyResult& s) {
  LimitCount c;
  c.limit = limit.given;
  for (const SweepRow& r : s.rows) {
    const Side side = side_of(limit, r);
    ++(side == Side::holds       ? c.holds
       : side == Side::undecided ? c.undecided
       : side == Side::beyond    ? c.beyond
                                 : c.unknown);
  }
  // Who is undecided may hold or not: the interval covers both. Of points that were chosen, none is told.
  const std::string design = meta_of(s.identity, "design");
  const bool drawn = design.starts_with("random") || design.starts_with("lhs") || is_shifted_sobol(s);
  c.interval = {std::nan(""), std::nan("")};
  if (drawn)
    c.interval = {clopper_pearson(c.holds, c.decided()).low, clopper_pearson(c.holds + c.undecided, c.decided()).high};
  return c;
}

std::vector<LimitCount> counts_of(const SweepStudyResult& s) {
  std::vector<LimitCount> counts;
  for (const FigureLimit& limit : s.limits) counts.push_back(count_of(limit, s));
  return counts;
}

Rows limit_table(const SweepStudyResult& s) {
  return table_of("limits", "How many hold each limit", counts_of(s))
      .column("limit", "limit", &LimitCount::limit)
      .column("holds", "hold", &LimitCount::holds)
      .column("undecided", "within their error", &LimitCount::undecided)
      .column("beyond", "beyond", &LimitCount::beyond)
      .column("unknown", "without the figure", &LimitCount::unknown)
      .column("low", "share that holds: from [%]", [](const LimitCount& c) { return c.interval.low; },
              {.factor = 100, .digits = 4})
      .column("high", "to [%]", [](const LimitCount& c) { return c.interval.high; }, {.factor = 100, .digits = 4});
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
          .only_for_people("first order", [](const InfluenceRow& r) { return in_words(r.influence.first); })
          .only_for_people("total",
                           [](const InfluenceRow& r) { return r.influence.total ? in_words(*r.influence.total) : "—"; })
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
  return table;
}

// --- figures ---

struct Spread {
  SweptFigure figure;
  std::size_t rows = 0;
  double least = 0, mean = 0, greatest = 0, deviation = 0;
  std::optional<double> error = {};  // none was measured
};

Spread spread_of(const SweepStudyResult& s, std::size_t figure) {
  Spread spread{.figure = s.identity.figures[figure], .least = HUGE_VAL, .greatest = -HUGE_VAL};
  double squares = 0;
  for (const SweepRow& r : s.rows) {
    const double v = value_in(r, figure);
    if (!std::isfinite(v)) continue;
    ++spread.rows;
    const double before = v - spread.mean;
    spread.mean += before / static_cast<double>(spread.rows);
    squares += before * (v - spread.mean);
    spread.least = std::min(spread.least, v), spread.greatest = std::max(spread.greatest, v);
    if (const auto error = error_in(r, figure)) spread.error = std::max(spread.error.value_or(0), *error);
  }
  if (spread.rows > 1) spread.deviation = std::sqrt(squares / static_cast<double>(spread.rows - 1));
  if (spread.rows == 0) spread.least = spread.mean = spread.greatest = std::nan("");
  return spread;
}

std::vector<Spread> spreads_of(const SweepStudyResult& s) {
  std::vector<Spread> spreads;
  for (std::size_t k = 0; k < s.identity.figures.size(); ++k)
    if (Spread spread = spread_of(s, k); spread.rows > 0) spreads.push_back(std::move(spread));
  return spreads;
}

Rows figure_table(const SweepStudyResult& s) {
  return table_of("figures", "Figures over all variants", spreads_of(s))
      .column("figure", "figure", [](const Spread& f) { return f.figure.name; })
      .column("least", "least", &Spread::least)
      .column("mean", "mean", &Spread::mean)
      .column("greatest", "greatest", &Spread::greatest)
      .column("deviation", "deviation", &Spread::deviation, {.digits = 3})
      .column("largest_error", "largest error", &Spread::error, {.digits = 1})
      .column(
          "unit", "unit", [](const Spread& f) { return f.figure.unit; },
          [](const std::string& unit) { return pretty_unit(unit); })
      .column("rows", "rows", &Spread::rows);
}

// --- failures ---

// Reasons with their numbers taken out are one reason.
std::string reason_of(const std::string& diagnosis) {
  std::string reason;
  for (std::size_t i = 0; i < diagnosis.size(); ++i) {
    const bool number = (diagnosis[i] >= '0' && diagnosis[i] <= '9');
    if (!number)
      reason += diagnosis[i];
    else if (!reason.ends_with("#"))
      reason += '#';
    while (number && i + 1 < diagnosis.size() &&
           std::string("0123456789.e-+").find(diagnosis[i + 1]) != std::string::npos)
      ++i;
  }
  return reason;
}

struct Failures {
  std::size_t count = 0;
  const SweepRow* first = nullptr;
  RowState state = RowState::failed;
};

std::vector<Failures> failures_of(const SweepStudyResult& s) {
  std::map<std::string, Failures> by_reason;
  for (const SweepRow& r : s.rows) {
    if (r.state == RowState::done) continue;
    Failures& f = by_reason[name_of(r.state) + reason_of(r.diagnosis)];
    if (f.count++ == 0) f.first = &r, f.state = r.state;
  }
  std::vector<Failures> list;
  for (const auto& [reason, f] : by_reason) list.push_back(f);
  std::stable_sort(list.begin(), list.end(), [](const Failures& a, const Failures& b) { return a.count > b.count; });
  return list;
}

Rows failure_table(const SweepStudyResult& s) {
  return table_of("failures", "What did not come out, by reason", failures_of(s))
      .text_in(2)
      .column("state", "", [](const Failures& f) { return name_of(f.state); })
      .column("diagnosis", "diagnosis (of the first)", [](const Failures& f) { return f.first->diagnosis; })
      .column("count", "rows", &Failures::count)
      .column("row", "first row", [](const Failures& f) { return f.first->row; })
      .column("line", "computed alone", [&s](const Failures& f) { return line_of(s.identity, *f.first); });
}

// --- worst machines ---

struct Worst {
  std::string figure, unit;
  double value = 0;
  std::optional<double> error;
  const SweepRow* row = nullptr;
};

// By its limit; without one the greatest.
std::vector<Worst> worst_of(const SweepStudyResult& s) {
  std::vector<Worst> list;
  for (std::size_t k = 0; k < s.identity.figures.size(); ++k) {
    const auto limit =
        std::find_if(s.limits.begin(), s.limits.end(), [&](const FigureLimit& l) { return l.figure == k; });
    if (!s.limits.empty() && limit == s.limits.end()) continue;
    const double sign = limit != s.limits.end() && !limit->from_above ? -1 : 1;
    std::vector<const SweepRow*> rows;
    for (const SweepRow& r : s.rows)
      if (std::isfinite(value_in(r, k))) rows.push_back(&r);
    const std::size_t few = std::min<std::size_t>(rows.size(), s.identity.figures.size() > 4 ? 1 : 3);
    std::partial_sort(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(few), rows.end(),
                      [&](const SweepRow* a, const SweepRow* b) {
                        const double va = sign * value_in(*a, k), vb = sign * value_in(*b, k);
                        return va != vb ? va > vb : a->row < b->row;
                      });
    for (std::size_t i = 0; i < few && list.size() < most_worst; ++i)
      list.push_back({s.identity.figures[k].name, s.identity.figures[k].unit, value_in(*rows[i], k),
                      error_in(*rows[i], k), rows[i]});
  }
  return list;
}

Rows worst_table(const SweepStudyResult& s) {
  return table_of("worst", s.limits.empty() ? "Where each figure is greatest" : "The worst machines", worst_of(s))
      .column("figure", "figure", &Worst::figure)
      .column("value", "value", &Worst::value)
      .column("error", "error", &Worst::error, {.digits = 1})
      .column("unit", "unit", &Worst::unit, [](const std::string& unit) { return pretty_unit(unit); })
      .column("row", "row", [](const Worst& w) { return w.row->row; })
      .column("line", "computed alone", [&s](const Worst& w) { return line_of(s.identity, *w.row); });
}

// --- all of it ---

// A count by thousands, "10,007": a headline rounds numbers, and a count is none to round.
std::string counted(std::size_t count) {
  std::string text = fmt::format("{}", count);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
  return text;
}

std::string conclusion_of(const SweepStudyResult& s) {
  std::string text = counted(s.rows.size());
  if (s.rows.size() < s.wanted) text += " of " + counted(s.wanted);
  text += " variants computed";
  if (const std::size_t n = s.count(RowState::failed)) text += fmt::format(", {} failed", counted(n));
  if (const std::size_t n = s.count(RowState::unconfirmed)) text += fmt::format(", {} not confirmed", counted(n));
  for (const LimitCount& c : counts_of(s))
    text += fmt::format("; {}: {} of {} hold{}", c.limit, counted(c.holds), counted(c.decided()),
                        c.undecided ? fmt::format(", {} undecided", counted(c.undecided)) : "");
  for (const FigureInfluence& f : s.influences) {
    if (f.ranked.empty()) continue;
    const Influence& most = f.ranked.front();
    text += fmt::format("; {} hangs most on {} ({} of its variance)", s.identity.figures[f.figure].name,
                        s.identity.parameters[most.parameter].path, percent(std::clamp(most.first.value, 0.0, 1.0)));
    break;
  }
  return text;
}

std::string csv_text(const SweepStudyResult& s) {
  std::string text = "row,state,seconds";
  for (const SweptParameter& p : s.identity.parameters)
    text += fmt::format(",{}{}", p.path, p.unit.empty() ? "" : " [" + p.unit + "]");
  for (const SweptFigure& f : s.identity.figures)
    text += fmt::format(",{} [{}],error of {} [{}]", f.name, f.unit, f.name, f.unit);
  text += '\n';
  for (const SweepRow& r : s.rows) {
    text += fmt::format("{},{},{:.4g}", r.row, name_of(r.state), r.seconds);
    for (std::size_t k = 0; k < r.parameters.size(); ++k) {
      const SweptParameter& p = s.identity.parameters[k];
      text += p.words.empty() ? fmt::format(",{}", r.parameters[k])
                              : "," + p.words[static_cast<std::size_t>(r.parameters[k])];
    }
    for (std::size_t k = 0; k < s.identity.figures.size(); ++k) {
      const double v = value_in(r, k);
      const auto error = error_in(r, k);
      text += std::isfinite(v) ? fmt::format(",{}", v) : ",";
      text += error ? fmt::format(",{:.3g}", *error) : ",";
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::size_t SweepStudyResult::count(RowState state) const {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [&](const SweepRow& r) { return r.state == state; }));
}

SweepStudyResult study_of(const SweepStore& store, const std::vector<std::string>& limits) {
  SweepStudyResult s{
      .identity = store.identity(), .rows = {}, .limits = {}, .influences = {}, .into = store.file().string()};
  for (const std::string& limit : limits) s.limits.push_back(parse_limit(limit, s.identity.figures));
  s.rows = store.read();
  s.wanted = s.rows.size();
  const bool saltelli = meta_of(s.identity, "design").starts_with("saltelli");
  for (std::size_t k = 0; k < s.identity.figures.size(); ++k)
    s.influences.push_back(influence_on(k, s.identity, s.rows, saltelli));
  return s;
}

std::string line_of(const SweepIdentity& identity, const SweepRow& row) {
  const std::string of = meta_of(identity, "of");
  std::string line = fmt::format("kurbel {} {}", of, meta_of(identity, "scene file"));
  if (of == "size" && !meta_of(identity, "delta").empty()) line += " --delta " + meta_of(identity, "delta");
  std::istringstream settings(meta_of(identity, "settings"));
  for (std::string setting; std::getline(settings, setting);) line += fmt::format(" --set '{}'", setting);
  for (std::size_t k = 0; k < identity.parameters.size(); ++k)
    line += fmt::format(" --set '{}'", identity.parameters[k].setting(row.parameters[k]));
  return line;
}

Findings findings_of(const SweepStudyResult& s) {
  Findings f{.title = meta_of(s.identity, "title"),
             .subtitle = fmt::format("Sweep of {} by {}", meta_of(s.identity, "of"), meta_of(s.identity, "design")),
             .scene_file = meta_of(s.identity, "scene file"),
             .complete = !s.interrupted && s.rows.size() >= s.wanted,
             .diagnosis = s.interrupted ? "interrupted; the same command goes on where it ended"
                                        : "rows are missing; the same command goes on"};
  f.answer(Question::figures, conclusion_of(s));
  for (const Spread& spread : spreads_of(s))
    if (f.figures.size() < 4)
      f.figures.push_back(
          {"greatest " + spread.figure.name, spread.greatest, spread.figure.unit, {}, "", 5, spread.figure.name});
  const Chapter limits = f.chapter("Limits"), influence = f.chapter("What moves the figures"),
                curves = f.chapter("Response"), worst = f.chapter("Machines"), all = f.chapter("The sweep");
  if (!s.limits.empty()) f.say(limits, limit_table(s));
  f.note(limits, notes_on_limits(s));
  f.draw(limits, [&s] { return limit_maps(s); });
  f.say(influence, influence_table(s));
  f.draw(influence, [&s] { return influence_plots(s); });
  f.draw(curves, [&s] { return response_plots(s); });
  f.draw(curves, [&s] { return scatter_matrix(s); });
  f.say(worst, worst_table(s));
  f.say(worst, failure_table(s));
  f.say(all, figure_table(s));
  f.tell("rows", s.rows.size());
  f.tell("failed", s.count(RowState::failed));
  f.tell("unconfirmed", s.count(RowState::unconfirmed));
  f.tell("design", meta_of(s.identity, "design"));
  f.tell("seed", meta_of(s.identity, "seed"));
  f.tell("shard", s.identity.shard);
  f.tell("database", s.into);
  f.show_scene(meta_of(s.identity, "scene file"), meta_of(s.identity, "scene text"));
  f.csv.push_back({"variants.csv", [&s] { return csv_text(s); }});
  return f;
}

}  // namespace kurbel
