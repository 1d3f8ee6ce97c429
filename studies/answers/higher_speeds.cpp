// higher_speeds.cpp — speeds above the usual one: the balance of the rigid machine, and the run continued.
#include "studies/answers/higher_speeds.h"

#include <cmath>
#include <exception>
#include <numbers>
#include <vector>

#include "engine/model/model.h"
#include "engine/numerics/index.h"
#include "engine/scene/effects.h"

namespace kurbel {

bool settles_at_a_higher_speed(const Model& m, double t, double speed) try {
  constexpr double most = 100, step = 1.5;
  constexpr int places = 24;
  const auto rigid = compile(m.scene, without_elasticity(m.effects));
  Equations equations(rigid, false);
  const std::size_t shaft = at(rigid->shaft_of_node[at(rigid->reduction_node)]);
  const double cycle = rigid->cycle > 0 ? rigid->cycle : 2 * std::numbers::pi;
  for (double times = step; times < most; times *= step) {
    double sum = 0;
    for (int k = 0; k < places; ++k) {
      const std::vector<double> y = equations.modes_from_scratch(t, cycle * k / places, times * speed);
      sum += rigid->gain_of_node[at(rigid->reduction_node)] * equations.snapshot(t, y).alpha[shaft];
    }
    if (sum * speed <= 0) return true;
  }
  return false;
} catch (const std::exception&) {  // nothing is known of higher speeds
  return false;
}

bool settles_later(const Equations& at_end, const RunOutcome& outcome, double speed_at_end, const Watch& watch,
                   double budget, double least) try {
  const std::int64_t most = least > 0 ? 100 : 10;  // times the evaluations of the run; one of few cycles is short
  Equations equations(at_end.shared_model(), false);
  const Model& m = equations.model();
  State state{outcome.t, outcome.state, at_end.modes()};
  state.y.resize(equations.state_count());
  std::array<double, 3> mean{};
  budget -= outcome.statistics.cpu_seconds;
  for (double& speed : mean) {
    if (!(budget > 0)) return least > 0;
    equations.bind(state.modes);
    const double begin = equations.angle_with_turns(at(m.reduction_angle), state.y);
    RunOptions run{.tolerance = 1e-6,
                   .method = "auto",
                   .until = 2 * state.t,
                   .budget = budget,
                   .most_flow_calls = most * outcome.statistics.stepper.flow_calls,
                   .interrupted = watch.interrupted,
                   .progress = {}};
    run.from = {state.t, state.y};
    const RunOutcome on = integrate(equations, run, {});
    if (!on.complete) return least > 0;
    budget -= on.statistics.cpu_seconds;
    speed = std::abs(equations.angle_with_turns(at(m.reduction_angle), on.state) - begin) / (on.t - state.t);
    state = {on.t, on.state, equations.modes()};
  }
  return !keeps_gaining(mean) || mean[2] < least * std::abs(speed_at_end);
} catch (const std::exception&) {  // nothing is known of later
  return least > 0;
}

}  // namespace kurbel
