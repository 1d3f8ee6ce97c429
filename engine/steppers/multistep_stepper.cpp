// multistep_stepper.cpp — CVODE: backward differentiation formulas by Newton's iteration and KLU, Adams–Moulton
// formulas by a fixed-point iteration.
#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "engine/steppers/sundials_common.h"
#include "engine/steppers/sundials_stepper.h"

namespace kurbel {
namespace {

struct ReleaseCvode {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

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

std::unique_ptr<Stepper> make_bdf_stepper(OdeSystem& system, const ErrorControl& control) {
  return std::make_unique<MultistepStepper>(CV_BDF, system, control);
}
std::unique_ptr<Stepper> make_adams_stepper(OdeSystem& system, const ErrorControl& control) {
  return std::make_unique<MultistepStepper>(CV_ADAMS, system, control);
}

}  // namespace kurbel
