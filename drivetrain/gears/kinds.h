// kinds.h — gears, as a scene may name them.
#pragma once

#include <vector>

#include "engine/scene/keys.h"

namespace kurbel {

std::vector<Kind> gearbox_kinds();
std::vector<Kind> gear_mesh_kinds();
std::vector<Kind> planetary_kinds();

}  // namespace kurbel
