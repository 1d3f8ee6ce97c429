// run_options.h — options of a run, as the questions have them that make one.
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

  // Throws std::invalid_argument for a method that the scene's model does not have.
  SimulateOptions simulation(const Inquiry& inquiry) const;
};

const OptionsOf<RunAsked>& run_options();

}  // namespace kurbel
