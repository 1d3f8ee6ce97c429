// sweep_matrix.cpp — parameters and figures against one another in pairs: a matrix of scatter plots in one picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/sweep/sweep_plots.h"

namespace kurbel {
namespace {

constexpr std::size_t most_dots = 300, most_parameters = 4, most_figures = 3;

// A parameter or a figure, by its share of the way from its least to its greatest value.
struct Variable {
  std::string name;
  std::vector<double> at;  // 0 … 1; NaN: it has none there
};

Variable variable_of(std::string name, const std::vector<const SweepRow*>& rows, const auto& value) {
  Variable v{.name = std::move(name), .at = {}};
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  for (const SweepRow* r : rows) {
    v.at.push_back(value(*r));
    if (std::isfinite(v.at.back())) least = std::min(least, v.at.back()), greatest = std::max(greatest, v.at.back());
  }
  for (double& x : v.at) x = greatest > least ? (x - least) / (greatest - least) : std::nan("");
  return v;
}

// Of many rows some hundred, evenly taken.
std::vector<const SweepRow*> some_of(const std::vector<SweepRow>& all) {
  std::vector<const SweepRow*> rows;
  const std::size_t step = std::max<std::size_t>(1, (all.size() + most_dots - 1) / most_dots);
  for (std::size_t i = 0; i < all.size(); i += step) rows.push_back(&all[i]);
  return rows;
}

std::vector<Variable> variables_of(const SweepStudyResult& s, const std::vector<const SweepRow*>& rows) {
  std::vector<Variable> list;
  const std::vector<std::size_t> figures = figures_drawn(s);
  std::vector<std::size_t> parameters;
  if (!figures.empty()) parameters = parameters_for(s, figures.front());
  for (std::size_t k = 0; k < parameters.size() && k < most_parameters; ++k)
    list.push_back(variable_of(s.identity.parameters[parameters[k]].path, rows,
                               [&](const SweepRow& r) { return r.parameters[parameters[k]]; }));
  for (std::size_t k = 0; k < figures.size() && k < most_figures; ++k)
    list.push_back(variable_of(s.identity.figures[figures[k]].name, rows,
                               [&](const SweepRow& r) { return value_in(r, figures[k]); }));
  return list;
}

// Which limits a row keeps, all told: 0 all hold, 1 one is undecided, 2 one is beyond or not known.
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
  const std::vector<const SweepRow*> rows = some_of(s.rows);
  const std::vector<Variable> variables = variables_of(s, rows);
  const std::size_t n = variables.size();
  if (n < 3 || rows.size() < 5) return {};
  const auto series = [](const char* name, Role role) {
    return Series{.name = name, .role = role, .x = {}, .y = {}, .points = true, .line = false};
  };
  std::vector<Series> dots = {series(s.limits.empty() ? "variants" : "all limits hold", Role::elastic),
                              series("one within its error", Role::orange), series("one beyond", Role::vermillion)};
  for (std::size_t column = 0; column + 1 < n; ++column)
    for (std::size_t row = column + 1; row < n; ++row)
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const double x = variables[column].at[i], y = variables[row].at[i];
        if (!std::isfinite(x) || !std::isfinite(y)) continue;
        Series& to = dots[verdict_on(s, *rows[i])];
        to.x.push_back(static_cast<double>(column) + 1 + 0.84 * (x - 0.5));
        to.y.push_back(static_cast<double>(n - row) + 0.84 * (y - 0.5));
        to.labels.push_back(fmt::format("row {}", rows[i]->row)), to.sizes.push_back(0.5);
      }
  Plot plot{.title = "Parameters and figures in pairs", .x = {.label = ""}, .y = {.label = ""}, .series = {}};
  for (std::size_t k = 0; k + 1 < n; ++k)
    plot.x.names.push_back(variables[k].name), plot.y.names.push_back(variables[n - 1 - k].name);
  for (Series& d : dots)
    if (!d.x.empty()) plot.series.push_back(std::move(d));
  plot.note = fmt::format("Each tile from the least to the greatest value; {} of {} rows.", rows.size(), s.rows.size());
  plot.wide = true;
  return {std::move(plot)};
}

}  // namespace kurbel
