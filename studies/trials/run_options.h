// run_options.h — options of a run, shared by the questions that perform one.
#pragma once

#include <optional>
#include <string>

#include "studies/question/question.h"

namespace kurbel {

struct RunAsked {
  std::optional<Effects> effects;
  std::optional<double> accuracy, until;  // [1], [s]
  std::optional<std::string> method;
  bool measure_error = true, trials = true;

  // Throws std::invalid_argument for a method unavailable for the scene's model.
  SimulateOptions simulation(const Inquiry& inquiry) const;
};

const OptionsOf<RunAsked>& run_options();

}  // namespace kurbel
