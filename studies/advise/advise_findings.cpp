// advise_findings.cpp — plot of error against time saved; the screens and runs behind the advice.
#include "studies/advise/advise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kurbel {
namespace {

constexpr double least_shown = 1e-6;  // percent

template <class Deviating>
FigureText in_percent(const Deviating& d) {
  if (!d.refused.empty()) return {"—", "—"};
  if (!std::isfinite(d.deviation)) return {"lost", "—"};
  const FigureText text = figure_text({100 * d.deviation, 100 * d.error}, 3);
  return {text.value + " %", text.error + " %"};
}

std::string or_dash(const std::string& figure) { return figure.empty() ? "—" : figure; }

Rows effect_table(const Advice& a) {
  return table_of("effects", "Each effect", numbers_below(std::min(a.units.size(), a.kept_because.size())))
      .text_in(3, 2)
      .always()
      .only_for_people("effect", [&](std::size_t k) { return a.units[k].words; })
      .only_for_programs("effect", [&](std::size_t k) { return a.units[k].name; })
      .only_for_programs("on", [&](std::size_t k) { return static_cast<bool>(a.tried[a.chosen].on[k]); })
      .column("why", "advice", [&](std::size_t k) { return a.kept_because[k]; })
      .only_for_people("criteria",
                       [&](std::size_t k) {
                         std::string screens;
                         for (const Screen& s : a.screens[k]) screens += (screens.empty() ? "" : "; ") + s.verdict;
                         return screens.empty() ? "none applies" : screens;
                       })
      .only_for_programs("screens", [&](std::size_t k) {
        return each(a.screens[k], [](const Screen& s) {
          return Record{{"name", s.name}, {"number", s.number}, {"verdict", s.verdict}, {"needed", s.needed}};
        });
      });
}

// Smallest deviation first.
Rows tried_table(const Advice& a) {
  std::vector<const TriedSet*> order;
  for (const TriedSet& t : a.tried) order.push_back(&t);
  std::stable_sort(order.begin(), order.end(),
                   [](const TriedSet* x, const TriedSet* y) { return x->deviation < y->deviation; });
  return table_of("", "Every set that was run", std::move(order))
      .always()
      .only_for_people("effects on", &TriedSet::words)
      .only_for_people("deviation", [](const TriedSet* t) { return in_percent(*t).value; })
      .only_for_people("numerical error", [](const TriedSet* t) { return in_percent(*t).error; })
      .only_for_people("in", [](const TriedSet* t) { return or_dash(t->figure); })
      .only_for_people("time [ms]", &TriedSet::cpu_seconds, {.factor = 1e3, .digits = 3})
      .only_for_people("states", [](const TriedSet* t) { return t->size.states; })
      .only_for_people("evaluations", &TriedSet::evaluations)
      .only_for_people("within", [&](const TriedSet* t) {
        if (!t->refused.empty()) return "does not run";
        return t == &a.tried[a.chosen] ? "yes, chosen" : t->within ? "yes" : "no";
      });
}

Rows held_out_table(const Advice& a) {
  return table_of("held_out", "Figures and operating points that took no part in the choice", a.held_out)
      .column("what", "check", &HeldOut::what)
      .only_for_programs("deviation", &HeldOut::deviation)
      .only_for_programs("error", &HeldOut::error)
      .only_for_people("deviation", [](const HeldOut& h) { return in_percent(h).value; })
      .only_for_people("numerical error", [](const HeldOut& h) { return in_percent(h).error; })
      .column("figure", "in", &HeldOut::figure, or_dash)
      .only_for_programs("within", &HeldOut::within)
      .only_for_people("within", [](const HeldOut& h) {
        return h.within ? "yes" : h.refused.empty() ? "no" : h.refused;
      });
}

Record tried_record(const Advice& a, const TriedSet& t) {
  Record r = {{"effects", t.words},
              {"cpu_seconds", t.cpu_seconds},
              {"states", t.size.states},
              {"evaluations", t.evaluations},
              {"within", t.within}};
  if (!t.refused.empty()) {
    r.push_back({"refused", t.refused});
  } else {
    if (std::isfinite(t.deviation)) r.push_back({"deviation", t.deviation});
    r.push_back({"error", t.error});
    if (!t.not_judged.empty()) r.push_back({"not_judged", each(t.not_judged, [](const std::string& f) { return f; })});
    r.push_back({"figure", t.figure});
  }
  r.push_back({"chosen", &t == &a.tried[a.chosen]});
  return r;
}

Plot plane(const Advice& a) {
  Plot plot{.title = "Error and processor time of every set that was run",
            .x = {"processor time of a run", "ms", true},
            .y = {"greatest deviation from the full model", "%", true}};
  const auto add = [&](const std::string& name, Role role, auto belongs) {
    Series series{.name = name, .role = role, .points = true, .line = false};
    for (std::size_t i = 0; i < a.tried.size(); ++i) {
      const TriedSet& t = a.tried[i];
      if (!t.refused.empty() || !std::isfinite(t.deviation) || !belongs(i, t)) continue;
      series.add(1e3 * t.cpu_seconds, std::max(100 * t.deviation, least_shown));
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
                         .role = Role::reference,
                         .x = {low, high},
                         .y = {100 * a.tolerance, 100 * a.tolerance},
                         .dashed = true});
  for (const Series& s : plot.series)
    if (std::count(s.y.begin(), s.y.end(), least_shown)) plot.note = "Smaller deviations are drawn at 10⁻⁶ %.";
  return plot;
}

}  // namespace

