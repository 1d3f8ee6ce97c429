// accuracy_question.cpp — kurbel accuracy: what accuracy costs on a scene, and the inverse questions.
#include <algorithm>
#include <functional>

#include "studies/accuracy/accuracy.h"
#include "studies/question/question.h"

namespace kurbel {
namespace {

StudyOutput accuracy_by_time(const Inquiry& inquiry, AccuracyOptions asked) {
  asked.watch = inquiry.watch;
  std::sort(asked.tolerances.begin(), asked.tolerances.end(), std::greater<>());
  AccuracyStudy study = measure_accuracy(inquiry.scene, asked);
  const bool has_settings = !study.settings.empty();
  StudyOutput output = output_of(std::move(study));
  if (has_settings)
    output.next = "run with the cheapest setting that is exact enough: kurbel run {scene} --setting {summary}";
  return output;
}

OptionsOf<AccuracyOptions> options() {
  using Asked = AccuracyOptions;
  return OptionsOf<Asked>()
      .add({.name = "within",
            .doc = "the cheapest setting with at most this error, e.g. 0.1%",
            .example = "0.1 %",
            .what = "a part, 1e-12 … 1",
            .domain = {.low = 1e-12, .high = 1}},
           &Asked::within)
      .add({.name = "budget",
            .doc = "the most exact setting for this processor time, e.g. 50ms",
            .example = "50 ms",
            .what = "a time > 0",
            .domain = positive},
           &Asked::budget)
      .add(
          {.name = "figures",
           .doc = "names joined by commas, the one that this is about first (default: the largest peak torque, else δ)",
           .words = true},
          &Asked::figures)
      .add({.name = "methods", .doc = "only these, e.g. dop853 esdirk (default: all that apply)", .words = true},
           OptionForm::several,
           [](Asked& asked, const OptionValues& given) {
             for (const std::string& method : given.texts()) {
               check_method(method, "reduced");
               if (method == "auto") given.refuse(method, "methods to compare; auto changes its method on its way");
             }
             given.read(asked.methods);
           })
      .add({.name = "tolerances",
            .doc = "only these, e.g. 1e-4 1e-8 (default: 1e-3 … 1e-12)",
            .example = "1e-6",
            .what = "1e-12 … 0.01",
            .domain = {.low = 1e-12, .high = 0.01},
            .words = true},
           &Asked::tolerances)
      .add({.name = "no_multibody", .doc = "omit Simbody's closed loop, the slowest model"}, &Asked::multibody, false)
      .add({.name = "time",
            .doc = "processor time that the study may take, about (default: 60 s)",
            .example = "60 s",
            .what = "a time > 0",
            .domain = positive},
           &Asked::time);
}

}  // namespace

Question accuracy_question() {
  return make_question(
      {.place = 110,
       .name = "accuracy",
       .arguments = "scene.toml",
       .help = "computing time and error over methods, tolerances and models",
       .does = "what accuracy costs: every integrator × tolerance × level of the model against references by "
               "two independent methods, work–precision diagrams, Pareto front, conclusion in words; "
               "`--within 0.1%` and `--budget 50ms` answer the inverse questions; `kurbel run scene.toml "
               "--setting FILE` takes the cheapest setting of its summary that was exact enough"},
      options(), accuracy_by_time);
}

}  // namespace kurbel
