// advise_output.h — the recommended set of effects as a table, JSON and a report.
#pragma once

#include "studies/advise/advise.h"
#include "studies/findings/output.h"

namespace kurbel {

// The advice must outlive the output.
StudyOutput output_of(const Advice& advice);

}  // namespace kurbel
