// kinds.h — the executive mechanisms as a scene may name them, each with its table of keys.
#pragma once

#include <vector>

#include "engine/keys.h"

namespace kurbel {

std::vector<Kind> mechanism_kinds();

// Loads on a slider, for the docs.
const std::vector<Kind>& slider_load_kinds();

}  // namespace kurbel
