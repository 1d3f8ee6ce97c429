// accuracy_findings.h — what is said of the study of accuracy.
#pragma once

#include "studies/accuracy/accuracy.h"
#include "studies/findings/output.h"

namespace kurbel {

// Files: settings.csv. The study must outlive the findings.
Findings findings_of(const AccuracyStudy& study);

}  // namespace kurbel
