// sundials_common.cpp — the library behind the Stepper interface: maximum norm, checked calls, exceptions kept.
#include "engine/steppers/sundials_common.h"

#include <arkode/arkode.h>
#include <cvode/cvode.h>
#include <sunlinsol/sunlinsol_klu.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/numerics/deadline.h"

namespace kurbel {
namespace {

Owned<SUNContext> new_context() {
  SUNContext context = nullptr;
  must(SUNContext_Create(nullptr, &context), "create its context");
  return Owned<SUNContext>(context);
}

// --- the maximum norm in place of the root mean square, which states at rest dilute ---

// The sum of x − x is 0 unless a value is not finite; a maximum alone would overlook NaN.
double largest_weighted(N_Vector x, N_Vector w) {
  const double *values = N_VGetArrayPointer(x), *weights = N_VGetArrayPointer(w);
  const sunindextype size = N_VGetLength(x);
  double largest = 0, poison = 0;
  for (sunindextype i = 0; i < size; ++i) {
    const double v = std::abs(values[i]) * weights[i];
    poison += v - v;
    largest = v > largest ? v : largest;
  }
  return largest + poison;
}

double largest_weighted_where(N_Vector x, N_Vector w, N_Vector mask) {
  const double *values = N_VGetArrayPointer(x), *weights = N_VGetArrayPointer(w), *on = N_VGetArrayPointer(mask);
  const sunindextype size = N_VGetLength(x);
  double largest = 0, poison = 0;
  for (sunindextype i = 0; i < size; ++i) {
    const double v = on[i] > 0 ? std::abs(values[i]) * weights[i] : 0;
    poison += v - v;
    largest = v > largest ? v : largest;
  }
  return largest + poison;
}

// --- sums, for the compiler to vectorise: the library's own were half of the cost of its steps ---
// Elements of the result may lie where those of the same index of an addend do.

void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z) {
  const double *u = NV_DATA_S(x), *v = NV_DATA_S(y);
  double* out = NV_DATA_S(z);
  const sunindextype size = NV_LENGTH_S(z);
#pragma GCC ivdep
  for (sunindextype i = 0; i < size; ++i) out[i] = a * u[i] + b * v[i];
}

void scale(double c, N_Vector x, N_Vector z) {
  const double* u = NV_DATA_S(x);
  double* out = NV_DATA_S(z);
  const sunindextype size = NV_LENGTH_S(z);
#pragma GCC ivdep
  for (sunindextype i = 0; i < size; ++i) out[i] = c * u[i];
}

int linear_combination(int count, double* c, N_Vector* x, N_Vector z) {
  double* out = NV_DATA_S(z);
  const sunindextype size = NV_LENGTH_S(z);
  constexpr sunindextype width = 8;
  for (sunindextype begin = 0; begin < size; begin += width) {
    const sunindextype end = std::min(begin + width, size);
    double sum[width] = {};
    for (int k = 0; k < count; ++k) {
      const double *addend = NV_DATA_S(x[k]), factor = c[k];
      for (sunindextype i = begin; i < end; ++i) sum[i - begin] += factor * addend[i];
    }
    std::copy(sum, sum + (end - begin), out + begin);
  }
  return 0;
}

// Every vector the library clones from this one inherits norm and sums.
Owned<N_Vector> vector_over(std::vector<double>& values, SUNContext context) {
  const auto size = static_cast<sunindextype>(values.size());
  Owned<N_Vector> v(made(N_VMake_Serial(size, values.data(), context), "vector"));
  v->ops->nvlinearsum = linear_sum;
  v->ops->nvscale = scale;
  v->ops->nvlinearcombination = linear_combination;
  v->ops->nvwrmsnorm = largest_weighted;
  v->ops->nvwrmsnormmask = largest_weighted_where;
  return v;
}

std::string explanation(int flag) {
  static_assert(ARK_ERR_FAILURE == CV_ERR_FAILURE && ARK_CONV_FAILURE == CV_CONV_FAILURE &&
                ARK_LSETUP_FAIL == CV_LSETUP_FAIL && ARK_LSOLVE_FAIL == CV_LSOLVE_FAIL &&
                ARK_TOO_CLOSE == CV_TOO_CLOSE && ARK_TOO_MUCH_ACC == CV_TOO_MUCH_ACC);
  switch (flag) {
    case CV_ERR_FAILURE:
      return "however short the step, its error stayed above the tolerance";
    case CV_CONV_FAILURE:
      return "however short the step, the iteration for its implicit equations did not converge";
    case CV_LSETUP_FAIL:
      return "the linear system of the implicit equations could not be factorised";
    case CV_LSOLVE_FAIL:
      return "the linear system of the implicit equations could not be solved";
    case CV_TOO_MUCH_ACC:
      return "the tolerance requires more digits than the states have";
    case CV_TOO_CLOSE:
      return "the end of the step is within round-off of its beginning";
    default:
      return fmt::format("the solver gave up (code {})", flag);
  }
}

}  // namespace

