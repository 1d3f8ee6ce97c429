// count_evaluations.cpp — evaluates right-hand side and Jacobian of a scene with one effect off, for callgrind to
// count.
//
//   kurbel_count_evaluations SCENE EFFECT off|without|run-off:METHOD|run-on:METHOD|flow|jacobian|run:METHOD
// "off": the effect is switched off; "without": besides, its keys are taken out of the scene; "run": a bare run to the
// scene's end at 1e-7, with the effect on or off. "flow", "jacobian", "run:": the scene as it stands, whatever EFFECT; a run's
// steps are printed. Only what runs inside kurbel_counted_… is to be counted:
//   valgrind --tool=callgrind --toggle-collect=kurbel_counted_evaluations --toggle-collect=kurbel_counted_run …
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "bench/instruction_counts.h"
#include "engine/events/equations.h"
#include "engine/run/run.h"
#include "studies/scenes/kinds.h"
#include "tests/support/without_effect.h"

namespace {

using namespace kurbel;

struct Moment {
  double t;
  std::vector<double> y;
};

}  // namespace

extern "C" __attribute__((noinline)) double kurbel_counted_evaluations(Equations& equations,
                                                                       const std::vector<Moment>& states,
                                                                       std::vector<double>& rate,
                                                                       std::vector<double>& values, bool flow,
                                                                       bool jacobian) {
  double sum = 0;
  for (const Moment& s : states) {
    if (flow) equations.flow(s.t, s.y, rate);
    if (jacobian) equations.jacobian(s.t, s.y, values);
    sum += rate.front();
  }
  return sum;
}

extern "C" __attribute__((noinline)) double kurbel_counted_run(Equations& equations, const RunOptions& options) {
  return static_cast<double>(integrate(equations, options, {}).statistics.stepper.steps);
}

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "kurbel_count_evaluations SCENE EFFECT HOW (see the source)\n"), 2;
  try {
    Scene scene = read_scene(argv[1], all_kinds());
    const std::string effect = argv[2], how = argv[3];
    Effects effects = scene.effects;
    const bool as_it_stands = how == "flow" || how == "jacobian" || how.starts_with("run:");
    for (const EffectFlag& flag : effect_flags())
      if (!as_it_stands && effect == flag.name) effects.*(flag.flag) = how.starts_with("run-on:");
    if (how == "without") test::erase_effect(scene, effect);
    Equations equations(compile(scene, effects), false);
    bench::start_instrumentation();
    if (how.starts_with("run")) {
      const RunOptions options{.tolerance = 1e-7,
                               .method = how.substr(how.find(':') + 1),
                               .until = scene.run.until,
                               .budget = 600,
                               .interrupted = nullptr,
                               .progress = {},
                               .work_tables = nullptr};
      std::printf("%.17g\n", kurbel_counted_run(equations, options));
      return 0;
    }
    std::vector<Moment> states;
    std::vector<double> y = equations.start(0);
    for (int i = 0; i < 50; ++i) {  // around the start, in its modes
      states.push_back({0, y});
      for (std::size_t k = 0; k < y.size(); ++k) states.back().y[k] += 1e-9 * i * equations.error_control(1).scale[k];
    }
    std::vector<double> rate(y.size()), values(equations.jacobian_pattern().row.size());
    std::printf("%.17g\n",
                kurbel_counted_evaluations(equations, states, rate, values, how != "jacobian", how != "flow"));
    return 0;
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  }
}
