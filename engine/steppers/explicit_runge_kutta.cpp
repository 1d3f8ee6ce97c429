// explicit_runge_kutta.cpp — step, error estimate, step-size control and dense output of explicit embedded methods.
#include "engine/steppers/explicit_runge_kutta.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/numerics/deadline.h"

namespace kurbel {
namespace {

// Measured on a slider-crank, whose local error varies over every turn: with 0.85 and a little proportional control
// both methods reject 1…4 % of the steps on average; the customary 0.9 without it rejects 40 % for order 8 and costs 10
// % more.
constexpr double safety = 0.85;
constexpr double rounding = std::numeric_limits<double>::epsilon();

// A combination made ready for the loop over the states: pointers to the slopes that take part, weights times h.
// The number of terms is known to the compiler, so the inner sum is straight-line code and nothing is stored on the
// way.
template <std::size_t terms>
struct Gathered {
  std::array<const double*, terms> slope;
  std::array<double, terms> weight;

  Gathered(const Combination& combination, const Slopes& slopes, double h) {
    for (std::size_t j = 0; j < terms; ++j) {
      slope[j] = slopes[combination[j].stage];
      weight[j] = h * combination[j].weight;
    }
  }
  [[gnu::always_inline]] double operator[](std::size_t i) const { return sum(i, std::make_index_sequence<terms>()); }

 private:
  template <std::size_t... j>
  [[gnu::always_inline]] double sum(std::size_t i, std::index_sequence<j...>) const {
    return (... + (weight[j] * slope[j][i]));
  }
};

struct ErrorNorm {
  double value;
  std::size_t state;  // where it is
};

// max |e_i| w_i. x − x is 0 for a number and NaN for anything else, so `poison` shows without a branch whether a value
// was lost; a maximum alone would overlook NaN. Values out of control (w = 0) poison too: 0·∞ is NaN.
template <std::size_t terms>
ErrorNorm largest_error(std::size_t size, const Gathered<terms>& error, const double* w) {
  double largest = 0, poison = 0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const double e = std::abs(error[i]) * w[i];
    poison += e - e;
    worst = e > largest ? i : worst;
    largest = e > largest ? e : largest;
  }
  return {largest + poison, worst};
}

// Of e_i⁴ / (e_i² + 0.01 r_i²): max e_i² / √(e_i² + 0.01 r_i²).
ErrorNorm largest_of(std::size_t size, const double* squared) {
  double largest = 0, poison = 0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < size; ++i) {
    poison += squared[i] - squared[i];
    worst = squared[i] > largest ? i : worst;
    largest = squared[i] > largest ? squared[i] : largest;
  }
  return {std::sqrt(largest) + poison, worst};
}

std::size_t first_not_finite(const double* values, std::size_t size) {
  return static_cast<std::size_t>(std::find_if(values, values + size, [](double v) { return !std::isfinite(v); }) -
                                  values);
}

// The finer the tolerance, the further below the limit of stability are steps that it holds: what a fast state has left
// over, at last its rounding, counts for more (measured for DOP853: 0.91 of the limit at 1e-8, 0.42 … 0.8 at 1e-14).
// Accuracy alone holds the steps of a motion at that speed far below.
double part_reported_as_stiff(double tolerance) {
  constexpr double least = 0.4, rough = 1e-5, fine = 1e-11;
  const double between = std::clamp(std::log(rough / tolerance) / std::log(rough / fine), 0.0, 1.0);
  return 1 - (1 - least) * between;
}

}  // namespace

ExplicitRungeKutta::ExplicitRungeKutta(const EmbeddedTable& table, OdeSystem& system, const ErrorControl& control)
    : table_(table), system_(system), size_(system.size()), tolerance_(control.tolerance) {
  assert(control.scale.size() == size_ && tolerance_ > 0);
  for (const double s : control.scale) weight_.push_back(s > 0 ? 1 / (tolerance_ * s) : 0);
  weight_.resize(size_ + 4, 0.0);  // slope_sums.h
  stiff_from_ = table.stability_limit * part_reported_as_stiff(tolerance_);
  error_needs_end_slope_ = table.error.back().stage == table.stages;

  // A few doubles between the vectors keep them off the same cache sets when the size is a power of two.
  const std::size_t stride = size_ + 8;
  storage_.assign((3 + table.row.size() + table.dense.size()) * stride, 0.0);
  double* next = storage_.data();
  const auto vector = [&] { return std::exchange(next, next + stride); };
  y_ = vector();
  y_previous_ = vector();
  stage_y_ = vector();
  for (std::size_t i = 0; i < table.row.size(); ++i) slope_[i] = vector();
  for (std::size_t i = 0; i < table.dense.size(); ++i) dense_[i] = vector();
}

