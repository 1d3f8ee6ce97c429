// steady_output.h — steady cycles as a table for people, JSON and CSV for programs, and a report.
#pragma once

#include "studies/findings/output.h"
#include "studies/steady/steady.h"

namespace kurbel {

// Files: operating_points.csv, and steady.LABEL.csv per model with traces. The study must outlive the output.
StudyOutput output_of(const SteadyStudy& study);

}  // namespace kurbel
