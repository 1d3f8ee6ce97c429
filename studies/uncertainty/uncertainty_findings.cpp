// uncertainty_findings.cpp — figures and the sources of their uncertainty.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/units.h"
#include "studies/claims/headline.h"
#include "studies/findings/plots.h"
#include "studies/sweep/sweep_findings.h"
#include "studies/uncertainty/uncertainty.h"

namespace kurbel {
namespace {

const std::string& unit_of(const FigureUncertainty& f) { return f.figure.unit; }
template <class Row>
const std::string& unit_of(const Row& row) {
  return row.unit;
}

// An Estimate, or std::optional of one: for programs in SI, for people in the scene's unit, to where its error begins.
template <class Row, class Get>
RowsOf<Row>& add_quantity(const UncertaintyStudy& s, RowsOf<Row>& table, const char* key, const char* heading, Get get,
                          int most_digits) {
  const auto known = [get](const Row& row) { return std::optional<Estimate>(std::invoke(get, row)); };
  return table.only_for_programs(key, [&](const Row& row) { return known(row).value_or(Estimate{NAN}).value; })
      .only_for_people(heading, [&](const Row& row) {
        return figure_cells(known(row).value_or(Estimate{NAN}), unit_of(row), s.speed_unit, most_digits).value;
      });
}
// The numerical error of an Estimate.
template <class Row, class Get>
RowsOf<Row>& add_error(const UncertaintyStudy& s, RowsOf<Row>& table, const char* key, const char* heading, Get get) {
  return table.only_for_programs(key, [get](const Row& row) { return std::invoke(get, row).error; })
      .only_for_people(heading, [&s, get](const Row& row) {
        return figure_cells({0, std::invoke(get, row).error}, unit_of(row), s.speed_unit).error;
      });
}
template <class Row>
RowsOf<Row>& add_unit(const UncertaintyStudy& s, RowsOf<Row>& table) {
  return table.only_for_programs("unit", [](const Row& row) { return unit_of(row); })
      .only_for_people("unit", [&](const Row& row) { return figure_cells({}, unit_of(row), s.speed_unit).unit; });
}

Rows figure_table(const UncertaintyStudy& s) {
  using F = FigureUncertainty;
  auto table = table_of("figures", "Figures of machines within these tolerances", s.figures);
  table.column("figure", "figure", [](const F& f) { return f.figure.name; });
  table.only_for_programs("value", &F::value).only_for_programs("numerical", &F::error);
  table.value_and_error("as given",
                        [&s](const F& f, int digits) { return figure_cells(f, f.figure.unit, s.speed_unit, digits); });
  add_quantity(s, table, "by_gradients", "deviation by gradients", &F::by_gradients, 3);
  add_error(s, table, "noise_floor", "noise floor", &F::by_gradients);
  add_quantity(s, table, "by_samples", "by samples", &F::by_samples, 3);
  add_quantity(s, table, "mean", "mean", &F::mean, 5);
  // However uncertain the ends are, their digits show how far they lie apart.
  const auto end = [](std::optional<Estimate> F::*member) {
    return [member](const F& f) {
      std::optional<Estimate> at = f.*member;
      if (at && at->error && f.low && f.high) at->error = std::min(*at->error, (f.high->value - f.low->value) / 10);
      return at;
    };
  };
  add_quantity(s, table, "low", "95 % from", end(&F::low), 5);
  add_quantity(s, table, "high", "to", end(&F::high), 5);
  return add_unit(s, table).column("samples", "samples", &F::samples);
}

struct ShareRow {
  std::string figure, parameter, unit;
  ToleranceShare share;
};
std::vector<ShareRow> share_rows(const UncertaintyStudy& s) {
  std::vector<ShareRow> rows;
  for (const FigureUncertainty& f : s.figures)
    for (const ToleranceShare& share : f.shares)
      if (f.by_gradients.value > 0)
        rows.push_back({f.figure.name, s.parameters[share.parameter].given().path, f.figure.unit, share});
  return rows;
}
Rows share_table(const UncertaintyStudy& s) {
  constexpr std::size_t most_at_once = 40;
  std::vector<ShareRow> rows = share_rows(s);
  const bool is_long = rows.size() > most_at_once;
  auto table = table_of("shares", "Share of each tolerance in the deviation", std::move(rows));
  table.fold(is_long)
      .text_in(2)
      .column("figure", "figure", &ShareRow::figure)
      .column("parameter", "tolerance", &ShareRow::parameter)
      .only_for_programs("share", [](const ShareRow& r) { return r.share.share.value; })
      .only_for_people("share [%]", [](const ShareRow& r) { return figure_text(100 * r.share.share, 3).value; });
  const auto deviation = [](const ShareRow& r) { return r.share.deviation; };
  add_quantity(s, table, "deviation", "deviation", deviation, 3).only_for_programs("gradient", [](const ShareRow& r) {
    return r.share.gradient;
  });
  add_error(s, table, "noise", "numerical noise", deviation)
      .column("step", "step [deviations]", [](const ShareRow& r) { return r.share.step; }, {.digits = 1});
  add_quantity(
      s, table, "without", "deviation without it", [](const ShareRow& r) { return r.share.without; }, 3);
  return add_unit(s, table);
}

struct BiasRow {
  std::string figure, unit;
  Bias bias;
};
std::vector<BiasRow> bias_rows(const UncertaintyStudy& s) {
  std::vector<BiasRow> rows;
  for (const FigureUncertainty& f : s.figures)
    for (const Bias& b : f.biases) rows.push_back({f.figure.name, f.figure.unit, b});
  return rows;
}
Rows bias_table(const UncertaintyStudy& s) {
  auto table = table_of("biases", "Known biases: what each effect that is off would shift", bias_rows(s));
  table.text_in(2).column("figure", "figure", &BiasRow::figure).column("effect", "effect", [](const BiasRow& r) {
    return r.bias.effect;
  });
  table.only_for_programs("shift", [](const BiasRow& r) { return r.bias.value; })
      .only_for_programs("error", [](const BiasRow& r) { return r.bias.error; })
      .value_and_error("shift", [&s](const BiasRow& r, int) { return figure_cells(r.bias, r.unit, s.speed_unit, 4); });
  return add_unit(s, table);
}

Rows parameter_table(const UncertaintyStudy& s) {
  return table_of("parameters", "Tolerances", s.parameters)
      .text_in(2)
      .column("path", "key", [](const Tolerated& t) { return t.given().path; })
      .column("words", "value", [](const Tolerated& t) { return t.in_words(); })
      .only_for_programs("value", [](const Tolerated& t) { return t.given().value; })
      .only_for_programs("deviation", [](const Tolerated& t) { return t.deviation(); })
      .only_for_programs("unit", [](const Tolerated& t) { return t.given().unit; })
      .only_for_programs("cut_off", [](const Tolerated& t) { return t.cut_off(); });
}

// Whether the plot of one would repeat that of the other.
bool alike(const FigureUncertainty& a, const FigureUncertainty& b) {
  constexpr double within = 1e-2;
  const auto near = [](double x, double y) { return std::abs(x - y) <= within * std::max(std::abs(x), std::abs(y)); };
  if (a.figure.unit != b.figure.unit || a.shares.size() != b.shares.size() || a.biases.size() != b.biases.size())
    return false;
  return near(a.value, b.value) && near(a.deviation().value, b.deviation().value) &&
         std::equal(a.shares.begin(), a.shares.end(), b.shares.begin(), [&](const auto& x, const auto& y) {
           return x.parameter == y.parameter && near(x.deviation.value, y.deviation.value);
         });
}

// Numerical error, inputs and biases side by side, in percent of the value.
std::vector<Plot> pictures(const UncertaintyStudy& s) {
  std::vector<Plot> plots;
  std::vector<const FigureUncertainty*> drawn;
  for (const FigureUncertainty& f : s.figures) {
    if (!(std::abs(f.value) > 0) || !(f.by_gradients.value > 0) || plots.size() >= 6) continue;
    if (std::any_of(drawn.begin(), drawn.end(), [&f](const auto* other) { return alike(*other, f); })) continue;
    drawn.push_back(&f);
    const double percent = 100 / std::abs(f.value);
    Plot plot{.title = fmt::format("What makes {} uncertain", f.figure.name),
              .x = {.label = "where it comes from"},
              .y = {"of its value", "%"},
              .note = {},
              .bars = true};
    double at = 1;
    const auto bar = [&](const std::string& name, Role role, double height) {
      plot.series.push_back({.name = name, .role = role, .x = {at++}, .y = {height}});
      plot.x.names.push_back(name);
    };
    bar("numerical error", Role::reference, percent * f.error.value_or(0));
    bar("all tolerances, one deviation", Role::elastic, percent * f.deviation().value);
    for (std::size_t k = 0; k < f.shares.size() && k < 4; ++k)
      bar("tolerance of " + s.parameters[f.shares[k].parameter].given().path, Role::sky,
          percent * f.shares[k].deviation.value);
    for (const FigureUncertainty& other : s.figures)
      if (&other != &f && alike(f, other))
        plot.note += (plot.note.empty() ? "The same within 1 %: " : ", ") + other.figure.name;
    for (const Bias& b : f.biases) bar("bias, off: " + b.effect, Role::vermillion, percent * b.value);
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace

Findings findings_of(const UncertaintyStudy& s) {
  Findings f = Findings::of(s, "Uncertainty by tolerances, numerical errors and known biases");
  f.conclude(s.complete, s.conclusion);
  f.claim(share_claims(s.limits, s.failed, s.drawn));
  for (const FigureUncertainty& figure : s.figures)
    if (figure.by_gradients.value > 0 && f.figures.size() < 4) {
      const std::string& unit = figure.figure.unit;
      const bool is_speed = unit == "rad/s";
      const double size = is_speed ? s.speed_unit.size : 1, value = figure.value / size;
      const double spread = 2 * figure.deviation().value / size;
      // As many digits as two of the spread have.
      constexpr int most_digits = 6;
      const double parts = spread > 0 ? std::clamp(std::abs(value) / spread, 1.0, 1e6) : 1e6;
      const int digits = std::min(2 + static_cast<int>(std::ceil(std::log10(parts))), most_digits);
      const ReadableUnit shown = unit_on_tile(value, is_speed ? s.speed_unit.name : unit);
      f.figures.push_back(
          {{value},
           figure.figure.name,
           is_speed ? s.speed_unit.name : unit,
           fmt::format("± {}{}: two deviations of the tolerances", rounded_number(shown.factor * spread, 2),
                       shown.unit.empty() ? "" : " " + pretty_unit(shown.unit)),
           digits,
           figure.figure.name});
    }
  const Chapter limits = f.chapter("Limits"), figures = f.chapter("Figures"),
                shares = f.chapter("Which tolerance matters"), biases = f.chapter("Known biases"),
                given = f.chapter("Tolerances");
  if (!s.limits.empty())
    f.say(limits, limit_table("How sure each limit holds", s.limits, "failed", "probability from [%]"));
  f.say(figures, figure_table(s));
  f.draw(figures, [&s] { return pictures(s); });
  f.say(shares, share_table(s));
  f.say(biases, bias_table(s));
  f.say(given, parameter_table(s));
  f.record("drawn", s.drawn);
  f.record("failed", s.failed);
  f.note(given, s.notes);
  f.show_scene(s.scene_file, s.scene_text);
  return f;
}

}  // namespace kurbel
