// kinds.h — inertias and resistances, as a scene may name them.
#pragma once

#include <vector>

#include "engine/scene/keys.h"

namespace kurbel {

std::vector<Kind> inertia_kinds();
std::vector<Kind> load_kinds();

}  // namespace kurbel
