// off_effects.h — effects that a scene has data for and that are off, as they are switched on for a trial.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/scene/scene.h"

namespace kurbel {

// What one trial switches on.
struct OffEffect {
  std::string name;            // as behind --effects: "gear_losses", "elasticity:belt,backlash"
  std::string words;           // "gear losses", "elasticity of belt and backlash"
  Effects effects;             // of the trial: those of the run, and this
  std::string gives_way = {};  // what of the run's does not go with it and is off in the trial: "joint friction"
};

// Elasticity is one effect, of all components that are rigid and need not be; where they make no machine together, each
// is one. What only an elastic connection has (backlash, mesh variation, relaxation) goes with the elasticity of the
// components that have its data, unless one of them is elastic already. Those in joints of mechanisms come last: they
// cost most. Not Simbody in the loop, which is the same physics.
std::vector<OffEffect> effects_that_are_off(const Scene& scene, const Effects& on);

// The machine of a trial. Where the run's other effects do not all go with it, as many of them as do, in the order of
// the list of effects: then `gives_way` and `effects` say so. Throws SceneError where it makes no machine at all.
std::shared_ptr<const Model> machine_with(const Scene& scene, const Effects& on, OffEffect& effect);

}  // namespace kurbel
