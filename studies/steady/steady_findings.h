// steady_findings.h — what is said of steady cycles: in words, tables, plots and files.
#pragma once

#include "studies/findings/output.h"
#include "studies/steady/steady.h"

namespace kurbel {

// Files: operating_points.csv, and steady.LABEL.csv per model with traces. The study must outlive the findings.
Findings findings_of(const SteadyStudy& study);

}  // namespace kurbel
