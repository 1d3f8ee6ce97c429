// step_limits.h — causes of short steps in a run: counted by state, reported by element.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/steppers/stepper.h"

namespace kurbel {

class Equations;

// Steps limited by one element for one reason.
struct LimitedSteps {
  std::string element;                   // empty: no element of the machine
  std::string by;                        // "accuracy", "stability", "events", "knots", "edges", "turns", …
  std::vector<std::string> states = {};  // "twist of c3", most often first; for accuracy and stability
  std::int64_t steps = 0;
  double share = 0;  // of all steps
};

class StepLimits {
 public:
  // End of a step set by the run.
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

  // Ranked, most steps first. States are assigned to elements by the Jacobian at (t, y): a speed to the stiffest element on
  // it.
  std::vector<LimitedSteps> ranked(Equations& equations, double t, std::span<const double> y) const;

 private:
  std::vector<std::int64_t> by_accuracy_, by_stability_, by_guard_;
  std::int64_t growth_ = 0;
  std::int64_t by_bound_[3] = {0, 0, 0};
};

// The element whose law dominates a state: the owner of a twist or internal state; for the speed or angle of a shaft the
// spring, damper or circuit with the fastest response, by the exact Jacobian.
std::string element_behind(Equations& equations, std::size_t state, double t, std::span<const double> y);

// "c3: accuracy 61 %, stability 12 % (twist of c3); events of clutch 9 %"; empty for a run without steps.
std::string reported(const std::vector<LimitedSteps>& limits);

}  // namespace kurbel
