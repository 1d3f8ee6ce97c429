// accuracy_plots.cpp — work-precision diagrams with their Pareto fronts.
#include "studies/accuracy/accuracy_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/find_by.h"
#include "engine/scene/units.h"

namespace kurbel {
namespace {

// Explicit methods solid, implicit ones dashed.
struct Style {
  const char* method;
  Role role;
  bool dashed;
};
constexpr Style styles[] = {{"work", Role::rigid, false},           {"dopri5", Role::sky, false},
                            {"verner6", Role::green, false},        {"dop853", Role::elastic, false},
                            {"fehlberg8", Role::purple, false},     {"adams", Role::orange, false},
                            {"bdf", Role::vermillion, true},        {"esdirk3", Role::green, true},
                            {"esdirk", Role::elastic, true},        {"esdirk5", Role::purple, true},
                            {"RungeKuttaMerson", Role::sky, false}, {"RungeKuttaFeldberg", Role::orange, false},
                            {"CPodes", Role::vermillion, false}};
Style style_of(const std::string& method) {
  for (const Style& s : styles)
    if (method == s.method) return s;
  return {"", Role::reference, false};
}

std::string label_of(const AccuracyStudy& study, const MeasuredSetting& s) {
  return fmt::format("{}: {}, {} steps", study.name_of(s), with_unit(s.seconds, "s", 3), s.steps);
}

// One line per method of a level, loose to tight.
template <class Error>
std::vector<Series> method_series(const AccuracyStudy& study, std::size_t level, Error error) {
  std::vector<Series> all;
  for (const MeasuredSetting& s : study.settings) {
    if (s.level != level || !(error(s) > 0)) continue;
    auto* found = find_by(all, &Series::name, s.method);
    if (!found) {
      const Style style = style_of(s.method);
      all.push_back({.name = s.method, .role = style.role, .dashed = style.dashed, .points = true});
      found = &all.back();
    }
    found->add(error(s), 1e3 * s.seconds);
    found->labels.push_back(label_of(study, s));
  }
  return all;
}

// The settings of a front, joined in the order of time.
template <class Member, class Error>
Series front_series(const AccuracyStudy& study, Member wanted, Error error) {
  std::vector<const MeasuredSetting*> front;
  for (const MeasuredSetting& s : study.settings)
    if (wanted(s) && error(s) > 0) front.push_back(&s);
  std::sort(front.begin(), front.end(),
            [](const MeasuredSetting* a, const MeasuredSetting* b) { return a->seconds < b->seconds; });
  Series series{.name = "Pareto front", .role = Role::reference, .dashed = true, .points = false};
  for (const MeasuredSetting* s : front) {
    series.add(error(*s), 1e3 * s->seconds);
    series.labels.push_back(label_of(study, *s));
  }
  return series;
}

Role level_role(std::size_t level, std::size_t fullest) {
  return level == 0 ? Role::rigid : level == fullest ? Role::elastic : further_role(level - 1);
}

Plot work_precision(const AccuracyStudy& study, std::size_t level) {
  const auto error = [](const MeasuredSetting& s) { return s.trajectory_error; };
  const ModelLevel& m = study.levels[level];
  Plot plot{.title = fmt::format("What the motion's accuracy costs, {}", m.called),
            .x = {"largest error of the motion", "", true},
            .y = {"processor time", "ms", true},
            .series = method_series(study, level, error)};
  plot.series.push_back(front_series(
      study, [&](const MeasuredSetting& s) { return s.level == level && s.on_level_front; }, error));
  plot.note = fmt::format(
      "Angles in rad, speeds and twists over their largest value. {} and {} agree to {:.1e}: nothing "
      "is drawn to the left of that. Solid: explicit; dashed: implicit.",
      m.first, m.second, m.agreement);
  return plot;
}

Plot figure_cost(const AccuracyStudy& study, std::size_t figure) {
  const auto error = [&](const MeasuredSetting& s) { return s.numerical_error[figure]; };
  const ModelLevel& m = study.levels[study.own];
  Plot plot{.title = fmt::format("What {} costs, {}", study.figures[figure].name, m.called),
            .x = {"numerical error", "relative", true},
            .y = {"processor time", "ms", true},
            .series = method_series(study, study.own, error)};
  plot.note = fmt::format("Nothing is drawn below {:.1e}, to which the references agree.", m.floor[figure]);
  return plot;
}

// The settings of every model.
template <class X, class Y>
void add_levels(const AccuracyStudy& study, const X& x, const Y& y, Plot& plot) {
  for (std::size_t level = 0; level < study.levels.size(); ++level) {
    Series series{.name = study.levels[level].name, .role = level_role(level, study.fullest), .line = false};
    for (const MeasuredSetting& s : study.settings) {
      if (s.level != level || !(x(s) > 0)) continue;
      series.add(x(s), y(s));
      series.labels.push_back(label_of(study, s));
    }
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  }
}

// Every setting by its numerical error and its model error: right of the diagonal the numerical error dominates, left
// of it the model error, and a tighter tolerance is useless.
Plot error_plane(const AccuracyStudy& study) {
  const std::size_t k = study.key;
  Plot plot{.title = fmt::format("Error of the model against error of the numbers: {}", study.figures[k].name),
            .x = {"numerical error", "relative", true},
            .y = {"error of the model", "relative", true}};
  const double floor = study.levels[study.fullest].floor[k];
  add_levels(
      study, [&](const MeasuredSetting& s) { return s.numerical_error[k]; },
      [&](const MeasuredSetting& s) { return std::max(study.levels[s.level].model_error[k], floor); }, plot);
  double low = HUGE_VAL, high = 0;
  for (const Series& series : plot.series)
    for (const std::vector<double>& values : {series.x, series.y})
      for (const double value : values) low = std::min(low, value), high = std::max(high, value);
  plot.series.push_back({.name = "numerical error as large as the model's",
                         .role = Role::reference,
                         .x = {low, high},
                         .y = {low, high},
                         .dashed = true});
  plot.note = fmt::format(
      "Above the diagonal the model is coarser than the numbers: a tighter tolerance is wasted there. "
      "The {}, which the others are judged by, lies at {:.1e}, to which its references agree.",
      study.levels[study.fullest].called, floor);
  return plot;
}

Plot total_cost(const AccuracyStudy& study) {
  const std::size_t k = study.key;
  const auto error = [&](const MeasuredSetting& s) { return s.total_error[k]; };
  Plot plot{
      .title = fmt::format("Total error and processor time, model and numbers together: {}", study.figures[k].name),
      .x = {"total error", "relative", true},
      .y = {"processor time", "ms", true}};
  add_levels(
      study, error, [](const MeasuredSetting& s) { return 1e3 * s.seconds; }, plot);
  plot.series.push_back(front_series(
      study, [](const MeasuredSetting& s) { return s.on_front; }, error));
  plot.note = fmt::format("Against the converged {}.", study.levels[study.fullest].called);
  return plot;
}

}  // namespace

std::vector<Plot> total_plots(const AccuracyStudy& study) {
  std::vector<Plot> plots = {total_cost(study)};
  if (study.levels.size() > 1) plots.push_back(error_plane(study));
  return plots;
}

std::vector<Plot> motion_cost_plots(const AccuracyStudy& study) {
  std::vector<Plot> plots;
  for (std::size_t level = 0; level < study.levels.size(); ++level)
    if (std::count_if(study.settings.begin(), study.settings.end(),
                      [&](const MeasuredSetting& s) { return s.level == level; }) > 1)
      plots.push_back(work_precision(study, level));
  return plots;
}

std::vector<Plot> figure_cost_plots(const AccuracyStudy& study) {
  std::vector<Plot> plots;
  for (std::size_t i = 0; i < std::min<std::size_t>(study.figures.size(), 4); ++i)
    plots.push_back(figure_cost(study, i));
  return plots;
}

}  // namespace kurbel