SundialsStepper::SundialsStepper(OdeSystem& system, const ErrorControl& control)
    : system_(system),
      context_(new_context()),
      y_(system.size()),
      y_previous_(system.size()),
      scratch_values_(system.size()),
      state_(vector_over(y_, context_.get())),
      previous_state_(vector_over(y_previous_, context_.get())),
      scratch_(vector_over(scratch_values_, context_.get())) {
  // The library divides by weights, so a state out of control gets one that no error can make felt.
  for (const double s : control.scale) weight_.push_back(s > 0 ? 1 / (control.tolerance * s) : 1e-100);
  slope_.values.resize(system.size());
  slope_previous_.values.resize(system.size());
}

void SundialsStepper::start(double t, std::span<const double> y) {
  std::copy(y.begin(), y.end(), y_.begin());
  y_previous_ = y_;
  t_ = t_previous_ = step_end_ = t;
  slope_.known = slope_previous_.known = false;
  has_dense_output_ = false;
  restart_ = true;
  if (std::exchange(started_, true)) ++statistics_.restarts;
  lost_state_.reset();
  known(slope_, t_, y_);
  for (std::size_t i = 0; i < y_.size(); ++i) {
    if (std::isfinite(slope_.values[i])) continue;
    lost_state_ = i;
    fail(CV_FIRST_RHSFUNC_ERR);
  }
}

void SundialsStepper::step(double t_limit) {
  if (!(t_limit > t_))
    throw std::invalid_argument(fmt::format("step to t = {} s, but it is t = {} s already", t_limit, t_));
  t_previous_ = t_;
  y_previous_ = y_;
  std::swap(slope_, slope_previous_);
  slope_.known = false;
  lost_state_.reset();
  message_.clear();
  try {
    if (t_limit - t_ < 1000 * epsilon * std::max(std::abs(t_), std::abs(t_limit)))
      jump(t_limit);
    else
      advance(t_limit);
  } catch (...) {
    t_ = t_previous_;
    y_ = y_previous_;
    slope_.known = has_dense_output_ = false;
    restart_ = true;
    throw;
  }
  step_end_ = t_;
  ++statistics_.steps;
}

void SundialsStepper::advance(double t_limit) {
  if (std::exchange(restart_, false)) {
    check(reinit(t_, state_.get(), std::min(good_step_, t_limit - t_)));
    failed_attempts_ = 0;
  }
  const double wished = good_step_;
  const double t_stop = stop_short_of(t_limit, wished);
  check(evolve(t_stop, state_.get(), t_));
  if (t_ >= t_stop - 4 * epsilon * std::abs(t_stop)) t_ = t_stop;
  if (t_ < t_stop && t_ - t_previous_ < 16 * epsilon * std::abs(t_)) fail(CV_ERR_FAILURE);
  has_dense_output_ = true;

  const long failed = failed_attempts();
  const long rejected = failed - std::exchange(failed_attempts_, failed);
  statistics_.rejected += rejected;

  // A step cut short says nothing against the step wished for before.
  check(get_current_step(good_step_));
  cut_ = t_ == t_stop && rejected == 0 && t_ - t_previous_ < wished;
  if (t_ == t_stop && rejected == 0) good_step_ = std::max(good_step_, wished);
}

