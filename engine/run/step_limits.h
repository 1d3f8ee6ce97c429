// step_limits.h — what kept the steps of a run short: counted state by state, told element by element.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/steppers/stepper.h"

namespace kurbel {

class Equations;

// Steps that one element kept short for one reason.
struct LimitedSteps {
  std::string element;                   // empty: no element of the machine
  std::string by;                        // "accuracy", "stability", "events", "edges", "turns", …
  std::vector<std::string> states = {};  // "twist of c3", most often first; of accuracy and stability
  std::int64_t steps = 0;
  double share = 0;  // of all steps
};

class StepLimits {
 public:
  // Where the run itself ends a step.
  enum class Bound { until, edge, turn };

  void begin(std::size_t states, std::size_t guards);
  void count(const StepLimit& limit, Bound bound) {
    switch (limit.by) {
      case StepLimit::By::accuracy:
        ++by_accuracy_[limit.state];
        break;
      case StepLimit::By::stability:
        ++by_stability_[limit.state];
        break;
      case StepLimit::By::growth:
        ++growth_;
        break;
      case StepLimit::By::end:
        ++by_bound_[static_cast<std::size_t>(bound)];
        break;
    }
  }
  void count_event(std::size_t guard) { ++by_guard_[guard]; }

  // Ranked, most steps first. States are told through the Jacobian at (t, y): a speed is held by what is stiffest on
  // it.
  std::vector<LimitedSteps> ranked(Equations& equations, double t, std::span<const double> y) const;

 private:
  std::vector<std::int64_t> by_accuracy_, by_stability_, by_guard_;
  std::int64_t growth_ = 0;
  std::int64_t by_bound_[3] = {0, 0, 0};
};

// The element whose law moves a state most: its own for a twist or an element's own state; for the speed or the angle
// of a shaft the spring, damper or circuit that it answers fastest through, by the exact Jacobian.
std::string element_behind(Equations& equations, std::size_t state, double t, std::span<const double> y);

// "c3: accuracy 61 %, stability 12 % (twist of c3); events of clutch 9 %"; nothing for a run without steps.
std::string told(const std::vector<LimitedSteps>& limits);

}  // namespace kurbel
