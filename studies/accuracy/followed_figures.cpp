// followed_figures.cpp — the figures followed by the study of accuracy, and their errors.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "studies/accuracy/accuracy_work.h"
#include "studies/dictionary/dictionary.h"
#include "studies/findings/figure_changes.h"

namespace kurbel {
namespace {

// Peaks first, the largest one before all; then the other figures in this order.
std::vector<const Figure*> worth_following(const Result& full, const Model& model,
                                           const std::vector<std::string>& wanted) {
  std::vector<const Figure*> peaks, others;
  const auto valid = [](const Figure& f) {
    return std::abs(f.value) > 1e-9 * std::max(f.scale, 1e-300) && f.error && std::isfinite(*f.error);
  };
  for (const Figure& f : full.figures)
    if (valid(f) && f.what == quantities::peak_torque) peaks.push_back(&f);
  for (const QuantityKind& what :
       {quantities::delta, quantities::cycle_fluctuation, quantities::run_up_time, quantities::final_angle,
        quantities::final_speed, quantities::max_speed, quantities::peak_force})
    for (const Figure& f : full.figures)
      if (valid(f) && f.what == what && (what.functional != Functional::last || f.of == link_of(model)))
        others.push_back(&f);
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Figure* a, const Figure* b) { return std::abs(a->value) > std::abs(b->value); });
  if (peaks.size() > 3) peaks.resize(3);
  peaks.insert(peaks.end(), others.begin(), others.end());
  for (auto name = wanted.rbegin(); name != wanted.rend(); ++name) {
    const Figure* asked = full.find(*name);
    if (!asked) {
      std::vector<std::string> names;
      for (const Figure& f : full.figures) names.push_back(f.name);
      const std::string instead = stated_instead(*name, names);
      throw std::invalid_argument(fmt::format("--figures \"{}\": the scene yields no such figure; {}", *name,
                                              instead.empty() ? fmt::format("it yields {}", fmt::join(names, ", "))
                                                              : fmt::format("what it yields is \"{}\"", instead)));
    }
    std::erase(peaks, asked);
    peaks.insert(peaks.begin(), asked);
  }
  peaks.resize(std::min(peaks.size(), std::max<std::size_t>(8, wanted.size())));
  return peaks;
}

}  // namespace

void follow_figures(AccuracyWork& work) {
  const LevelAtWork& full = work.levels[work.study.fullest];
  for (const Figure* f : worth_following(full.reference, *full.model, work.options.figures))
    work.study.figures.push_back({f->name, f->unit});
  for (LevelAtWork& level : work.levels)
    for (const FollowedFigure& followed : work.study.figures) {
      const Figure* f = like_in(level.reference, *full.reference.find(followed.name));
      const bool valid = f && f->error && std::isfinite(*f->error) && f->value != 0;
      level.reported.value.push_back(valid ? f->value : not_known);
      // Two runs may agree by chance: never below their tolerance.
      level.reported.floor.push_back(valid ? std::max(*f->error / std::abs(f->value), reference_tolerance) : not_known);
    }
}

void measure_figures(MeasuredSetting& s, const AccuracyWork& work, const LevelAtWork& level,
                     const std::function<double(const std::string&)>& value) {
  const ModelLevel& full = work.levels[work.study.fullest].reported;
  for (std::size_t i = 0; i < work.study.figures.size(); ++i) {
    const double v = value(work.study.figures[i].name), reference = level.reported.value[i];
    s.numerical_error.push_back(std::max(std::abs(v / reference - 1), level.reported.floor[i]));
    s.total_error.push_back(std::max(std::abs(v / full.value[i] - 1), full.floor[i]));
    if (std::isnan(v) || std::isnan(reference)) s.numerical_error.back() = not_known;
    if (std::isnan(v)) s.total_error.back() = not_known;
  }
}

void fill_model_errors(AccuracyStudy& study) {
  const ModelLevel full = study.levels[study.fullest];
  for (ModelLevel& level : study.levels)
    for (std::size_t i = 0; i < study.figures.size(); ++i)
      level.model_error.push_back(
          &level == &study.levels[study.fullest] ? 0 : std::abs(level.value[i] / full.value[i] - 1));
}

}  // namespace kurbel
