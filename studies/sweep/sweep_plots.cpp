// sweep_plots.cpp — plots of a sweep; of many rows a random sample of some thousand.
#include "studies/sweep/sweep_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/find_by.h"
#include "engine/scene/units.h"
#include "studies/claims/ranges.h"
#include "studies/findings/thin.h"

namespace kurbel {
namespace {

constexpr std::size_t most_points = 2000, most_figures = 4, most_parameters = 3;

Axis axis_of(const SweptParameter& p) { return {p.path, pretty_unit(p.unit)}; }

std::string label_of(const SweepStudyResult& s, const SweepRow& r) {
  std::string label = fmt::format("row {}", r.row);
  for (std::size_t k = 0; k < r.parameters.size(); ++k)
    label += fmt::format(", {} = {}", s.identity.parameters[k].path, s.identity.parameters[k].text_of(r.parameters[k]));
  return label;
}

std::vector<const SweepRow*> shown(const SweepStudyResult& s) { return some_rows(s, most_points); }

// For one parameter: the curve with its error band.
void add_curve(Plot& plot, const std::vector<std::pair<const SweepRow*, double>>& points, std::size_t figure,
               double factor) {
  Series curve{.name = "value", .role = Role::elastic, .points = true};
  Series low{.name = "− error", .role = Role::reference, .dashed = true}, high = low;
  high.name = "+ error";
  for (const auto& [row, x] : points) {
    const auto [v, known] = factor * figure_in(*row, figure);
    const double error = known.value_or(0);
    curve.add(x, v);
    low.add(x, v - error);
    high.add(x, v + error);
  }
  plot.series = {std::move(low), std::move(high), std::move(curve)};
}

void add_cloud(Plot& plot, const SweepStudyResult& s, const std::vector<std::pair<const SweepRow*, double>>& points,
               std::size_t figure, double factor) {
  Series cloud{.name = "variants", .role = Role::sky, .points = true, .line = false};
  for (const auto& [row, x] : points) {
    cloud.add(x, factor * value_in(*row, figure));
    cloud.labels.push_back(label_of(s, *row));
  }
  // The mean along the parameter, over equal numbers of rows.
  Series mean{.name = "mean along the parameter", .role = Role::elastic, .points = true};
  // For each value, if there are few; else over equal numbers of rows.
  std::size_t different = 1;
  for (std::size_t i = 1; i < points.size(); ++i) different += points[i].second != points[i - 1].second;
  const std::size_t least = 2 * different <= points.size() ? 1 : std::max<std::size_t>(points.size() / 20, 1);
  for (std::size_t from = 0, to = 0; from < points.size(); from = to) {
    to = std::min(from + least, points.size());
    while (to < points.size() && points[to].second == points[to - 1].second) ++to;
    double x = 0, y = 0;
    for (std::size_t i = from; i < to; ++i) x += points[i].second, y += cloud.y[i];
    mean.add(x / static_cast<double>(to - from), y / static_cast<double>(to - from));
  }
  plot.series = {std::move(cloud), std::move(mean)};
}

// Whether two figures are so closely related that a second plot would repeat the first.
bool alike(const SweepStudyResult& s, std::size_t one, std::size_t other) {
  constexpr double within = 1e-2;
  if (s.identity.figures[one].unit != s.identity.figures[other].unit) return false;
  return std::all_of(s.rows.begin(), s.rows.end(), [&](const SweepRow& row) {
    const double a = value_in(row, one), b = value_in(row, other);
    return std::isfinite(a) == std::isfinite(b) && !(std::abs(a - b) > within * std::max(std::abs(a), std::abs(b)));
  });
}

// "The same within 1 %: peak_spring_torque.shaft.": figures omitted for that reason.
std::string reported_with(const SweepStudyResult& s, std::size_t figure) {
  std::string names;
  for (std::size_t other = 0; other < s.identity.figures.size(); ++other)
    if (other != figure && alike(s, figure, other))
      names += (names.empty() ? "" : ", ") + s.identity.figures[other].name;
  return names.empty() ? "" : "The same within 1 %: " + names + ".";
}

Plot response(const SweepStudyResult& s, std::size_t figure, std::size_t parameter) {
  const SweptFigure& f = s.identity.figures[figure];
  const SweptParameter& p = s.identity.parameters[parameter];
  std::vector<std::pair<const SweepRow*, double>> points;
  double largest = 0;
  for (const SweepRow* r : shown(s))
    if (const double v = value_in(*r, figure); std::isfinite(v))
      points.emplace_back(r, r->parameters[parameter]), largest = std::max(largest, std::abs(v));
  std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const ReadableUnit unit = readable_unit(largest, f.unit, s.speed_unit);
  Plot plot{.title = fmt::format("{} over {}", f.name, p.path), .x = axis_of(p), .y = {f.name, unit.unit}};
  if (s.identity.parameters.size() == 1)
    add_curve(plot, points, figure, unit.factor);
  else
    add_cloud(plot, s, points, figure, unit.factor);
  for (const FigureLimit& l : s.limits)
    if (l.figure == figure && !points.empty())
      plot.series.push_back({.name = limit_in_words(l.given),
                             .role = Role::vermillion,
                             .x = {points.front().second, points.back().second},
                             .y = {unit.factor * l.value, unit.factor * l.value},
                             .dashed = true});
  if (s.tally.rows > most_points) plot.note = fmt::format("{} of {} rows are drawn. ", points.size(), s.tally.rows);
  plot.note += reported_with(s, figure);
  return plot;
}

// Colours if the variants form a grid, each cell the mean over all other parameters; else empty.
std::optional<ColourMap> cells_of(const SweepStudyResult& s, std::size_t figure, std::size_t a, std::size_t b,
                                  const ReadableUnit& unit) {
  const auto values_of = [&](std::size_t parameter) {
    std::vector<double> values;
    for (const SweepRow& r : s.rows) values.push_back(r.parameters[parameter]);
    return distinct(std::move(values));
  };
  const SweptFigure& f = s.identity.figures[figure];
  ColourMap map{.name = f.name, .unit = unit.unit, .x = values_of(a), .y = values_of(b), .z = {}};
  if (map.x.size() < 2 || map.y.size() < 2 || map.x.size() * map.y.size() > s.rows.size()) return std::nullopt;
  std::vector<std::vector<double>> sums(map.y.size(), std::vector<double>(map.x.size(), 0)), counts = sums;
  for (const SweepRow& r : s.rows) {
    const double v = value_in(r, figure);
    if (!std::isfinite(v)) continue;
    const std::size_t i = place_in(map.y, r.parameters[b]), k = place_in(map.x, r.parameters[a]);
    sums[i][k] += v, ++counts[i][k];
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    map.z.emplace_back(map.x.size(), std::nan(""));
    for (std::size_t k = 0; k < map.x.size(); ++k)
      if (counts[i][k] > 0) map.z[i][k] = unit.factor * sums[i][k] / counts[i][k];
  }
  return map;
}

Plot map_of(const SweepStudyResult& s, std::size_t figure, std::size_t a, std::size_t b) {
  const SweptFigure& f = s.identity.figures[figure];
  Plot plot{
      .title = fmt::format("{} over {} and {}", f.name, s.identity.parameters[a].path, s.identity.parameters[b].path),
      .x = axis_of(s.identity.parameters[a]),
      .y = axis_of(s.identity.parameters[b])};
  double largest = 0;
  for (const SweepRow& r : s.rows)
    if (const double v = value_in(r, figure); std::isfinite(v)) largest = std::max(largest, std::abs(v));
  const ReadableUnit unit = readable_unit(largest, f.unit, s.speed_unit);
  const auto add = [&](std::string name, Role role, const auto& belongs) {
    Series series{.name = std::move(name), .role = role, .points = true, .line = false};
    for (const SweepRow* r : shown(s))
      if (belongs(*r)) {
        series.add(r->parameters[a], r->parameters[b]);
        series.labels.push_back(
            fmt::format("{}; {:.6g} {}", label_of(s, *r), unit.factor * value_in(*r, figure), unit.unit));
      }
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  };
  const auto* const limit = find_by(s.limits, &FigureLimit::figure, figure);
  plot.map = cells_of(s, figure, a, b, unit);
  if (plot.map && s.identity.parameters.size() > 2) plot.note = "Colours: mean over all other parameters.";
  if (limit) {
    plot.title += fmt::format(": where {}", limit_in_words(limit->given));
    if (!plot.map) add("holds", Role::green, [&](const SweepRow& r) { return side_of(*limit, r) == Side::holds; });
    add("within its error", Role::orange, [&](const SweepRow& r) { return side_of(*limit, r) == Side::undecided; });
    add("beyond", Role::vermillion, [&](const SweepRow& r) { return side_of(*limit, r) == Side::beyond; });
  } else if (!plot.map) {
    std::vector<double> values;
    for (const SweepRow& r : s.rows)
      if (const double v = value_in(r, figure); std::isfinite(v)) values.push_back(v);
    if (values.empty()) return plot;
    std::sort(values.begin(), values.end());
    const Role roles[] = {Role::purple, Role::elastic, Role::sky, Role::green, Role::orange};
    for (std::size_t fifth = 0; fifth < 5; ++fifth) {
      const double low = values[fifth * (values.size() - 1) / 5], high = values[(fifth + 1) * (values.size() - 1) / 5];
      const std::string name = fmt::format("{} {}", range_text(unit.factor * low, unit.factor * high), unit.unit);
      add(name, roles[fifth], [&](const SweepRow& r) {
        const double v = value_in(r, figure);
        return (fifth == 0 ? v >= low : v > low) && v <= high;
      });
    }
  }
  add("failed", Role::reference, [](const SweepRow& r) { return r.state == RowState::failed; });
  return plot;
}

}  // namespace

std::vector<const SweepRow*> some_rows(const SweepStudyResult& s, std::size_t most) {
  std::vector<const SweepRow*> rows;
  for (const std::size_t i : drawn_by_chance(s.rows.size(), most)) rows.push_back(&s.rows[i]);
  return rows;
}

std::vector<std::size_t> figures_drawn(const SweepStudyResult& s) {
  std::vector<std::size_t> list;
  for (const FigureLimit& l : s.limits)
    if (std::find(list.begin(), list.end(), l.figure) == list.end()) list.push_back(l.figure);
  const auto is_drawn = [&](std::size_t figure) {
    return std::any_of(list.begin(), list.end(),
                       [&](std::size_t drawn) { return drawn == figure || alike(s, drawn, figure); });
  };
  for (const FigureInfluence& f : s.influences)
    if (!f.ranked.empty() && !is_drawn(f.figure)) list.push_back(f.figure);
  if (list.size() > most_figures) list.resize(most_figures);
  return list;
}

std::vector<std::size_t> parameters_for(const SweepStudyResult& s, std::size_t figure) {
  std::vector<std::size_t> list;
  for (const Influence& i : s.influences[figure].ranked) list.push_back(i.parameter);
  for (std::size_t k = 0; k < s.identity.parameters.size(); ++k)
    if (std::find(list.begin(), list.end(), k) == list.end()) list.push_back(k);
  return list;
}

std::vector<Plot> response_plots(const SweepStudyResult& s) {
  std::vector<Plot> plots;
  for (const std::size_t figure : figures_drawn(s)) {
    std::vector<std::size_t> parameters = parameters_for(s, figure);
    if (parameters.size() > most_parameters) parameters.resize(most_parameters);
    for (const std::size_t p : parameters) plots.push_back(response(s, figure, p));
  }
  return plots;
}

std::vector<Plot> limit_maps(const SweepStudyResult& s) {
  std::vector<Plot> plots;
  if (s.identity.parameters.size() < 2) return plots;
  for (const std::size_t figure : figures_drawn(s)) {
    const std::vector<std::size_t> parameters = parameters_for(s, figure);
    plots.push_back(map_of(s, figure, parameters[0], parameters[1]));
  }
  return plots;
}

std::vector<Plot> influence_plots(const SweepStudyResult& s) {
  std::vector<Plot> plots;
  for (const std::size_t figure : figures_drawn(s)) {
    const FigureInfluence& found = s.influences[figure];
    if (found.ranked.size() < 2) continue;
    Series first{.name = "first order", .role = Role::elastic}, total{.name = "total", .role = Role::orange};
    std::vector<std::string> names;
    for (std::size_t k = 0; k < found.ranked.size(); ++k) {
      const Influence& i = found.ranked[k];
      first.add(static_cast<double>(k + 1), i.first.value);
      names.push_back(s.identity.parameters[i.parameter].path);
      if (i.total) total.add(static_cast<double>(k + 1), i.total->value);
    }
    Plot plot{.title = fmt::format("What moves {}: Sobol's indices", s.identity.figures[figure].name),
              .x = {.label = "parameter", .names = std::move(names)},
              .y = {"share of the variance"},
              .series = {std::move(first)},
              .bars = true};
    if (!total.x.empty()) plot.series.push_back(std::move(total));
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace kurbel
