// run_answers.h — what a run answers before any figure: does the machine run, are its figures sure, does it bear what it
// brings?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/findings/result.h"
#include "studies/limits/verdicts.h"

namespace kurbel {

// Does it run, and is that sure? Bad news of the motion (Result::answers), else what it comes to, in a sentence.
// `whose`: before each, where models are compared: "elastic model: ".
std::vector<Answer> run_answers(const Result& result, const std::string& whose = {});

// A motor that steady motion uses beyond its rated torque, or current; none of one that states a duty: that is judged.
std::optional<Answer> overload_answer(const Model& model, const std::string& motor, double use, bool by_torque,
                                      const std::string& of = "its steady motion");

// Nothing is rated, nothing is said. The worst by its value over its limit, with the value that would mend it.
std::vector<Answer> rating_answers(const std::vector<Verdict>& verdicts);

}  // namespace kurbel
