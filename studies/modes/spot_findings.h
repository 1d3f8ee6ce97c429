// spot_findings.h — what is said of spot checks: a line each, a table, marks on the curves of the response.
#pragma once

#include <vector>

#include "studies/findings/findings.h"
#include "studies/modes/modes.h"

namespace kurbel::modes {

void say_spots(Findings& findings, Chapter in, const ModesStudy& study);
// Peaks of a joint in the nonlinear cycles, over the speed.
void mark_spots(const ModesStudy& study, std::size_t joint, Plot& plot);

}  // namespace kurbel::modes
