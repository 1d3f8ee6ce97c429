// run_claims.h — claims of a run that precede its figures: does the machine run, are its figures confirmed, are its
// limits kept?
#pragma once

#include <optional>
#include <string>

#include "studies/findings/result.h"
#include "studies/limits/verdicts.h"

namespace kurbel {

// How long a period of the steady motion is, `cycle` [rad] of the link: "3 turns", "2 cycles", "1.1 s"; empty: one cycle.
std::string period_in_words(const Periods& periods, double cycle);

// Does it run, and is that confirmed? Faults of the motion (Result::claims), otherwise its final motion in a
// sentence. `whose`: prefix where models are compared: "elastic model: ".
Claims run_claims(const Result& result, const std::string& whose = {});

// Steady motion loads a motor by `use` times its rated torque or current; none for a motor with a duty in the scene:
// that is assessed separately.
std::optional<Claim> overload_claim(const Model& model, const std::string& motor, const Estimate& use, bool by_torque,
                                    const std::string& of = "its steady motion");

}  // namespace kurbel
