// sundials_stepper.cpp — ARKStep and CVODE behind the Stepper interface: maximum norm, checked calls, exceptions kept.
#include "engine/steppers/sundials_stepper.h"

#include <arkode/arkode_arkstep.h>
#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "engine/numerics/deadline.h"

namespace kurbel {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr int most_failures_in_a_step = 25;  // each divides the step by 4 or so: down to round-off, not for ever
constexpr long most_steps_in_a_call = 100;   // one is asked for

// --- Handles of the library that free themselves -------------------------------------------------------------------

struct Release {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
  void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
};
struct ReleaseArkstep {
  void operator()(void* memory) const { ARKStepFree(&memory); }
};
struct ReleaseCvode {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

template <class Handle>
Handle made(Handle handle, const char* what) {
  if (!handle) throw std::runtime_error(fmt::format("SUNDIALS could not make its {}", what));
  return handle;
}

void must(int flag, const char* what) {
  if (flag < 0) throw std::runtime_error(fmt::format("SUNDIALS refused to {} (code {})", what, flag));
}

Owned<SUNContext> new_context() {
  SUNContext context = nullptr;
  must(SUNContext_Create(nullptr, &context), "create its context");
  return Owned<SUNContext>(context);
}

// --- The maximum norm in place of the root mean square, which states at rest dilute ---------------------------------

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

// Every vector the library clones from this one inherits the norm.
Owned<N_Vector> vector_over(std::vector<double>& values, SUNContext context) {
  const auto size = static_cast<sunindextype>(values.size());
  Owned<N_Vector> v(made(N_VMake_Serial(size, values.data(), context), "vector"));
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
      return "the tolerance asks for more digits than the states have";
    case CV_TOO_CLOSE:
      return "the end of the step is within round-off of its beginning";
    default:
      return fmt::format("the solver gave up (code {})", flag);
  }
}

// --- What ARKStep and CVODE have in common -------------------------------------------------------------------------

class SundialsStepper : public Stepper {
 public:
  SundialsStepper(OdeSystem& system, const ErrorControl& control);
  SundialsStepper(const SundialsStepper&) = delete;
  SundialsStepper& operator=(const SundialsStepper&) = delete;

  void start(double t, std::span<const double> y) override;
  void step(double t_limit) override;
  void retake(double t) override;
  void interpolate(double t, std::span<double> y) override;

  double t() const override { return t_; }
  double t_previous() const override { return t_previous_; }
  std::span<const double> y() const override { return y_; }
  std::span<const double> y_previous() const override { return y_previous_; }
  std::span<const double> ydot() const override { return known(slope_, t_, y_); }
  std::span<const double> ydot_previous() const override { return known(slope_previous_, t_previous_, y_previous_); }
  StepLimit limited_by() override {
    if (cut_) return {};
    return {StepLimit::By::accuracy, worst_state()};
  }

 protected:
  // The library's calls, by the name they have there.
  virtual int reinit(double t, N_Vector y, double first_step) = 0;  // first_step = 0: the library's own guess
  virtual int evolve(double t_stop, N_Vector y, double& t) = 0;     // one step, at most to t_stop
  virtual int get_dky(double t, N_Vector y) = 0;
  virtual int get_current_step(double& h) = 0;
  virtual int get_error_estimate(N_Vector e) = 0;
  virtual long failed_attempts() = 0;  // since reinit

  virtual int shorten_to(double t) = 0;  // retake: makes y_ the solution at t, within the last step

  // Callbacks. They return 0 for success, 1 for "try a shorter step", −1 for "stop".
  static int flow(double t, N_Vector y, N_Vector ydot, void* self) noexcept;
  static int newton_matrix(double t, N_Vector y, SUNMatrix matrix, bool reuse_jacobian, int* jacobian_is_new,
                           double gamma, void* self) noexcept;
  static int error_weights(N_Vector y, N_Vector weights, void* self) noexcept;
  static void take_message(int code, const char* module, const char* function, char* message, void* self) noexcept;

  void make_matrix();
  void check(int flag);

  OdeSystem& system_;
  Owned<SUNContext> context_;  // first made, last destroyed
  std::vector<double> y_, y_previous_, scratch_values_;
  Owned<N_Vector> state_, previous_state_, scratch_;  // over the three above
  Owned<SUNMatrix> matrix_;                           // I − γ J
  Owned<SUNLinearSolver> linear_solver_;
  double t_ = 0, t_previous_ = 0;
  double step_end_ = 0;  // of the last step as it was accepted
  bool restart_ = true;  // the library must be told t_ and y_ before it can go on
  double good_step_ = 0;
  double rate_of_convergence_ = 1;  // of Newton's iteration, since its matrix was made

