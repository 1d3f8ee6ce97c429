// trials_findings.h — findings on effects that are off, after those of a run or of two models compared.
#pragma once

#include "studies/findings/findings.h"
#include "studies/trials/trials.h"

namespace kurbel {

// Smaller changes |relative| are reported together, in one line.
inline constexpr double least_worth_a_line = 1e-3;
// Larger changes appear in the conclusion.
inline constexpr double least_that_changes_the_answer = 0.02;

Findings findings_of(const WithTrials<Result>& run);
Findings findings_of(const WithTrials<Comparison>& comparison);

// One line for each effect that changes a key figure by more than the runs' errors; one for all others, one for those
// not tried. Empty if no effect is off.
std::vector<std::string> words_of(const Trials& trials, const SpeedUnit& speed);

}  // namespace kurbel