void ExplicitRungeKutta::start(double t, std::span<const double> y) {
  assert(y.size() == size_);
  std::copy(y.begin(), y.end(), y_);
  t_ = step_end_ = t;
  evaluate(t, y_, table_.stages);
  stand_still();
  previous_error_ = 1e-4;
  if (std::exchange(started_, true)) ++statistics_.restarts;
  if (!end_slope_is_finite()) fail(0, std::numeric_limits<double>::quiet_NaN());
}

void ExplicitRungeKutta::step(double t_limit) {
  if (!(t_limit > t_))
    throw std::invalid_argument(fmt::format("step to t = {} s, but it is t = {} s already", t_limit, t_));
  if (h_next_ == 0) h_next_ = first_step(t_limit - t_);

  // The end of the last step becomes the beginning of this one.
  t_previous_ = t_;
  std::swap(y_, y_previous_);
  std::swap(slope_[0], slope_[table_.stages]);
  dense_stages_are_ready_ = dense_is_ready_ = false;
  try {
    search_step(t_limit);
  } catch (...) {
    std::copy(y_previous_, y_previous_ + size_, y_);
    std::copy(slope_[0], slope_[0] + size_, slope_[table_.stages]);
    t_ = t_previous_;
    throw;
  }
  step_end_ = t_;
  ++statistics_.steps;
}

// Tries ever shorter steps until one is accurate enough.
void ExplicitRungeKutta::search_step(double t_limit) {
  double h = h_next_;
  const double shortest = 16 * rounding * std::max(std::abs(t_previous_), h);
  for (bool rejected = false;; rejected = true) {
    const Aim goal = aim(h, t_limit);
    take(goal.h);
    if (error_needs_end_slope_) evaluate(goal.t, y_, table_.stages);
    const double error = error_norm(goal.h);
    if (error <= 1) {
      if (!error_needs_end_slope_) evaluate(goal.t, y_, table_.stages);
      if (end_slope_is_finite()) {
        t_ = stages_end_ = goal.t;
        watch_stability(goal.h);
        adapt(error, goal, rejected);
        return;
      }
    }
    ++statistics_.rejected;
    Deadline::check();
    const double factor = error > 1 && std::isfinite(error)
                              ? std::max(table_.smallest_factor, safety * std::pow(error, -table_.integral_exponent))
                              : 0.5;
    h = goal.h * factor;
    if (!(h > shortest)) fail(h, error);  // of a step that begins near the least of numbers: 0
  }
}

// Lands on t_limit when it is near, and halves the way to it when one step is too few, so that no crumb is left over.
ExplicitRungeKutta::Aim ExplicitRungeKutta::aim(double h, double t_limit) const {
  const double remaining = t_limit - t_previous_;
  if (1.01 * h >= remaining) return {t_limit, remaining, h > remaining};
  const bool halve = 2 * h > remaining;
  const double t_end = t_previous_ + (halve ? 0.5 * remaining : h);
  return {t_end, t_end - t_previous_, halve};  // h as the clock sees it: no drift between time and state
}

void ExplicitRungeKutta::retake(double t) {
  if (t == t_) return;
  if (!(t <= step_end_))
    throw std::invalid_argument(fmt::format("retake to t = {} s, beyond the step's end {} s", t, step_end_));
  if (std::abs(t - t_) <= 1e-5 * (t - t_previous_)) {
    nudge(t);
  } else {
    t_ = stages_end_ = std::max(t, t_previous_);
    take(t_ - t_previous_);
  }
  dense_stages_are_ready_ = dense_is_ready_ = false;
  evaluate(t_, y_, table_.stages);
  if (!end_slope_is_finite()) fail(t_ - t_previous_, std::numeric_limits<double>::quiet_NaN());
}

// The end of a step moves by a small part of it: Heun's rule, whose error is that part cubed.
void ExplicitRungeKutta::nudge(double t) {
  const double half = 0.5 * (t - t_);
  const double* const f = slope_[table_.stages];
  for (std::size_t i = 0; i < size_; ++i) stage_y_[i] = (y_[i] += half * f[i]) + half * f[i];
  t_ = t;
  evaluate(t, stage_y_, table_.stages);
  for (std::size_t i = 0; i < size_; ++i) y_[i] += half * f[i];
}

