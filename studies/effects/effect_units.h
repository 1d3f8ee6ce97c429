// effect_units.h — what can be switched individually in a scene: the elasticity of each component, and every effect
// that the scene has parameters for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/scene/keys.h"
#include "engine/scene/scene.h"

namespace kurbel {

struct EffectUnit {
  std::string name;            // as in --effects: "elasticity:main_coupling", "backlash"
  std::string words;           // "elasticity of main_coupling"
  std::string component = {};  // "main_coupling", whose twist it is; empty: no component
};

// All that the scene has parameters for.
std::vector<EffectUnit> effect_units(const Scene& scene);

// A set of units: on[k] belongs to units[k].
using EffectSet = std::vector<bool>;
EffectSet without(EffectSet set, std::size_t unit);
Effects effects_of(const Scene& scene, const std::vector<EffectUnit>& units, const EffectSet& on);
// The largest set that one machine can have: parts of the machine, then the scene's own effects, then the other
// compatible units (ideal joints with friction exclude clearance in the same mechanism). `keep` has priority over all
// but the parts of the machine. All off if not even one unit makes a machine.
EffectSet fullest_set(const Scene& scene, const std::vector<EffectUnit>& units, std::optional<std::size_t> keep = {});

// Assessment of an effect that is incompatible with the fullest set: the fullest set compatible with it, with and
// without it. All off in `with` if it makes no machine at all.
struct InPlaceOf {
  EffectSet with, without;
  std::string gives_way;  // "joint clearance and flexible rod"
};
InPlaceOf in_place_of_others(const Scene& scene, const std::vector<EffectUnit>& units, const EffectSet& fullest,
                             std::size_t unit);

std::string describe(const std::vector<EffectUnit>& units, const EffectSet& on);  // "backlash and …", "none"
std::string joined_words(const std::vector<std::string>& words);                  // "a, b and c"
bool makes_machine(const Scene& scene, const Effects& effects);                   // the scene with these

// Size of the model with a set of effects.
struct ModelSize {
  std::ptrdiff_t states = 0, nonzeros = 0, guards = 0;  // of a difference, too
};
ModelSize size_of(const Model& model);

// The scene text with its [effects] replaced by these.
std::string with_effects(const Scene& scene, const std::vector<EffectUnit>& units, const EffectSet& on);

// A key whose value is a speed or a frequency, by its unit in the field table. Properties of a component (the speed
// at which friction falls, the frequency at which damping was measured) are not operating data.
bool is_speed(const Key& key);
bool is_of_a_part(const Key& key);

// Loads, or speeds (of motors, mains, governors, switching, start, sequence steps: all that is_speed and not
// is_of_a_part, and characteristics over speed other than loads), multiplied by a factor: held-out operating points.
// Returns what was changed, in words; empty: nothing.
std::string scale_loads(Scene& scene, double factor);
std::string scale_speeds(Scene& scene, double factor);

}  // namespace kurbel
