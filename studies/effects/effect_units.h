// effect_units.h — what can be switched in a scene, one by one: the elasticity of each component, and every effect that
// the scene has parameters for.
#pragma once

#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/scene/scene.h"

namespace kurbel {

struct EffectUnit {
  std::string name;   // as in --effects: "elasticity:main_coupling", "backlash"
  std::string words;  // "elasticity of main_coupling"
};

// All that the scene has parameters for.
std::vector<EffectUnit> effect_units(const Scene& scene);

// A set of units: on[k] belongs to units[k].
using EffectSet = std::vector<bool>;
Effects effects_of(const Scene& scene, const std::vector<EffectUnit>& units, const EffectSet& on);
std::string describe(const std::vector<EffectUnit>& units, const EffectSet& on);  // "backlash and …", "none"

// What a set of effects makes of the machine.
struct ModelSize {
  std::size_t states = 0, nonzeros = 0, guards = 0;
};
ModelSize size_of(const Model& model);

// The scene text with its [effects] replaced by these.
std::string with_effects(const Scene& scene, const std::vector<EffectUnit>& units, const EffectSet& on);

// Loads, or speeds of motors and start, multiplied by a factor: held-out operating points. What was changed, in words;
// empty: nothing could be.
std::string scale_loads(Scene& scene, double factor);
std::string scale_speeds(Scene& scene, double factor);

}  // namespace kurbel