void ExplicitRungeKutta::evaluate(double t, const double* y, std::size_t stage) {
  ++statistics_.flow_calls;
  system_.flow(t, {y, size_}, {slope_[stage], size_});
}

void ExplicitRungeKutta::take_stages(double h) {
  for (std::size_t i = 1; i < table_.stages; ++i) {
    combine(size_, y_previous_, table_.row[i], slope_, h, stage_y_);
    evaluate(t_previous_ + table_.node[i] * h, stage_y_, i);
  }
}

void ExplicitRungeKutta::take(double h) {
  take_stages(h);
  combine(size_, y_previous_, table_.row[table_.stages], slope_, h, y_);
}

double ExplicitRungeKutta::error_norm(double h) {
  const auto keep = [&](const ErrorNorm& norm) {
    worst_ = norm.state;
    return norm.value;
  };
  const auto estimate = [&]<std::size_t terms>() {
    return keep(largest_error(size_, Gathered<terms>(table_.error, slope_, h), weight_.data()));
  };
  if (!table_.rough_error.empty()) {
    correct_errors(size_, table_.error, table_.rough_error, slope_, h, weight_.data(), dense_[0]);
    return keep(largest_of(size_, dense_[0]));
  }
  if (table_.error.size() == 4) return estimate.operator()<4>();
  if (table_.error.size() == 6) return estimate.operator()<6>();
  assert(table_.error.size() == 7);
  return estimate.operator()<7>();
}

bool ExplicitRungeKutta::end_slope_is_finite() const {
  const double* f = slope_[table_.stages];
  double poison = 0;
  for (std::size_t i = 0; i < size_; ++i) poison += f[i] - f[i];
  return poison == 0;
}

// Proportional–integral control (Gustafsson; Hairer–Wanner II, IV.2). A step cut short by t_limit says nothing against
// the step wished for before, and a rejection forbids growth.
void ExplicitRungeKutta::adapt(double error, const Aim& done, bool after_rejection) {
  double factor = safety * std::pow(error, -table_.integral_exponent);  // ∞ for an error of 0
  if (table_.proportional_exponent > 0) factor *= std::pow(previous_error_, table_.proportional_exponent);
  limit_ = done.cut                                                      ? StepLimit::By::end
           : held_by_stability()                                         ? StepLimit::By::stability
           : !after_rejection && factor >= 0.999 * table_.largest_factor ? StepLimit::By::growth
                                                                         : StepLimit::By::accuracy;
  factor = std::clamp(factor, table_.smallest_factor, after_rejection ? 1.0 : table_.largest_factor);
  const double h = done.h * factor;
  h_next_ = done.cut && !after_rejection ? std::max(h, h_next_) : h;
  previous_error_ = std::max(error, 1e-4);
}

// h·ρ from the difference of two states at the end of the step and of the slopes there (Hairer–Wanner II, eq. IV.2.26).
void ExplicitRungeKutta::watch_stability(double h) {
  const double* f = slope_[table_.stages];
  const double* g = slope_[table_.stages - 1];
  double slopes = 0, states = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    const double df = weight_[i] * (f[i] - g[i]), dy = weight_[i] * (y_[i] - stage_y_[i]);
    slopes += df * df;
    states += dy * dy;
  }
  const bool stiff = h * h * slopes > stiff_from_ * stiff_from_ * states;
  if (stiff) {
    mild_steps_ = 0;
    stiff_steps_ = std::min(stiff_steps_ + 1, stiff_steps_to_report);
  } else if (++mild_steps_ >= mild_steps_to_forget) {
    stiff_steps_ = 0;
  }
}

// Hairer–Nørsett–Wanner II.4 with the scales as measure of size: the slope moves no state by more than 1 % of its
// scale, and the second derivative, estimated by a small Euler step, keeps the error of the method within the tolerance.
double ExplicitRungeKutta::first_step(double longest) {
  if (!std::isfinite(longest)) longest = 1;
  const double* f = slope_[table_.stages];
  double* trial = slope_[1];
  const auto size_in_scales = [&](auto&& value) {
    double largest = 0;
    for (std::size_t i = 0; i < size_; ++i) largest = std::max(largest, std::abs(value(i)) * weight_[i] * tolerance_);
    return largest;
  };
  const double speed = size_in_scales([&](std::size_t i) { return f[i]; });
  double h = speed > 0 ? std::min(0.01 / speed, longest) : 1e-3 * longest;
  double bend = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt < 20; ++attempt, h *= 0.1) {
    for (std::size_t i = 0; i < size_; ++i) stage_y_[i] = y_[i] + h * f[i];
    evaluate(t_ + h, stage_y_, 1);
    if (first_not_finite(trial, size_) < size_) continue;
    bend = size_in_scales([&](std::size_t i) { return trial[i] - f[i]; }) / h;
    break;
  }
  const double sharpest = std::max(speed, bend);
  if (!std::isfinite(sharpest)) return h;
  const double accurate = std::pow(0.01 * tolerance_ / sharpest, 1.0 / static_cast<double>(table_.order));
  return std::min({100 * h, accurate, longest});  // `accurate` is ∞ when nothing moves
}

