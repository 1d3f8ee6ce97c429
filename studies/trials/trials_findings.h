// trials_findings.h — what is said of the effects that are off, behind what is said of a run or of two models compared.
#pragma once

#include "studies/findings/findings.h"
#include "studies/trials/trials.h"

namespace kurbel {

// Smaller changes are told together, in one line: |relative|.
inline constexpr double least_worth_a_line = 1e-3;
// From here on it stands in the conclusion.
inline constexpr double least_that_changes_the_answer = 0.02;

Findings findings_of(const WithTrials<Result>& run);
Findings findings_of(const WithTrials<Comparison>& comparison);

// A line for each effect that moves a key figure by more than the runs' errors; one for all that do not, one for all
// that were not tried. None where no effect is off.
std::vector<std::string> words_of(const Trials& trials, const SpeedUnit& speed);

}  // namespace kurbel