 private:
  struct Slope {
    std::vector<double> values;
    bool known = false;
  };
  std::span<const double> known(Slope& slope, double t, std::span<const double> y) const;

  double stop_short_of(double t_limit, double next_step) const;
  void advance(double t_limit);
  void jump(double t_limit);
  std::size_t worst_state();
  [[noreturn]] void fail(int flag);

  std::vector<double> weight_;
  std::vector<double> jacobian_values_;
  std::vector<std::size_t> diagonal_;                  // where the pattern keeps (i, i)
  std::vector<std::int64_t> column_of_;                // of each stored entry
  mutable Slope slope_, slope_previous_;               // evaluated when asked for
  std::int64_t& flow_calls_ = statistics_.flow_calls;  // counts those too

  bool has_dense_output_ = false;
  bool cut_ = false;  // the last step was shorter than accuracy asks
  bool started_ = false;
  long failed_attempts_ = 0;
  std::optional<std::size_t> lost_state_;  // first state whose rate was not finite in this step
  std::exception_ptr exception_;
  std::string message_;
};

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

// Less than some round-off of a state is not asked for: the library refuses, or cuts its steps for ever. Works grow far
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

// --- ARKStep
// ----------------------------------------------------------------------------------------------------------

class EsdirkStepper final : public SundialsStepper {
 public:
  EsdirkStepper(int order, OdeSystem& system, const ErrorControl& control);

 private:
  int reinit(double t, N_Vector y, double first_step) override;
  int evolve(double t_stop, N_Vector y, double& t) override;
  int get_dky(double t, N_Vector y) override { return ARKStepGetDky(memory_.get(), t, 0, y); }
  int get_current_step(double& h) override { return ARKStepGetCurrentStep(memory_.get(), &h); }
  int get_error_estimate(N_Vector e) override { return ARKStepGetEstLocalErrors(memory_.get(), e); }
  long failed_attempts() override;
  int shorten_to(double t) override;
  static int converged(SUNNonlinearSolver newton, N_Vector y, N_Vector correction, double part, N_Vector weights,
                       void* self) noexcept;