// Half-way to t_limit when one step is too few and two are enough, so that no crumb is left over.
double SundialsStepper::stop_short_of(double t_limit, double next_step) const {
  const double remaining = t_limit - t_;
  return next_step < remaining && remaining < 2 * next_step ? t_ + 0.5 * remaining : t_limit;
}

// The library takes no step of a few ulp; Euler's is exact there.
void SundialsStepper::jump(double t_limit) {
  const std::span<const double> f = ydot_previous();
  for (std::size_t i = 0; i < y_.size(); ++i) y_[i] += (t_limit - t_) * f[i];
  t_ = t_limit;
  cut_ = true;
  has_dense_output_ = false;
  restart_ = true;
}

void SundialsStepper::retake(double t) {
  if (t == t_) return;
  if (!(t <= step_end_))
    throw std::invalid_argument(fmt::format("retake to t = {} s, beyond the step's end {} s", t, step_end_));
  slope_.known = false;
  restart_ = true;
  lost_state_.reset();
  message_.clear();
  if (has_dense_output_ && t - t_previous_ >= 1000 * epsilon * std::abs(t)) {
    check(shorten_to(t));
    t_ = t;
  } else {
    y_ = y_previous_;
    t_ = t_previous_;
    jump(std::max(t, t_previous_));
  }
}

void SundialsStepper::interpolate(double t, std::span<double> y) {
  if (t >= t_) return void(std::copy(y_.begin(), y_.end(), y.begin()));
  if (t <= t_previous_ || !has_dense_output_) return void(std::copy(y_previous_.begin(), y_previous_.end(), y.begin()));
  check(get_dky(t, scratch_.get()));
  std::copy(scratch_values_.begin(), scratch_values_.end(), y.begin());
}

std::span<const double> SundialsStepper::known(Slope& slope, double t, std::span<const double> y) const {
  if (!slope.known) {
    system_.flow(t, y, slope.values);
    ++flow_calls_;
    slope.known = true;
  }
  return slope.values;
}

// --- Callbacks: nothing may be thrown through the library, so exceptions wait in exception_ for check()
// ---------------

int SundialsStepper::flow(double t, N_Vector y, N_Vector ydot, void* self) noexcept {
  auto& me = *static_cast<SundialsStepper*>(self);
  const std::size_t size = me.y_.size();
  double* rates = N_VGetArrayPointer(ydot);
  try {
    ++me.flow_calls_;
    me.system_.flow(t, {N_VGetArrayPointer(y), size}, {rates, size});
  } catch (...) {
    me.exception_ = std::current_exception();
    return -1;
  }
  double poison = 0;
  for (std::size_t i = 0; i < size; ++i) poison += rates[i] - rates[i];
  if (poison == 0) return 0;
  const double* lost = std::find_if(rates, rates + size, [](double v) { return !std::isfinite(v); });
  if (!me.lost_state_) me.lost_state_ = static_cast<std::size_t>(lost - rates);
  return 1;
}

// Fills I − γ J straight into the stored pattern; the library's own way would add sparse matrices at every step.
int SundialsStepper::newton_matrix(double t, N_Vector y, SUNMatrix matrix, bool reuse_jacobian, int* jacobian_is_new,
                                   double gamma, void* self) noexcept {
  auto& me = *static_cast<SundialsStepper*>(self);
  me.rate_of_convergence_ = 1;
  std::vector<double>& values = me.jacobian_values_;
  *jacobian_is_new = reuse_jacobian ? SUNFALSE : SUNTRUE;
  if (!reuse_jacobian) {
    try {
      ++me.statistics_.jacobian_calls;
      Deadline::check();
      me.system_.jacobian(t, {N_VGetArrayPointer(y), me.y_.size()}, values);
    } catch (...) {
      me.exception_ = std::current_exception();
      return -1;
    }
    const auto lost = std::find_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
    if (lost != values.end()) {
      me.lost_state_ = static_cast<std::size_t>(me.column_of_[static_cast<std::size_t>(lost - values.begin())]);
      return 1;
    }
  }
  double* entries = SUNSparseMatrix_Data(matrix);
  for (std::size_t k = 0; k < values.size(); ++k) entries[k] = -gamma * values[k];
  for (const std::size_t k : me.diagonal_) entries[k] += 1;
  ++me.statistics_.factorisations;
  return 0;
}