Findings findings_of(const Advice& a) {
  Findings f{.title = a.title,
             .subtitle = fmt::format("Which effects are needed for {:.3g} %", 100 * a.tolerance),
             .complete = a.complete,
             .diagnosis = a.diagnosis,
             .opening = Findings::Opening::title_and_conclusion,
             .reports_diagnosis = false};
  f.conclude(a.complete, a.conclusion);
  const TriedSet &full = a.tried.front(), &chosen = a.tried[a.chosen];
  if (a.complete && a.chosen > 0)
    f.claim(claimed_aside(Predicate::effects_suffice, fmt::format("effects that suffice: {}", chosen.words), {},
                          {.value = chosen.deviation, .limit = a.tolerance, .error = chosen.error}));
  const auto in_ms = [&a](double s) { return Estimate{1e3 * s, 1e3 * a.time_spread * s}; };
  const Estimate deviation{100 * chosen.deviation, 100 * chosen.error}, sets{static_cast<double>(a.tried.size()), 0};
  f.figures = {{deviation, "deviation", "%", "at most, measured", 3, "deviation"},
               {in_ms(full.cpu_seconds), "time of the full model", "ms", "a run", 3, "processor_time"},
               {in_ms(chosen.cpu_seconds), "time of the lean model", "ms", "a run", 3, "processor_time"},
               {sets, "sets run", "", "", 3, "sets_run"}};
  const Chapter advice = f.chapter("Advice"), runs = f.chapter("Runs"), lean = f.chapter("Lean scene");
  f.record("within", a.tolerance);
  f.draw(advice, [&a] { return plane(a); });
  f.say(advice, effect_table(a));
  f.say(runs, tried_table(a));
  f.record("tried", each(a.tried, [&](const TriedSet& t) { return tried_record(a, t); }));
  f.say(advice, held_out_table(a));
  f.say(advice, Sentences{.lines = a.warnings, .title = "Warnings", .indent = "warning: ", .key = "warnings"});
  f.say(runs, Sentences{.lines = a.full.notes, .title = "Notes on the full model", .indent = "note: ", .key = "notes"});
  f.show(lean, Text{.title = "The scene with these effects", .body = a.lean_scene, .verbatim = true, .folded = true});
  return f;
}

}  // namespace kurbel
