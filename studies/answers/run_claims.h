// run_claims.h — what a run claims before any figure: does the machine run, are its figures sure, does it bear what it
// brings?
#pragma once

#include <optional>
#include <string>

#include "studies/findings/result.h"
#include "studies/limits/verdicts.h"

namespace kurbel {

// Does it run, and is that sure? Bad news of the motion (Result::claims), else what it comes to, in a sentence.
// `whose`: before each, where models are compared: "elastic model: ".
Claims run_claims(const Result& result, const std::string& whose = {});

// A motor that steady motion uses beyond its rated torque, or current, `use` times; none of one that states a duty: that is
// judged.
std::optional<Claim> overload_claim(const Model& model, const std::string& motor, const Estimate& use, bool by_torque,
                                    const std::string& of = "its steady motion");

}  // namespace kurbel