// Less than some round-off of a state is not requested: the library refuses, or cuts its steps for ever. Works grow far
// beyond the torques that their tolerance is made of.
int SundialsStepper::error_weights(N_Vector y, N_Vector weights, void* self) noexcept {
  const auto& weight = static_cast<SundialsStepper*>(self)->weight_;
  const double* value = N_VGetArrayPointer(y);
  double* out = N_VGetArrayPointer(weights);
  constexpr double floor = 20 * epsilon;
  for (std::size_t i = 0; i < weight.size(); ++i)
    out[i] = std::min(weight[i], 1 / (floor * std::max(std::abs(value[i]), 1e-100)));
  return 0;
}

void SundialsStepper::take_message(int code, const char*, const char*, char* message, void* self) noexcept {
  try {
    if (code < 0) static_cast<SundialsStepper*>(self)->message_ = message;
  } catch (...) {  // out of memory for a message: do without it
  }
}

void SundialsStepper::make_matrix() {
  const SparsityPattern& pattern = system_.jacobian_pattern();
  const auto size = static_cast<sunindextype>(pattern.size), stored = static_cast<sunindextype>(pattern.row.size());
  matrix_.reset(made(SUNSparseMatrix(size, size, stored, CSC_MAT, context_.get()), "sparse matrix"));
  std::copy(pattern.column_start.begin(), pattern.column_start.end(), SUNSparseMatrix_IndexPointers(matrix_.get()));
  std::copy(pattern.row.begin(), pattern.row.end(), SUNSparseMatrix_IndexValues(matrix_.get()));
  jacobian_values_.resize(pattern.row.size());

  for (std::size_t column = 0; column < pattern.size; ++column) {
    const std::size_t before = diagonal_.size();
    for (auto k = pattern.column_start[column]; k < pattern.column_start[column + 1]; ++k) {
      column_of_.push_back(static_cast<std::int64_t>(column));
      if (pattern.row[static_cast<std::size_t>(k)] == column_of_.back())
        diagonal_.push_back(static_cast<std::size_t>(k));
    }
    if (diagonal_.size() != before + 1)
      throw std::logic_error(fmt::format("Jacobian pattern: column {} does not store its diagonal entry", column));
  }
  linear_solver_.reset(made(SUNLinSol_KLU(state_.get(), matrix_.get(), context_.get()), "sparse solver KLU"));
}

// --- Failures -------------------------------------------------------------------------------------------------------

void SundialsStepper::check(int flag) {
  if (exception_) std::rethrow_exception(std::exchange(exception_, nullptr));
  if (flag < 0) fail(flag);
}

void SundialsStepper::fail(int flag) {
  const std::string library = message_.empty() ? "" : fmt::format(" [{}]", message_);
  if (lost_state_) {
    throw StepFailure(fmt::format("after t = {:.17g} s the rate of state {} is not a finite number however short the "
                                  "step{}",
                                  t_previous_, *lost_state_, library),
                      t_previous_, *lost_state_, true);
  }
  const std::size_t worst = worst_state();
  throw StepFailure(
      fmt::format("after t = {:.17g} s {}; the worst state is {}{}", t_previous_, explanation(flag), worst, library),
      t_previous_, worst, false);
}

std::size_t SundialsStepper::worst_state() {
  if (get_error_estimate(scratch_.get()) < 0) return 0;
  std::size_t worst = 0;
  double largest = -1;
  for (std::size_t i = 0; i < y_.size(); ++i) {
    const double e = std::abs(scratch_values_[i]) * weight_[i];
    if (!std::isfinite(e)) return i;
    if (e > largest) largest = e, worst = i;
  }
  return worst;
}

}  // namespace kurbel
