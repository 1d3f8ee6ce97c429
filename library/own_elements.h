// own_elements.h — what elements of one's own share: from declared parameters to the keys of a scene, and back.
#pragma once

#include <kurbel/elements.h>

#include <string>
#include <vector>

#include "engine/scene/keys.h"

namespace kurbel {

// Throws std::invalid_argument for a name that stands twice or among `others`, and for a unit that is none.
std::vector<Key> keys_of_parameters(const std::string& kind, const std::vector<Parameter>& parameters,
                                    const std::vector<Key>& others);

// Of one component.
Parameters parameters_of(const Section& section, const std::vector<Parameter>& declared);

}  // namespace kurbel
