// modes_findings.h — what is said of modes, critical speeds, forced response and a torque's spectrum.
#pragma once

#include "studies/findings/output.h"
#include "studies/modes/modes.h"

namespace kurbel {

// Files: mode_shapes.csv, and forced_response.csv where a range of speeds was swept. The study must outlive the findings.
Findings findings_of(const ModesStudy& study);

}  // namespace kurbel
