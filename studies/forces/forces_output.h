// forces_output.h — forces of a slider-crank as table, JSON, CSV and report.
#pragma once

#include "studies/findings/output.h"
#include "studies/forces/forces.h"

namespace kurbel {

// Files: forces_prescribed.csv and forces_simulated.csv. The forces must outlive the output.
StudyOutput output_of(const Forces& forces);

}  // namespace kurbel
