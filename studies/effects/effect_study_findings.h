// effect_study_findings.h — what is said of each effect: what it changes, what it costs.
#pragma once

#include "studies/effects/effect_study.h"
#include "studies/findings/output.h"

namespace kurbel {

// The study must outlive the findings.
Findings findings_of(const EffectStudy& study);

}  // namespace kurbel
