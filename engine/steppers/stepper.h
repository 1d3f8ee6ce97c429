// stepper.h — interface of integrators: they advance y' = f(t, y) by one step at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "engine/numerics/ode_system.h"

namespace kurbel {

struct StepperStatistics {
  std::int64_t steps = 0, rejected = 0, flow_calls = 0, jacobian_calls = 0, factorisations = 0, restarts = 0;
};

// The step size fell to round-off, a value became non-finite, or a solver failed. `state`: index of the worst state.
struct StepFailure : std::runtime_error {
  StepFailure(const std::string& what, double time, std::size_t state, bool not_finite)
      : std::runtime_error(what), time(time), state(state), not_finite(not_finite) {}
  double time;
  std::size_t state;
  bool not_finite;
};

// What limited the length of a step.
struct StepLimit {
  enum class By {
    accuracy,   // the error of `state`
    stability,  // of an explicit method; `state` has the largest error
    growth,     // limited growth of steps after a start
    end         // prescribed end
  };
  By by = By::end;
  std::size_t state = 0;
};

// An integrator. After step() the solution is known at t_previous() and t(), and between them by
// interpolate().
class Stepper {
 public:
  virtual ~Stepper() = default;
  // Starts, or restarts after an event that changed f or y. Uses the last good step size as the first guess.
  virtual void start(double t, std::span<const double> y) = 0;
  // One accepted step, ending at t_limit at the latest (lands on t_limit exactly when it reaches it). Throws
  // StepFailure.
  virtual void step(double t_limit) = 0;
  // Discards the last step and integrates from t_previous() to end exactly at t, which lies within the accepted step;
  // repeated calls may approach an event from both sides.
  virtual void retake(double t) = 0;
  virtual void interpolate(double t, std::span<double> y) = 0;  // t_previous() ≤ t ≤ t()
  // One state only; faster if the method supports it.
  virtual double interpolate(double t, std::size_t state) {
    one_of_.resize(y().size());
    interpolate(t, one_of_);
    return one_of_[state];
  }

  virtual double t() const = 0;
  virtual double t_previous() const = 0;
  virtual std::span<const double> y() const = 0;
  virtual std::span<const double> y_previous() const = 0;
  virtual std::span<const double> ydot() const = 0;           // f(t(), y())
  virtual std::span<const double> ydot_previous() const = 0;  // f(t_previous(), y_previous())
  // The stepper ends steps where a law changes at a known angle; at_edge(): the last step did, and falling guards that are
  // zero there have fired.
  virtual bool ends_on_edges() const { return false; }
  virtual bool at_edge() const { return false; }
  // True while the step size is limited by stability rather than accuracy (explicit methods on stiff equations).
  virtual bool held_by_stability() const { return false; }
  // For the last accepted step(), before any retake().
  virtual StepLimit limited_by() { return {}; }

  const StepperStatistics& statistics() const { return statistics_; }

 protected:
  StepperStatistics statistics_;

 private:
  std::vector<double> one_of_;
};

enum class Method {
  dormand_prince_54,   // explicit, order 5
  dormand_prince_853,  // explicit, order 8
  verner_65,           // explicit, order 6
  fehlberg_87,         // explicit, order 8; no error estimate for rates that depend on time only
  esdirk_32,           // implicit, L-stable, order 3 (SUNDIALS ARKStep)
  esdirk_43,           // order 4
  esdirk_54,           // order 5
  bdf,                 // implicit, multistep, order 1…5 (SUNDIALS CVODE)
  adams,               // multistep, order 1…12 (SUNDIALS CVODE, fixed-point iteration)
  work_equation        // rigid machines over their angle (work_stepper.h)
};

std::string_view name_of(Method method);
// By its name in scenes; "auto" starts with dop853. Throws std::invalid_argument with a message.
Method method_named(const std::string& name);
std::unique_ptr<Stepper> make_stepper(Method method, OdeSystem& system, ErrorControl control);

}  // namespace kurbel
