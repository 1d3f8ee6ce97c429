// forces_findings.h — what is said of the forces of a slider-crank.
#pragma once

#include "studies/findings/output.h"
#include "studies/forces/forces.h"

namespace kurbel {

// Files: forces_prescribed.csv, forces_simulated.csv. The forces must outlive the findings.
Findings findings_of(const Forces& forces);

}  // namespace kurbel
