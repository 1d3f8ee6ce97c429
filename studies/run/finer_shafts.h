// finer_shafts.h — what the cut of continuous shafts leaves open in a run: the same machine, cut finer.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "studies/findings/result.h"

namespace kurbel {

// Null: the machine was changed by hand, and the scene does not tell of it.
std::shared_ptr<const Model> with_finer_shafts(const Model& model);

// Into the errors of a run's figures and states: what a finer cut changes. Returns the largest change over its scale.
double add_shaft_errors(std::vector<Figure>& figures, std::vector<Figure>& states, const std::vector<Figure>& finer,
                        const std::vector<Figure>& finer_states);

// What is told of it: `why` there is no such run, else empty.
std::vector<std::string> shaft_error_notes(double change, double accuracy, const std::string& why);

}  // namespace kurbel
