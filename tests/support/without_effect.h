// without_effect.h — a scene without the data of an effect.
#pragma once

#include <string>

#include "engine/scene/scene.h"

namespace kurbel::test {

// Removes all keys that parametrise the effect from a section and its nested sections; required keys and those with a
// default stay.
inline void erase_effect(Section& section, const std::string& effect) {
  std::erase_if(section.settings, [&](const Setting& setting) {
    const Key* const key = section.kind->key(setting.key);
    return key && key->gives(effect) && key->fallback.empty() && !key->required;
  });
  for (Setting& setting : section.settings)
    for (Section& nested : setting.sections) erase_effect(nested, effect);
}
inline void erase_effect(Scene& scene, const std::string& effect) {
  for (Section& section : scene.components) erase_effect(section, effect);
}

}  // namespace kurbel::test
