// off_effects.h — effects that have data in the scene but are off, and how they are switched on for a trial.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/scene/scene.h"

namespace kurbel {

// An effect switched on in one trial.
struct OffEffect {
  std::string name;            // as after --effects: "gear_losses", "elasticity:belt,backlash"
  std::string words;           // "gear losses", "elasticity of belt and backlash"
  Effects effects;             // of the trial: those of the run, and this one
  std::string gives_way = {};  // incompatible effects of the run, off in the trial: "joint friction"
};

// Elasticity is one effect, of all components that are unnecessarily rigid; if they make no machine together, one
// effect each. Effects that require an elastic connection (backlash, mesh variation, relaxation) are combined with
// the elasticity of the components that have their data, unless one of them is elastic already. Effects in joints of
// mechanisms come last, as they cost most. Simbody in the loop is excluded, being the same physics.
std::vector<OffEffect> effects_that_are_off(const Scene& scene, const Effects& on);

// The machine of a trial. If the run's other effects are not all compatible, as many as possible, in the order of the
// list of effects: `gives_way` and `effects` are set accordingly. Throws SceneError if no machine can be made.
std::shared_ptr<const Model> machine_with(const Scene& scene, const Effects& on, OffEffect& effect);

}  // namespace kurbel
