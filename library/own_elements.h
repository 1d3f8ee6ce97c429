// own_elements.h — shared by user-defined elements: from declared parameters to the keys of a scene, and back.
#pragma once

#include <kurbel/elements.h>

#include <string>
#include <vector>

#include "engine/scene/keys.h"

namespace kurbel {

// Throws std::invalid_argument for a name that is repeated or among `others`, and for an unknown unit.
std::vector<Key> keys_of_parameters(const std::string& kind, const std::vector<Parameter>& parameters,
                                    const std::vector<Key>& others);

// The parameters of one component.
Parameters parameters_of(const Section& section, const std::vector<Parameter>& declared);

}  // namespace kurbel
