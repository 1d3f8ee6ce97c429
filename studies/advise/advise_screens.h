// advise_screens.h — quick estimates for one effect each, from the run of the full model and from its linearisation.
//
// activity ∫|τ dθ| over the driving work; amplitude of a torque; distance of the excitation orders from the modes;
// forced response at the operating point over the quasi-static one; torque reversals; share of losses. A screen only
// estimates; the choice is made by runs.
#pragma once

#include <string>
#include <vector>

#include "studies/effects/effect_units.h"
#include "studies/run/simulate.h"

namespace kurbel {

struct Screen {
  std::string name;     // "torque reversals"
  double number = 0;    // its result
  std::string verdict;  // in words, with the number
  bool needed = false;  // the effect is expected to matter at the tolerance
};

// Per unit; empty where no screen applies. `within`: relative deviation allowed.
std::vector<std::vector<Screen>> screens_of(const Scene& scene, const std::vector<EffectUnit>& units,
                                            const Result& full, double within);

}  // namespace kurbel
