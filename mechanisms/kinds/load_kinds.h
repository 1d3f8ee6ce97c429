// load_kinds.h — loads on a mechanism's output as a scene may name them.
#pragma once

#include <vector>

#include "engine/scene/keys.h"
#include "mechanisms/reduced/mechanism.h"

namespace kurbel {

const std::vector<Kind>& slider_load_kinds();  // outputs that slide
const std::vector<Kind>& rocker_load_kinds();  // outputs that rock

// Reads the `load` of a mechanism's section; its ends of travel must be known.
void read_loads(const Section& section, Mechanism& mechanism, Messages& messages);

}  // namespace kurbel
