// advise_findings.h — what is said of the recommended set of effects.
#pragma once

#include "studies/advise/advise.h"
#include "studies/findings/output.h"

namespace kurbel {

// The advice must outlive the findings.
Findings findings_of(const Advice& advice);

}  // namespace kurbel