void ExplicitRungeKutta::prepare_dense_stages() {
  if (std::exchange(dense_stages_are_ready_, true)) return;
  dense_state_ = size_;
  const double h = t_ - t_previous_;
  if (std::abs(t_ - stages_end_) > 0.1 * tolerance_ * h) take_stages(h), stages_end_ = t_;
  for (std::size_t i = table_.stages + 1; i < table_.row.size(); ++i) {
    combine(size_, y_previous_, table_.row[i], slope_, h, stage_y_);
    evaluate(t_previous_ + table_.node[i] * h, stage_y_, i);
  }
}

void ExplicitRungeKutta::prepare_dense_output() {
  if (std::exchange(dense_is_ready_, true)) return;
  prepare_dense_stages();
  for (std::size_t d = 0; d < table_.dense.size(); ++d)
    sum_up(size_, table_.dense[d], slope_, t_ - t_previous_, dense_[d]);
}

DensePlace ExplicitRungeKutta::place_of(double t) const {
  const double h = t_ - t_previous_, x = (t - t_previous_) / h;
  return {h, x, 1 - x};
}

// Of one state alone: an observer of the speed of a link needs no more in most steps.
const std::array<double, 4>& ExplicitRungeKutta::dense_of(std::size_t state) {
  prepare_dense_stages();
  if (std::exchange(dense_state_, state) == state) return dense_of_;
  const double h = t_ - t_previous_;
  for (std::size_t d = 0; d < table_.dense.size(); ++d) {
    double sum = 0;
    for (const Term& term : table_.dense[d]) sum += term.weight * slope_[term.stage][state];
    dense_of_[d] = sum * h;
  }
  return dense_of_;
}

void ExplicitRungeKutta::interpolate(double t, std::span<double> y) {
  if (t >= t_) return void(std::copy(y_, y_ + size_, y.begin()));
  if (t <= t_previous_) return void(std::copy(y_previous_, y_previous_ + size_, y.begin()));
  prepare_dense_output();
  const DenseStep step{y_previous_, y_, slope_[0], slope_[table_.stages], dense_, table_.dense.size()};
  kurbel::interpolate(size_, step, place_of(t), y.data());
}

double ExplicitRungeKutta::interpolate(double t, std::size_t state) {
  if (t >= t_) return y_[state];
  if (t <= t_previous_) return y_previous_[state];
  const std::array<double, 4>& dense = dense_of(state);
  const DensePlace place = place_of(t);
  double y = 0;
  for (std::size_t d = table_.dense.size(); d-- > 0;) y = dense[d] + place.weight(d) * y;
  place.end(y_previous_[state], y_[state], slope_[0][state], slope_[table_.stages][state], y);
  return y;
}

// A step of no length at t_: what start() leaves behind.
void ExplicitRungeKutta::stand_still() {
  t_previous_ = t_;
  std::copy(y_, y_ + size_, y_previous_);
  std::copy(slope_[table_.stages], slope_[table_.stages] + size_, slope_[0]);
}

// Blames the state whose slope was lost first, for the loss spreads to others; else the one with the largest error.
void ExplicitRungeKutta::fail(double h, double error) const {
  for (std::size_t stage = 0; stage <= table_.stages; ++stage) {
    const std::size_t state = first_not_finite(slope_[stage], size_);
    if (state == size_) continue;
    throw StepFailure(fmt::format("{}: after t = {:.17g} s the rate of state {} is {} however short the step",
                                  table_.name, t_previous_, state, slope_[stage][state]),
                      t_previous_, state, true);
  }
  throw StepFailure(fmt::format("{}: at t = {:.17g} s the step had to shrink to {:.2g} s, and the error of state {} "
                                "was still {:.3g} times the tolerance; is there a jump in the equations?",
                                table_.name, t_previous_, h, worst_, error),
                    t_previous_, worst_, false);
}

}  // namespace kurbel
