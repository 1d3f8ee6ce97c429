// run_command.cpp — run one model of a scene.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "app/question_command.h"
#include "app/terminal.h"
#include "app/verb.h"
#include "engine/model/model.h"
#include "engine/run/checkpoint.h"
#include "studies/accuracy/known_accuracy.h"
#include "studies/files/whole_file.h"
#include "studies/measured/measurement_options.h"
#include "studies/measured/overlay.h"
#include "studies/run/run_findings.h"
#include "studies/trials/run_options.h"
#include "studies/trials/trials_findings.h"

namespace kurbel::app::run_command {
namespace {

constexpr std::uintmax_t most_state_bytes = 256u << 20;

struct RunArguments {
  StudyOptions study;
  DeclaredOptions run, measurement;
  std::string setting, from_state, save_state;
  bool explain = false;
};

// Method and first tolerance from an accuracy study of the same text, if the user names its file.
void use_setting(const std::string& file, const Scene& scene, const Effects& effects, SimulateOptions& options) {
  if (file.empty()) return;
  if (options.method)
    throw std::invalid_argument(fmt::format(
        "--setting {}: chooses the method, and so does --method {}; give one of them", file, *options.method));
  if (scene.run.model != "reduced")
    throw std::invalid_argument(
        fmt::format("--setting {}: is of the reduced model; the scene says model = \"{}\"", file, scene.run.model));
  const KnownSetting known = known_setting(file, scene, effects, options.accuracy.value_or(scene.run.accuracy));
  options.method = known.method;
  options.first_tolerance = known.tolerance;
  options.chosen_because = known.describe();
}

std::string text_of_state(const std::string& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
    throw std::invalid_argument(
        fmt::format("--from-state {}: is no regular file; give one that --save-state wrote", file));
  if (!std::filesystem::is_regular_file(file, error))
    throw std::invalid_argument(fmt::format(
        "--from-state {}: no such file; kurbel run SCENE --until TIME --save-state {} writes one", file, file));
  if (std::filesystem::file_size(file) > most_state_bytes)
    throw std::invalid_argument(
        fmt::format("--from-state {}: larger than any state ({} MB)", file, most_state_bytes >> 20));
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Read before any computation; empty: not requested.
std::optional<Measurement> measurement_of(const MeasurementRequest& request, bool from_start, const Model& model,
                                          SimulateOptions& options) {
  if (!request.asked()) return {};
  const Scene& scene = model.scene;
  if (scene.run.model != "reduced")
    throw std::invalid_argument(
        "--measured: belongs to the reduced model, which records its channels; set model = "
        "\"reduced\"");
  Measurement measurement = read_measurement(request, channels_of_run(model));
  if (from_start) require_overlap(measurement, 0, options.until.value_or(scene.run.until));
  options.traces = true;
  return measurement;
}

// Findings of a run, compared with the record.
template <class Study>
int present(const Study& study, const std::optional<Overlay>& overlay, const RunArguments& arguments) {
  Findings findings = findings_of(study);
  if (overlay) show(findings, *overlay);
  return present({std::move(findings)}, arguments.study);
}

int run(const RunArguments& arguments) {
  const Scene scene = read(arguments.study);
  const RunAsked asked = run_options().read(arguments.run.given(), "run", scene);
  const Effects effects = asked.effects.value_or(scene.effects);
  const auto model = compile(scene, effects);
  if (arguments.explain) {
    say(model->explain());
    return exit_done;
  }
  Progress progress(arguments.study.quiet);
  SimulateOptions options = asked.simulation(inquiry_of(scene, arguments.study, progress));
  check_folder(arguments.study);
  use_setting(arguments.setting, scene, effects, options);
  if (!arguments.save_state.empty()) {
    if (const std::string why = why_no_file_at(arguments.save_state); !why.empty())
      throw std::invalid_argument(fmt::format("--save-state: {}", why));
    options.keep_state = true;
  }
  if (!arguments.from_state.empty()) options.go_on_from = text_of_state(arguments.from_state);
  if (scene.run.model != "reduced" && (options.keep_state || !options.go_on_from.empty()))
    throw std::invalid_argument("--from-state and --save-state belong to the reduced model; set model = \"reduced\"");
  const auto request = measurement_options().read(arguments.measurement.given(), "run", scene);
  const auto measurement = measurement_of(request, arguments.from_state.empty(), *model, options);
  Result result;
  try {
    result = simulate(model, is_elastic(*model) ? "elastic" : "rigid", options);
  } catch (const UnfitCheckpoint& unfit) {
    throw std::invalid_argument(fmt::format("--from-state {}: {}", arguments.from_state, unfit.what()));
  }
  if (!result.checkpoint.empty()) write_whole(arguments.save_state, result.checkpoint);
  std::optional<Overlay> overlay;
  if (!asked.trials) {
    if (measurement) overlay = lay_over(*measurement, result);
    return present(result, overlay, arguments);
  }
  WithTrials<Result> tried = with_trials(std::move(result), options);
  if (measurement) overlay = lay_over(*measurement, tried.study);
  return present(tried, overlay, arguments);
}

void set_up_run(OptionList& command, int& code) {
  const auto arguments = std::make_shared<RunArguments>();
  add_study_options(command, arguments->study);
  arguments->run.add_to(command, run_options().declared());
  command.add_flag("--explain", arguments->explain,
                   "print what is merged, the coordinates and their inertias, and stop");
  command.add_option("--setting", arguments->setting,
                     "method and tolerance from this summary.json, which kurbel accuracy wrote for the same scene: the "
                     "fastest that was accurate enough");
  command.add_option("--save-state", arguments->save_state,
                     "writes the state at the end into this file, for --from-state");
  arguments->measurement.add_to(command, measurement_options().declared());
  command.add_option("--from-state", arguments->from_state,
                     "continues from a state that --save-state wrote, of this machine; parameters may differ");
  command.action([&code, arguments] { code = run(*arguments); });
}

const Verb run_verb{
    {{.place = 10,
      .name = "run",
      .arguments = "scene.toml",
      .help = "simulate a scene",
      .does = "simulates; prints the conclusion and at most twelve key figures with units and measured errors "
              "(`--all`: all of them), writes `report.html`, `summary.json` and `trajectory.csv` into "
              "`results/SCENE/run`; short runs try the effects that are off, and report which would change a key "
              "figure, and compare with the rigid machine, whose curves are drawn in grey",
      .more =
          {"scene.toml --explain | what was merged, the coordinates and their inertias, and why",
           "scene.toml --until \"2 s\" --save-state warm.json | keeps the state at the end; `--from-state warm.json` "
           "goes on from there, in this scene or in one whose parameters differ, to the last bit the same each "
           "time",
           "scene.toml --measured test.csv --map \"T1=torque.main_coupling\" --shift fit | draws a measured record "
           "over the plots and computes the difference"}},
     set_up_run}};

}  // namespace
}  // namespace kurbel::app::run_command
