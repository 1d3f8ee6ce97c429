// run_question.cpp — kurbel run: one model of a scene.
#include "studies/trials/run_question.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "engine/model/model.h"
#include "engine/run/checkpoint.h"
#include "studies/accuracy/known_accuracy.h"
#include "studies/files/whole_file.h"
#include "studies/measured/measurement_options.h"
#include "studies/run/run_findings.h"
#include "studies/trials/trials_findings.h"

namespace kurbel {
namespace {

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

void read_state(SingleRunRequest& asked, const OptionValues& given) {
  constexpr std::uintmax_t most_bytes = 256u << 20;
  const std::string& file = asked.from_state = given.text();
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw std::invalid_argument(fmt::format(
        "--from-state {}: no such file; kurbel run SCENE --until TIME --save-state {} writes one", file, file));
  if (!std::filesystem::is_regular_file(file, error))
    throw std::invalid_argument(
        fmt::format("--from-state {}: is no regular file; give one that --save-state wrote", file));
  if (std::filesystem::file_size(file) > most_bytes)
    throw std::invalid_argument(fmt::format("--from-state {}: larger than any state ({} MB)", file, most_bytes >> 20));
  std::ifstream in(file, std::ios::binary);
  asked.state = {std::istreambuf_iterator<char>(in), {}};
}

// Read before any computation; empty: not requested.
std::optional<Measurement> measurement_of(const SingleRunRequest& asked, const Model& model) {
  if (!asked.measured.asked()) return {};
  Measurement measurement = read_measurement(asked.measured, channels_of_run(model));
  if (asked.state.empty()) require_overlap(measurement, 0, asked.until.value_or(model.scene.run.until));
  return measurement;
}

SimulateOptions simulation_of(const Inquiry& inquiry, const SingleRunRequest& asked, const Effects& effects) {
  SimulateOptions options = asked.simulation(inquiry);
  use_setting(asked.setting, inquiry.scene, effects, options);
  if (!asked.save_state.empty())
    if (const std::string why = why_no_file_at(asked.save_state); !why.empty())
      throw std::invalid_argument(fmt::format("--save-state: {}", why));
  options.keep_state = !asked.save_state.empty();
  options.go_on_from = asked.state;
  if (asked.measured.asked()) options.traces = true;
  if (inquiry.scene.run.model == "reduced") return options;
  if (options.keep_state || !options.go_on_from.empty())
    throw std::invalid_argument("--from-state and --save-state belong to the reduced model; set model = \"reduced\"");
  if (asked.measured.asked())
    throw std::invalid_argument(
        "--measured: belongs to the reduced model, which records its channels; set model = \"reduced\"");
  return options;
}

StudyOutput run_of_scene(const Inquiry& inquiry, SingleRunRequest asked) {
  if (asked.explain) return in_words(compile(inquiry.scene, asked.effects.value_or(inquiry.scene.effects))->explain());
  return output_of(single_run(inquiry, asked));
}

}  // namespace

const OptionsOf<SingleRunRequest>& single_run_options() {
  static const auto made =
      OptionsOf<SingleRunRequest>()
          .add(run_options())
          .add({.name = "explain", .doc = "print what is merged, the coordinates and their inertias, and stop"},
               &SingleRunRequest::explain)
          .add({.name = "setting",
                .doc = "method and tolerance from this summary.json, which kurbel accuracy wrote for the same scene: "
                       "the fastest that was accurate enough"},
               &SingleRunRequest::setting)
          .add({.name = "save_state", .doc = "writes the state at the end into this file, for --from-state"},
               &SingleRunRequest::save_state)
          .add(measurement_options(), &SingleRunRequest::measured)
          .add({.name = "from_state",
                .doc = "continues from a state that --save-state wrote, of this machine; parameters may differ"},
               OptionForm::one, read_state);
  return made;
}

std::shared_ptr<const SingleRun> single_run(const Inquiry& inquiry, const SingleRunRequest& asked) {
  const Effects effects = asked.effects.value_or(inquiry.scene.effects);
  const auto model = compile(inquiry.scene, effects);
  const SimulateOptions options = simulation_of(inquiry, asked, effects);
  const std::optional<Measurement> measurement = measurement_of(asked, *model);
  const auto run = std::make_shared<SingleRun>();
  run->has_trials = asked.trials;
  Result& result = run->tried.study;
  try {
    result = simulate(model, is_elastic(*model) ? "elastic" : "rigid", options);
  } catch (const UnfitCheckpoint& unfit) {
    if (asked.from_state.empty()) throw;
    throw std::invalid_argument(fmt::format("--from-state {}: {}", asked.from_state, unfit.what()));
  }
  if (!result.checkpoint.empty() && !asked.save_state.empty()) write_whole(asked.save_state, result.checkpoint);
  if (asked.trials) run->tried = with_trials(std::move(result), options);
  if (measurement) run->overlay = lay_over(*measurement, result);
  return run;
}

StudyOutput output_of(const std::shared_ptr<const SingleRun>& run) {
  StudyOutput output{run->has_trials ? findings_of(run->tried) : findings_of(run->tried.study), {}, {}, run};
  if (run->overlay) show(output, *run->overlay);
  return output;
}

Question run_question() {
  return make_question(
      {.place = 10,
       .name = "run",
       .arguments = "scene.toml",
       .help = "simulate a scene",
       .does = "simulates; prints the conclusion and at most twelve key figures with units and measured errors "
               "(`--all`: all of them), writes `report.html`, `summary.json` and `trajectory.csv` into "
               "`results/SCENE/run`; short runs try the effects that are off, and report which would change a key "
               "figure, and compare with the rigid machine, whose curves are drawn in grey",
       .more = {"scene.toml --explain | what was merged, the coordinates and their inertias, and why",
                "scene.toml --until \"2 s\" --save-state warm.json | keeps the state at the end; `--from-state "
                "warm.json` goes on from there, in this scene or in one whose parameters differ, to the last bit the "
                "same each time",
                "scene.toml --measured test.csv --map \"T1=torque.main_coupling\" --shift fit | draws a measured "
                "record over the plots and computes the difference"}},
      single_run_options(), run_of_scene);
}

}  // namespace kurbel
