// effect_units.h — what can be switched in a scene, one by one: the elasticity of each component, and every effect that
// the scene has parameters for.
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
  std::string component = {};  // "main_coupling", that twists with it; empty: it is of no component
};

// All that the scene has parameters for.
std::vector<EffectUnit> effect_units(const Scene& scene);

// A set of units: on[k] belongs to units[k].
using EffectSet = std::vector<bool>;
EffectSet without(EffectSet set, std::size_t unit);
Effects effects_of(const Scene& scene, const std::vector<EffectUnit>& units, const EffectSet& on);
// As many of the units as one machine can have at once: what is part of the machine, then the scene's own effects,
// then what else goes with them (ideal joints with friction do not go with clearance in the same mechanism). `keep`
// comes before all but what is part of the machine. Where not even one unit makes a machine, nothing is on.
EffectSet fullest_set(const Scene& scene, const std::vector<EffectUnit>& units, std::optional<std::size_t> keep = {});

// How an effect is judged that does not go with the fullest set: by the fullest set that it goes with, with and without
// it. Nothing is on in `with` where it makes no machine at all.
struct InPlaceOf {
  EffectSet with, without;
  std::string gives_way;  // "joint clearance and flexible rod"
};
InPlaceOf in_place_of_others(const Scene& scene, const std::vector<EffectUnit>& units, const EffectSet& fullest,
                             std::size_t unit);

std::string describe(const std::vector<EffectUnit>& units, const EffectSet& on);  // "backlash and …", "none"
std::string joined_words(const std::vector<std::string>& words);                  // "a, b and c"
bool makes_machine(const Scene& scene, const Effects& effects);                   // the scene with these

// What a set of effects makes of the machine.
struct ModelSize {
  std::size_t states = 0, nonzeros = 0, guards = 0;
};
ModelSize size_of(const Model& model);

// The scene text with its [effects] replaced by these.
std::string with_effects(const Scene& scene, const std::vector<EffectUnit>& units, const EffectSet& on);

// A key whose value is a speed or a frequency, by its unit in the field table. Those of a part's own properties (at which
// speed friction falls, at which frequency a damping was measured) are none of operation.
bool is_speed(const Key& key);
bool is_of_a_part(const Key& key);

// Loads, or speeds (of motors, mains, governors, switching, start, steps of the sequence: all that is_speed and not
// is_of_a_part, and characteristics over the speed of what is no load), multiplied by a factor: held-out operating points. What was changed, in words;
// empty: nothing could be.
std::string scale_loads(Scene& scene, double factor);
std::string scale_speeds(Scene& scene, double factor);

}  // namespace kurbel
