// figure_changes.cpp — figures of two runs side by side.
#include "studies/findings/figure_changes.h"

#include <cmath>
#include <utility>

namespace kurbel {
namespace {

constexpr double rounding = 1e-9;  // of a rated quantity

// Changes of speeds and works are related to the machine's own values: residual vibration at a hundredth of the
// speed, or a loss of a thousandth of the driving work, is insignificant even if its relative change is large.
bool is_judged_by_the_machine(const QuantityKind& what) {
  return is_one_of(what, {quantities::max_speed, quantities::min_speed, quantities::steady_speed, quantities::mid_speed,
                          quantities::mean_speed, quantities::final_speed, quantities::work});
}

}  // namespace

bool is_informative(const Figure& figure) {
  return figure.scale > 0 &&
         (is_judged_by_the_machine(figure.what) ||
          is_one_of(figure.what,
                    {quantities::peak_torque, quantities::delta, quantities::cycle_fluctuation, quantities::run_up_time,
                     quantities::run_down_time, quantities::rms_torque, quantities::slip_heat,
                     quantities::stopping_time, quantities::stopping_angle, quantities::cycle_time}) ||
          figure.words() == "motor_peak_torque" || figure.words() == "motor_rms_torque");
}

bool measure_the_same(const Figure& a, const Figure& b) {
  const auto fluctuates = [](const Figure& f) {
    return is_one_of(f.what, {quantities::delta, quantities::cycle_fluctuation});
  };
  return a.name == b.name || (fluctuates(a) && fluctuates(b) && a.of == b.of);
}

double apart(const Figure& a, const Figure& b) {
  return is_peak(a.what) ? std::abs(std::abs(b.value) - std::abs(a.value)) : std::abs(b.value - a.value);
}

const Figure* like_in(const Result& run, const Figure& figure) {
  const auto found = std::find_if(run.figures.begin(), run.figures.end(),
                                  [&](const Figure& f) { return measure_the_same(f, figure); });
  return found == run.figures.end() ? nullptr : &*found;
}

double error_of(const Figure& figure, const Result& run) {
  return figure.error.value_or(figure.exact ? 0 : std::max(rounding, run.tolerance) * figure.scale);
}

double floor_of(const Figure& figure, const Result& run) { return error_of(figure, run) + rounding * figure.scale; }

std::vector<FigureChange> changes_between(const Result& full, const Result& other,
                                          const std::vector<std::string>& wanted) {
  std::vector<FigureChange> changes;
  for (const Figure& figure : full.figures) {
    if (wanted.empty() ? !is_informative(figure) : !is_asked_for(figure.name, wanted)) continue;
    const Figure* same = like_in(other, figure);
    if (!same) continue;
    const double nothing = floor_of(figure, full);
    if (std::abs(figure.value) <= nothing && std::abs(same->value) <= floor_of(*same, other)) continue;  // both zero
    const double difference = apart(figure, *same);
    const double usual = is_judged_by_the_machine(figure.what) ? figure.scale : 0;
    const double size = std::max({std::abs(figure.value), usual, nothing, 1e-300});
    changes.push_back({figure.name, figure.unit, figure.value, same->value, difference / size,
                       std::abs(figure.value) <= nothing, (error_of(figure, full) + error_of(*same, other)) / size});
  }
  std::stable_sort(changes.begin(), changes.end(), [](const FigureChange& a, const FigureChange& b) {
    return std::pair(a.sure(), a.relative) > std::pair(b.sure(), b.relative);
  });
  return changes;
}

}  // namespace kurbel