  Owned<SUNNonlinearSolver> newton_;
  std::unique_ptr<void, ReleaseArkstep> memory_;
  double last_correction_ = 0;
};

// The library's own test, but for corrections within the round-off of their state: there the iteration has found what
// there is to find. The twist across a gap is counted from mid-gap, and a stiff flank asks for less than its last
// digit.
int EsdirkStepper::converged(SUNNonlinearSolver newton, N_Vector, N_Vector correction, double part, N_Vector weights,
                             void* self) noexcept {
  constexpr double slowest = 0.3, diverges = 2.3;  // ARKODE's defaults
  auto& me = *static_cast<EsdirkStepper*>(self);
  const double *values = N_VGetArrayPointer(correction), *weight = N_VGetArrayPointer(weights);
  double size = 0, poison = 0;
  for (std::size_t i = 0; i < me.y_previous_.size(); ++i) {
    const double change = std::abs(values[i]);
    poison += change - change;
    if (change > 4 * epsilon * std::abs(me.y_previous_[i])) size = std::max(size, change * weight[i]);
  }
  size += poison;
  int iteration = 0;
  if (const int flag = SUNNonlinSolGetCurIter(newton, &iteration); flag != 0) return flag;
  if (iteration > 0) me.rate_of_convergence_ = std::max(slowest * me.rate_of_convergence_, size / me.last_correction_);
  if (std::min(me.rate_of_convergence_, 1.0) * size <= part) return SUN_NLS_SUCCESS;
  if (iteration > 0 && size > diverges * me.last_correction_) return SUN_NLS_CONV_RECVR;
  me.last_correction_ = size;
  return SUN_NLS_CONTINUE;
}

const char* esdirk_table(int order) {
  return order == 3   ? "ARKODE_ESDIRK325L2SA_5_2_3"
         : order == 4 ? "ARKODE_ESDIRK436L2SA_6_3_4"
                      : "ARKODE_ESDIRK547L2SA2_7_4_5";
}

EsdirkStepper::EsdirkStepper(int order, OdeSystem& system, const ErrorControl& control)
    : SundialsStepper(system, control) {
  make_matrix();
  memory_.reset(made(ARKStepCreate(nullptr, flow, 0.0, state_.get(), context_.get()), "ARKStep integrator"));
  void* m = memory_.get();
  must(ARKStepSetErrHandlerFn(m, take_message, this), "take an error handler");
  must(ARKStepSetUserData(m, this), "take user data");
  must(ARKStepWFtolerances(m, error_weights), "take error weights");
  must(ARKStepSetTableName(m, esdirk_table(order), "ARKODE_ERK_NONE"), "use its ESDIRK table");
  newton_.reset(made(SUNNonlinSol_Newton(state_.get(), context_.get()), "Newton iteration"));
  must(ARKStepSetNonlinearSolver(m, newton_.get()), "use Newton's iteration");
  must(SUNNonlinSolSetConvTestFn(newton_.get(), converged, this), "take the test of convergence");
  // No more than a cubic between the steps: a quartic asks for slopes there, where hλ multiplies what is left over.
  must(ARKStepSetInterpolantDegree(m, 3), "interpolate by cubics");
  must(ARKStepSetLinearSolver(m, linear_solver_.get(), matrix_.get()), "use KLU");
  must(ARKStepSetLinSysFn(m, [](double t, N_Vector y, N_Vector, SUNMatrix a, SUNMatrix, int reuse, int* is_new,
                                double gamma, void* self, N_Vector, N_Vector,
                                N_Vector) { return newton_matrix(t, y, a, reuse, is_new, gamma, self); }),
       "take the Newton matrix");
  must(ARKStepSetPredictorMethod(m, 1), "use predictor 1");
  // The first stage is explicit. Were its slope f(t, y) evaluated anew, what Newton's iteration left over in y would
  // come back multiplied by h·λ: measured on Prothero–Robinson, up to 600 times the tolerance. Deduced from the stage
  // equation it stays below 10 times. The price: on a smooth problem the left-over adds up (up to 20 times the
  // tolerance instead of once), so the iteration is made more exact than usual, for some 3 % more steps.
  must(ARKStepSetDeduceImplicitRhs(m, SUNTRUE), "deduce slopes from the stage equations");
  // Orders 3 and 5 show their order only with a still smaller part (measured on van der Pol: 26 times the tolerance at
  // 1e-10 with 0.01, 0.4 times with 0.001).
  must(ARKStepSetNonlinConvCoef(m, order == 4 ? 0.01 : 0.001), "take the convergence coefficient");
  // A step retaken onto an event has no shorter one to fall back on; and quadratures come one iterate behind.
  must(ARKStepSetMaxNonlinIters(m, 10), "bound the iterations");
  must(ARKStepSetMaxErrTestFails(m, most_failures_in_a_step), "bound the error test failures");
  must(ARKStepSetMaxConvFails(m, most_failures_in_a_step), "bound the convergence failures");
  must(ARKStepSetMaxNumSteps(m, most_steps_in_a_call), "bound the steps");
}

int EsdirkStepper::reinit(double t, N_Vector y, double first_step) {
  const int flag = ARKStepReInit(memory_.get(), nullptr, flow, t, y);
  return flag < 0 ? flag : ARKStepSetInitStep(memory_.get(), first_step);
}

int EsdirkStepper::evolve(double t_stop, N_Vector y, double& t) {
  const int flag = ARKStepSetStopTime(memory_.get(), t_stop);
  return flag < 0 ? flag : ARKStepEvolve(memory_.get(), t_stop, y, &t, ARK_ONE_STEP);
}

long EsdirkStepper::failed_attempts() {
  long errors = 0, iterations = 0;
  ARKStepGetNumErrTestFails(memory_.get(), &errors);
  ARKStepGetNumNonlinSolvConvFails(memory_.get(), &iterations);
  return errors + iterations;
}

// A one-step method: the same step again, shorter than the one accepted, hence without an error test.
int EsdirkStepper::shorten_to(double t) {
  void* m = memory_.get();
  double reached = t_previous_;
  int flag = ARKStepReInit(m, nullptr, flow, t_previous_, previous_state_.get());
  if (flag >= 0) flag = ARKStepSetFixedStep(m, t - t_previous_);
  if (flag >= 0) flag = evolve(t, state_.get(), reached);
  const int back = ARKStepSetFixedStep(m, 0.0);
  return flag < 0 ? flag : back;
}

// --- CVODE
// ------------------------------------------------------------------------------------------------------------

class MultistepStepper final : public SundialsStepper {
 public:
  MultistepStepper(int formula, OdeSystem& system, const ErrorControl& control);

