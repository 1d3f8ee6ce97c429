// modes_output.h — words, tables, JSON and report of the drive's modes.
#pragma once

#include "studies/findings/output.h"
#include "studies/modes/modes.h"

namespace kurbel {

// The report refers to the study, which must outlive it.
StudyOutput output_of(const ModesStudy& modes);

}  // namespace kurbel
