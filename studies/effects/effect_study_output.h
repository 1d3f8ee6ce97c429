// effect_study_output.h — what each effect changes and costs, as a table, JSON and a report.
#pragma once

#include "studies/effects/effect_study.h"
#include "studies/findings/output.h"

namespace kurbel {

// The study must outlive the output.
StudyOutput output_of(const EffectStudy& study);

}  // namespace kurbel
