// effect_study.h — change and cost of each effect: the full model against the model without that effect. An effect
// that is incompatible with others is assessed in a model without those.
#pragma once

#include <string>
#include <vector>

#include "studies/effects/effect_units.h"
#include "studies/findings/figure_changes.h"
#include "studies/findings/output.h"
#include "studies/variants/variant_runs.h"

namespace kurbel {

// The run without the effect; `failed`: why the machine cannot run without it.
struct OmittedEffect : VariantRun {
  EffectUnit effect = {};
  std::vector<FigureChange> changes = {};  // of the figures that both runs have, the greatest first
  ModelSize saved = {};                    // states, nonzeros, guards that the effect adds
  long events_added = 0;
  double time_ratio = 0;  // processor time of the full model over that without
  // The incompatible effects, in words: the effect is assessed in the model without them, with and without it. Empty:
  // it is part of the full model.
  std::string in_place_of = {};
};

struct EffectStudy : SceneStudy {
  std::vector<EffectUnit> units;
  Result full;
  ModelSize size;
  std::vector<OmittedEffect> omitted;  // ranked by their greatest change
};

// Two runs, of the fullest machine that has the unit and of the same without it: for a unit that is off in `fullest`.
OmittedEffect study_in_place_of_others(const Scene& scene, const std::vector<EffectUnit>& units,
                                       const EffectSet& fullest, std::size_t unit, const VariantRuns& runs);

// Throws std::invalid_argument if the scene has no effect that can be switched off.
EffectStudy study_effects(const Scene& scene, const SimulateOptions& options);

// The study must outlive the findings.
Findings findings_of(const EffectStudy& study);

}  // namespace kurbel
