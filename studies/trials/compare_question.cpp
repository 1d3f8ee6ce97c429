// compare_question.cpp — kurbel compare: the rigid against the elastic model, or any two sets of effects.
#include "studies/run/compare.h"
#include "studies/run/run_findings.h"
#include "studies/trials/run_question.h"
#include "studies/trials/trials_findings.h"

namespace kurbel {

SimulateOptions RunRequest::simulation(const Inquiry& inquiry) const {
  if (method) check_method(*method, inquiry.scene.run.model);
  SimulateOptions options = inquiry.simulation();
  options.measure_error = measure_error;
  options.method = method;
  options.accuracy = accuracy;
  options.until = until;
  return options;
}

const OptionsOf<RunRequest>& run_options() {
  static const auto made =
      OptionsOf<RunRequest>()
          .add({.name = "effects",
                .doc = "none, all, or names of effects (see kurbel effects) joined by commas; elasticity:COUPLING,… "
                       "for some couplings; -NAME takes one away (overrides the scene)"},
               &RunRequest::effects)
          .add({.name = "accuracy",
                .doc = "measured error of every figure over its scale (overrides the scene)",
                .example = "1e-6",
                .what = "1e-12 … 0.1",
                .domain = {.low = 1e-12, .high = 0.1}},
               &RunRequest::accuracy)
          .add({.name = "until",
                .doc = "end of the simulated time, e.g. \"3 s\" (overrides the scene)",
                .example = "3 s",
                .what = "a time > 0",
                .domain = positive},
               &RunRequest::until)
          .add({.name = "method",
                .doc = "auto, work, dopri5, verner6, dop853, fehlberg8, adams, esdirk3, esdirk, esdirk5, bdf; for "
                       "multibody one of Simbody's integrators"},
               &RunRequest::method)
          .add({.name = "no_error", .doc = "skip the second run that measures the errors"}, &RunRequest::measure_error,
               false)
          .add({.name = "no_trials",
                .doc = "skip the runs of the rigid machine and those that try, one by one, the effects that are off "
                       "(made after short runs only)"},
               &RunRequest::trials, false);
  return made;
}

namespace {

struct CompareRequest : RunRequest {
  std::optional<Effects> against;
};

StudyOutput compared(const Inquiry& inquiry, CompareRequest asked) {
  const SimulateOptions simulation = asked.simulation(inquiry);
  Comparison comparison =
      compare(inquiry.scene, models_to_compare(inquiry.scene, asked.effects, asked.against), simulation);
  if (!asked.trials) return output_of(std::move(comparison));
  return output_of(with_trials(std::move(comparison), simulation));
}

}  // namespace

Question compare_question() {
  return make_question({.place = 20,
                        .name = "compare",
                        .arguments = "scene.toml",
                        .help = "the rigid against the elastic model, or any two sets of effects",
                        .does = "rigid against elastic with the same other effects on both sides, or any two sets of "
                                "effects (`--effects`, `--against`); `--against none`: the bare machine"},
                       OptionsOf<CompareRequest>()
                           .add(run_options())
                           .add({.name = "against",
                                 .doc = "effects of the first model; none for the bare machine (default: those of the "
                                        "second without elasticity)"},
                                &CompareRequest::against),
                       compared);
}

}  // namespace kurbel
