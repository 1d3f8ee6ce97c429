// sundials_common.h — common parts of the steppers with ARKStep and CVODE; only for their sources.
#pragma once

#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/steppers/stepper.h"

namespace kurbel {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();
inline constexpr int most_failures_in_a_step = 25;  // each divides the step by about 4: limit before round-off
inline constexpr long most_steps_in_a_call = 100;   // one is requested

// --- owning handles of the library ---

struct Release {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
  void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
};
template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

template <class Handle>
Handle made(Handle handle, const char* what) {
  if (!handle) throw std::runtime_error(fmt::format("SUNDIALS could not make its {}", what));
  return handle;
}

inline void must(int flag, const char* what) {
  if (flag < 0) throw std::runtime_error(fmt::format("SUNDIALS refused to {} (code {})", what, flag));
}

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
  // Calls of the library, with its names.
  virtual int reinit(double t, N_Vector y, double first_step) = 0;  // first_step = 0: the library's own guess
  virtual int evolve(double t_stop, N_Vector y, double& t) = 0;     // one step, at most to t_stop
  virtual int get_dky(double t, N_Vector y) = 0;
  virtual int get_current_step(double& h) = 0;
  virtual int get_error_estimate(N_Vector e) = 0;
  virtual long failed_attempts() = 0;  // since reinit

  virtual int shorten_to(double t) = 0;  // for retake(): sets y_ to the solution at t, within the last step

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
  bool restart_ = true;  // t_ and y_ must be passed to the library before it continues
  double good_step_ = 0;
  bool has_dense_output_ = false;
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
  std::vector<std::size_t> diagonal_;                  // position of (i, i) in the pattern
  std::vector<std::int64_t> column_of_;                // of each stored entry
  mutable Slope slope_, slope_previous_;               // evaluated on demand
  std::int64_t& flow_calls_ = statistics_.flow_calls;  // includes these evaluations

  bool cut_ = false;  // the last step was shorter than needed by accuracy
  bool started_ = false;
  long failed_attempts_ = 0;
  std::optional<std::size_t> lost_state_;  // first state whose rate was not finite in this step
  std::exception_ptr exception_;
  std::string message_;
};

}  // namespace kurbel
