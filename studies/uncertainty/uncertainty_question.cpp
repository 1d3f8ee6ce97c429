// uncertainty_question.cpp — kurbel uncertainty: spread of the figures by the tolerances of a scene.
#include "studies/question/question.h"
#include "studies/uncertainty/uncertainty.h"
#include "studies/variants/in_threads.h"
#include "studies/variants/machine.h"

namespace kurbel {
namespace {

struct UncertaintyRequest : UncertaintyOptions {
  UncertaintyRequest() { jobs = threads_of(0); }
  MachineRequest machine;
};

StudyOutput uncertain(const Inquiry& inquiry, UncertaintyRequest asked) {
  const MachineQuestion question = question_of(inquiry, asked.machine);
  asked.watch = inquiry.watch;
  return output_of(study_uncertainty(question, asked));
}

OptionsOf<UncertaintyRequest> options() {
  using Asked = UncertaintyOptions;
  return OptionsOf<UncertaintyRequest>()
      .add({.name = "figures",
            .doc = "names joined by commas, or a quantity for all that have it: delta,peak_torque (default: all)",
            .words = true},
           &Asked::figures)
      .add({.name = "limit",
            .doc = "\"delta.press <= 0.05\": the probability that it holds; repeatable",
            .each_time = true},
           &Asked::limits)
      .add(machine_options(), &UncertaintyRequest::machine)
      .add({.name = "samples",
            .doc = "machines drawn from the tolerances (default: 500)",
            .domain = {.low = 20, .high = 1'000'000}},
           &Asked::samples)
      .add(
          {.name = "seed", .doc = "of the random numbers (default: 1)", .domain = {.low = 0, .high = 9007199254740992}},
          &Asked::seed)
      .add({.name = "jobs", .doc = "threads (default: one for each core)", .domain = {.low = 1, .high = 1024}},
           &Asked::jobs)
      .add({.name = "no_trials", .doc = "skip the runs that try, one by one, the effects that are off"}, &Asked::biases,
           false);
}

}  // namespace

Question uncertainty_question() {
  return make_question({.place = 116,
                        .name = "uncertainty",
                        .arguments = "scene.toml --limit \"delta.press <= 0.05\"",
                        .help = "spread of the figures by the tolerances of a scene, and which tolerance matters",
                        .does = "spread of the figures by the tolerances that the scene gives (`stiffness = { value = "
                                "\"900 kN*m/rad\", tolerance = \"10 "
                                "%\", distribution = \"normal\", k = 2 }`), by gradients and by samples; probability "
                                "that limits hold; which tolerance matters; numerical errors and known biases apart"},
                       options(), uncertain);
}

}  // namespace kurbel
