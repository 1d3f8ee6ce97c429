// run_question.h — one run of a scene: its trials if requested, and a measured record compared with it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "studies/measured/overlay.h"
#include "studies/question/question.h"
#include "studies/trials/trials.h"

namespace kurbel {

// Of a run, shared by the questions that perform one.
struct RunRequest {
  std::optional<Effects> effects;
  std::optional<double> accuracy, until;  // [1], [s]
  std::optional<std::string> method;
  bool measure_error = true, trials = true;

  // Throws std::invalid_argument for a method unavailable for the scene's model.
  SimulateOptions simulation(const Inquiry& inquiry) const;
};

const OptionsOf<RunRequest>& run_options();

struct SingleRunRequest : RunRequest {
  MeasurementRequest measured;
  std::string setting, save_state, from_state;  // files
  std::string state;                            // text of the checkpoint from which the run continues
  bool explain = false;
};
const OptionsOf<SingleRunRequest>& single_run_options();

struct SingleRun {
  WithTrials<Result> tried;
  bool has_trials = false;
  std::optional<Overlay> overlay = {};
};
// Throws std::invalid_argument for options that do not go together, SceneError for errors of the scene; a run that
// fails is returned incomplete.
std::shared_ptr<const SingleRun> single_run(const Inquiry& inquiry, const SingleRunRequest& asked);
StudyOutput output_of(const std::shared_ptr<const SingleRun>& run);

}  // namespace kurbel
