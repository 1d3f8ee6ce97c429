// kinds.h — what joins two shafts: couplings, shafts, fluid couplings, as a scene may name them.
#pragma once

#include <vector>

#include "engine/scene/keys.h"

namespace kurbel {

std::vector<Kind> coupling_kinds();
std::vector<Kind> flexible_kinds();
std::vector<Kind> fluid_kinds();

}  // namespace kurbel
