// accuracy_output.h — what accuracy costs as table, JSON, CSV and report with work–precision diagrams.
#pragma once

#include "studies/accuracy/accuracy.h"
#include "studies/findings/output.h"

namespace kurbel {

StudyOutput output_of(const AccuracyStudy& study);

}  // namespace kurbel