 private:
  int reinit(double t, N_Vector y, double first_step) override;
  int evolve(double t_stop, N_Vector y, double& t) override;
  int get_dky(double t, N_Vector y) override { return CVodeGetDky(memory_.get(), t, 0, y); }
  int get_current_step(double& h) override { return CVodeGetCurrentStep(memory_.get(), &h); }
  int get_error_estimate(N_Vector e) override { return CVodeGetEstLocalErrors(memory_.get(), e); }
  long failed_attempts() override;
  // A multistep method is a polynomial through its past: between its points, that polynomial is its solution.
  // To begin anew at t_previous would mean order 1 and a dozen steps.
  int shorten_to(double t) override { return get_dky(t, state_.get()); }

  Owned<SUNNonlinearSolver> iteration_;
  std::unique_ptr<void, ReleaseCvode> memory_;
};

MultistepStepper::MultistepStepper(int formula, OdeSystem& system, const ErrorControl& control)
    : SundialsStepper(system, control) {
  memory_.reset(made(CVodeCreate(formula, context_.get()), "CVODE integrator"));
  void* m = memory_.get();
  must(CVodeSetErrHandlerFn(m, take_message, this), "take an error handler");
  must(CVodeInit(m, flow, 0.0, state_.get()), "begin");
  must(CVodeSetUserData(m, this), "take user data");
  must(CVodeWFtolerances(m, error_weights), "take error weights");
  if (formula == CV_BDF) {
    make_matrix();
    must(CVodeSetLinearSolver(m, linear_solver_.get(), matrix_.get()), "use KLU");
    must(CVodeSetLinSysFn(
             m, [](double t, N_Vector y, N_Vector, SUNMatrix a, int reuse, int* is_new, double gamma, void* self,
                   N_Vector, N_Vector, N_Vector) { return newton_matrix(t, y, a, reuse, is_new, gamma, self); }),
         "take the Newton matrix");
  } else {
    iteration_.reset(made(SUNNonlinSol_FixedPoint(state_.get(), 0, context_.get()), "fixed-point iteration"));
    must(CVodeSetNonlinearSolver(m, iteration_.get()), "use the fixed-point iteration");
  }
  must(CVodeSetMaxErrTestFails(m, most_failures_in_a_step), "bound the error test failures");
  must(CVodeSetMaxConvFails(m, most_failures_in_a_step), "bound the convergence failures");
  must(CVodeSetMaxNumSteps(m, most_steps_in_a_call), "bound the steps");
}

int MultistepStepper::reinit(double t, N_Vector y, double first_step) {
  const int flag = CVodeReInit(memory_.get(), t, y);
  // What a high order could afford is far too long for order 1, which every restart begins with: let the library guess.
  (void)first_step;
  return flag < 0 ? flag : CVodeSetInitStep(memory_.get(), 0.0);
}

int MultistepStepper::evolve(double t_stop, N_Vector y, double& t) {
  const int flag = CVodeSetStopTime(memory_.get(), t_stop);
  return flag < 0 ? flag : CVode(memory_.get(), t_stop, y, &t, CV_ONE_STEP);
}

long MultistepStepper::failed_attempts() {
  long errors = 0, iterations = 0;
  CVodeGetNumErrTestFails(memory_.get(), &errors);
  CVodeGetNumNonlinSolvConvFails(memory_.get(), &iterations);
  return errors + iterations;
}

}  // namespace

std::unique_ptr<Stepper> make_esdirk_stepper(int order, OdeSystem& system, const ErrorControl& control) {
  return std::make_unique<EsdirkStepper>(order, system, control);
}
std::unique_ptr<Stepper> make_bdf_stepper(OdeSystem& system, const ErrorControl& control) {
  return std::make_unique<MultistepStepper>(CV_BDF, system, control);
}
std::unique_ptr<Stepper> make_adams_stepper(OdeSystem& system, const ErrorControl& control) {
  return std::make_unique<MultistepStepper>(CV_ADAMS, system, control);
}

}  // namespace kurbel
