// finer_shafts.h — discretisation error of continuous shafts in a run: the same machine with finer shafts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "studies/findings/result.h"

namespace kurbel {

// Null: the machine was changed after reading, so that the scene does not describe it.
std::shared_ptr<const Model> with_finer_shafts(const Model& model);

// Adds the changes with finer shafts to the errors of a run's figures and states. Returns the largest change over its scale.
double add_shaft_errors(std::vector<Figure>& figures, std::vector<Figure>& states, const std::vector<Figure>& finer,
                        const std::vector<Figure>& finer_states);

// Notes on this error; `why` there is no such run, else empty.
std::vector<std::string> shaft_error_notes(double change, double accuracy, const std::string& why);

}  // namespace kurbel
