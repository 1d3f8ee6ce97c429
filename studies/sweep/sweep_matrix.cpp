// sweep_matrix.cpp — pairs of parameters and figures: a matrix of scatter plots in one picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/scene/units.h"
#include "studies/claims/ranges.h"
#include "studies/sweep/sweep_plots.h"

namespace kurbel {
namespace {

constexpr std::size_t most_dots = 2400, most_rows = 4, most_columns = 3;  // dots: in all tiles together

std::string after_number(const std::string& unit) { return unit.empty() ? "" : " " + unit; }

// A parameter or a figure, scaled to its range.
struct Variable {
  std::string name, unit;
  std::function<double(const SweepRow&)> value;
  double least = HUGE_VAL, greatest = -HUGE_VAL, factor = 1;  // over all rows; factor: into `unit`

  double at(const SweepRow& row) const {  // 0 … 1; NaN: it has none there
    return greatest > least ? (value(row) - least) / (greatest - least) : std::nan("");
  }
  std::vector<std::string> words = {};  // what 0, 1, 2 … stand for; none: numbers

  std::string ends() const {
    if (!words.empty()) return fmt::format("{} words", words.size());
    return range_text(factor * least, factor * greatest) + unit;
  }
  std::string text_at(const SweepRow& row) const {
    if (!words.empty()) return name + " " + words.at(static_cast<std::size_t>(value(row)));
    return fmt::format("{} {:.5g}{}", name, factor * value(row), unit);
  }
};

void find_ends(Variable& v, const std::vector<SweepRow>& rows) {
  for (const SweepRow& r : rows)
    if (const double x = v.value(r); std::isfinite(x))
      v.least = std::min(v.least, x), v.greatest = std::max(v.greatest, x);
}

std::vector<Variable> variables_of(const SweepStudyResult& s) {
  std::vector<Variable> list;
  const std::vector<std::size_t> figures = figures_drawn(s);
  std::vector<std::size_t> parameters;
  if (!figures.empty()) parameters = parameters_for(s, figures.front());
  for (std::size_t k = 0; k < parameters.size() && k < most_rows; ++k) {
    const SweptParameter& p = s.identity.parameters[parameters[k]];
    list.push_back({.name = p.path,
                    .unit = after_number(pretty_unit(p.unit)),
                    .value = [at = parameters[k]](const SweepRow& r) { return r.parameters[at]; },
                    .words = p.words});
    find_ends(list.back(), s.rows);
  }
  for (std::size_t k = 0; k < figures.size() && k < most_columns; ++k) {
    const SweptFigure& f = s.identity.figures[figures[k]];
    list.push_back(
        {.name = f.name, .unit = "", .value = [at = figures[k]](const SweepRow& r) { return value_in(r, at); }});
    find_ends(list.back(), s.rows);
    Variable& v = list.back();
    const ReadableUnit unit = readable_unit(std::max(std::abs(v.least), std::abs(v.greatest)), f.unit, s.speed_unit);
    v.unit = after_number(unit.unit), v.factor = unit.factor;
  }
  return list;
}

// Limits of a row together: 0 all hold, 1 one is undecided, 2 one is exceeded or unknown.
std::size_t verdict_on(const SweepStudyResult& s, const SweepRow& row) {
  std::size_t worst = 0;
  for (const FigureLimit& l : s.limits) {
    const Side side = side_of(l, row);
    worst = std::max<std::size_t>(worst, side == Side::holds ? 0 : side == Side::undecided ? 1 : 2);
  }
  return worst;
}

}  // namespace

// Each pair has a tile of 0.84 by 0.84 about whole numbers: the column's variable to the right, the row's upwards.
std::vector<Plot> scatter_matrix(const SweepStudyResult& s) {
  const std::vector<Variable> variables = variables_of(s);
  const std::size_t n = variables.size();
  if (n < 3 || s.rows.size() < 5) return {};
  const std::vector<const SweepRow*> rows = some_rows(s, most_dots / (n * (n - 1) / 2));
  const auto series = [](const char* name, Role role) {
    return Series{.name = name, .role = role, .points = true, .line = false};
  };
  std::vector<Series> dots = {series(s.limits.empty() ? "variants" : "all limits hold", Role::elastic),
                              series("one within its error", Role::orange), series("one beyond", Role::vermillion)};
  for (std::size_t column = 0; column + 1 < n; ++column)
    for (std::size_t row = column + 1; row < n; ++row)
      for (const SweepRow* r : rows) {
        const double x = variables[column].at(*r), y = variables[row].at(*r);
        if (!std::isfinite(x) || !std::isfinite(y)) continue;
        Series& to = dots[verdict_on(s, *r)];
        to.add(static_cast<double>(column) + 1 + 0.84 * (x - 0.5), static_cast<double>(n - row) + 0.84 * (y - 0.5));
        to.labels.push_back(
            fmt::format("row {}: {}, {}", r->row, variables[column].text_at(*r), variables[row].text_at(*r)));
        to.sizes.push_back(0.5);
      }
  Plot plot{.title = "Parameters and figures in pairs", .x = {.label = ""}, .y = {.label = ""}};
  for (std::size_t k = 0; k + 1 < n; ++k)
    for (const auto& [axis, v] : {std::pair(&plot.x, &variables[k]), std::pair(&plot.y, &variables[n - 1 - k])})
      axis->names.push_back(v->name + "\n" + v->ends());
  for (Series& d : dots)
    if (!d.x.empty()) plot.series.push_back(std::move(d));
  for (Axis* axis : {&plot.x, &plot.y}) axis->least = 0.5, axis->greatest = static_cast<double>(n) - 0.5;
  plot.note = fmt::format("Each tile from the least to the greatest value; {} of {} rows.", rows.size(), s.tally.rows);
  plot.wide = true;
  return {std::move(plot)};
}

}  // namespace kurbel
