// esdirk_stepper.cpp — ARKStep with its ESDIRK tables, Newton's iteration and KLU.
#include <arkode/arkode_arkstep.h>
#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/steppers/sundials_common.h"
#include "engine/steppers/sundials_stepper.h"

namespace kurbel {
namespace {

struct ReleaseArkstep {
  void operator()(void* memory) const { ARKStepFree(&memory); }
};

class EsdirkStepper final : public SundialsStepper {
 public:
  EsdirkStepper(int order, OdeSystem& system, const ErrorControl& control);
  void interpolate(double t, std::span<double> y) override;
  double interpolate(double t, std::size_t state) override;

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
  void prepare_dense_output();
  double between(double t, std::size_t state) const;

  Owned<SUNNonlinearSolver> newton_;
  std::unique_ptr<void, ReleaseArkstep> memory_;
  double last_correction_ = 0;
  std::vector<double> slope_begin_, slope_end_;  // of the library's cubic through the last step
  bool dense_is_ready_ = false;
};

// The library's own test, but for corrections within the round-off of their state: there the iteration has found what
// there is to find. The twist across a gap is counted from mid-gap, and a stiff flank requires less than its last
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
  // No more than a cubic between the steps: a quartic needs slopes there, where hλ multiplies what is left over.
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
  dense_is_ready_ = false;
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

// The library's cubic, by its slopes at both ends: read once in a step, it is evaluated here state by state.
void EsdirkStepper::prepare_dense_output() {
  if (std::exchange(dense_is_ready_, true)) return;
  for (auto [t, slope] : {std::pair{t_previous_, &slope_begin_}, std::pair{t_, &slope_end_}}) {
    check(ARKStepGetDky(memory_.get(), t, 1, scratch_.get()));
    *slope = scratch_values_;
  }
}

double EsdirkStepper::between(double t, std::size_t i) const {
  const double h = t_ - t_previous_, x = (t - t_previous_) / h, rise = y_[i] - y_previous_[i];
  const double first = h * slope_begin_[i], last = h * slope_end_[i];
  return y_previous_[i] + x * (rise + (1 - x) * (first - rise + x * (2 * rise - first - last)));
}

void EsdirkStepper::interpolate(double t, std::span<double> y) {
  if (t >= t_ || t <= t_previous_ || !has_dense_output_) return SundialsStepper::interpolate(t, y);
  prepare_dense_output();
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = between(t, i);
}

double EsdirkStepper::interpolate(double t, std::size_t state) {
  if (t >= t_) return y_[state];
  if (t <= t_previous_ || !has_dense_output_) return y_previous_[state];
  prepare_dense_output();
  return between(t, state);
}

}  // namespace

std::unique_ptr<Stepper> make_esdirk_stepper(int order, OdeSystem& system, const ErrorControl& control) {
  return std::make_unique<EsdirkStepper>(order, system, control);
}

}  // namespace kurbel
