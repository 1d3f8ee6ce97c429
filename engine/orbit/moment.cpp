// moment.cpp — steps and windows that come after a moment never come.
#include "engine/orbit/moment.h"

#include <fmt/format.h>

#include <stdexcept>

#include "engine/run/run.h"

namespace kurbel {
namespace {

constexpr double never = 1e30;  // [rad/s], [s]

std::size_t steps_before(const Scene& scene, const Effects& effects, double time) {
  Equations equations(compile(scene, effects), false);
  RunOptions run;
  run.tolerance = 1e-9, run.until = time, run.budget = scene.run.budget;
  const RunOutcome outcome = integrate(equations, run, {});
  if (!outcome.complete)
    throw std::invalid_argument(fmt::format("the run does not get to {:.6g} s: {}", time, outcome.diagnosis));
  return equations.modes().next_step;
}

}  // namespace

std::string Moment::describe() const {
  if (after_step) return *after_step > 0 ? fmt::format("after step {}", *after_step) : "before step 1";
  return time ? fmt::format("at {:.6g} s", *time) : std::string();
}

Scene as_of(const Scene& scene, const Effects& effects, const Moment& moment) {
  std::vector<SequenceStep>::size_type steps = scene.sequence.steps.size();
  if (moment.after_step && *moment.after_step > steps)
    throw std::invalid_argument(
        fmt::format("step {}: the operating sequence has {} step{}", *moment.after_step, steps, steps == 1 ? "" : "s"));
  Scene then = scene;
  if (!moment.any() || steps == 0) return then;
  if (moment.time && scene.sequence.repeat)
    throw std::invalid_argument(
        "at a time: the operating sequence repeats, and the settings of its earlier repetitions would be omitted; give "
        "a step of its first repetition, e.g. \"step 2\"");
  const std::size_t last = moment.after_step ? *moment.after_step : steps_before(scene, effects, *moment.time);
  then.sequence.repeat = false, then.sequence.every = 0;
  if (last >= steps) return then;
  SequenceStep& next = then.sequence.steps[last];
  next.when = SequenceStep::When::speed_above;
  next.value = never;
  if (next.of.empty()) next.of = scene.components.front().name;
  return then;
}

Network network_as_of(const Scene& scene, const Moment& moment) {
  Network network = build_network(scene);
  if (!moment.time) return network;
  for (Network::ShaftElement& e : network.elements) {
    if (e.window.start > *moment.time)
      e.window = {.start = Window{}.stop, .stop = Window{}.stop};
    else if (e.window.stop > *moment.time)
      e.window.stop = Window{}.stop;
  }
  return network;
}

}  // namespace kurbel
