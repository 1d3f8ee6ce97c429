// accuracy_command.cpp — what accuracy costs on a scene, and the inverse questions.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "app/command_line.h"
#include "app/terminal.h"
#include "app/verb.h"
#include "studies/accuracy/accuracy.h"

namespace kurbel::app::accuracy_command {
namespace {

struct AccuracyArguments {
  StudyOptions study;
  std::string figure, within, budget, time;
  std::vector<std::string> methods;
  std::vector<double> tolerances;
  bool no_multibody = false;
};

AccuracyOptions options_of(const AccuracyArguments& arguments, Progress& progress) {
  AccuracyOptions options;
  options.watch = watch_of(arguments.study, progress);
  options.figure = arguments.figure;
  options.multibody = !arguments.no_multibody;
  for (const std::string& method : arguments.methods) {
    check_method(method, "reduced");
    if (method == "auto")
      throw std::invalid_argument("--methods auto: changes its method on its way; name the methods to compare");
  }
  options.methods = arguments.methods;
  for (const double tolerance : arguments.tolerances)
    if (!(tolerance >= 1e-12 && tolerance <= 0.01))
      throw std::invalid_argument(fmt::format("--tolerances {:g}: must be 1e-12 … 0.01", tolerance));
  if (!arguments.tolerances.empty()) {
    options.tolerances = arguments.tolerances;
    std::sort(options.tolerances.rbegin(), options.tolerances.rend());
  }
  if (!arguments.within.empty())
    options.within = quantity_of("--within", arguments.within, "a relative error > 0", "0.1 %", positive);
  if (!arguments.budget.empty())
    options.budget = quantity_of("--budget", arguments.budget, "a time > 0", "50 ms", positive);
  if (!arguments.time.empty()) options.time = quantity_of("--time", arguments.time, "a time > 0", "60 s", positive);
  return options;
}

int accuracy(const AccuracyArguments& arguments) {
  const Scene scene = read(arguments.study);
  check_folder(arguments.study);
  Progress progress(arguments.study.quiet);
  const AccuracyStudy study = measure_accuracy(scene, options_of(arguments, progress));
  const StudyOutput output = output_of(study);
  const int code = present(output, arguments.study);
  const bool written = code == exit_done && !arguments.study.no_files && !study.settings.empty();
  if (written && !arguments.study.json && !arguments.study.quiet)
    say(fmt::format("run with the cheapest setting that is exact enough: kurbel run {} --setting {}\n",
                    arguments.study.scene, (results_of(arguments.study) / "summary.json").string()));
  return code;
}

void set_up(OptionList& command, int& code) {
  const auto arguments = std::make_shared<AccuracyArguments>();
  add_study_options(command, arguments->study);
  command.add_option("--within", arguments->within, "the cheapest setting with at most this error, e.g. 0.1%");
  command.add_option("--budget", arguments->budget, "the most exact setting for this processor time, e.g. 50ms");
  command.add_option("--figure", arguments->figure,
                     "the figure that this is about (default: the largest peak torque, else δ)");
  command.add_option("--methods", arguments->methods, "only these, e.g. dop853 esdirk (default: all that apply)");
  command.add_option("--tolerances", arguments->tolerances, "only these, e.g. 1e-4 1e-8 (default: 1e-3 … 1e-12)");
  command.add_flag("--no-multibody", arguments->no_multibody, "leave Simbody's closed loop out, which takes longest");
  command.add_option("--time", arguments->time, "processor time that the study may take, about (default: 60 s)");
  command.action([&code, arguments] { code = accuracy(*arguments); });
}

const Verb verb{{.place = 110,
                 .name = "accuracy",
                 .arguments = "scene.toml",
                 .help = "what accuracy costs: error per time over methods, tolerances and models",
                 .does = "what accuracy costs: every integrator × tolerance × level of the model against references by "
                         "two independent methods, work–precision diagrams, Pareto front, conclusion in words; "
                         "`--within 0.1%` and `--budget 50ms` answer the inverse questions; `kurbel run scene.toml "
                         "--setting FILE` takes the cheapest setting of its summary that was exact enough",
                 .set_up = set_up}};

}  // namespace
}  // namespace kurbel::app::accuracy_command
