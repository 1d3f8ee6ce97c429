// accuracy_output.h — what accuracy costs as table, JSON, CSV and report with work–precision diagrams.
#pragma once

#include "studies/accuracy.h"
#include "studies/output.h"

namespace kurbel {

StudyOutput output_of(const AccuracyStudy& study);

}  // namespace kurbel
