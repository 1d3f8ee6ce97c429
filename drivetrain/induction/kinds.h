// kinds.h — induction motors, as a scene may name them.
#pragma once

#include <vector>

#include "engine/scene/keys.h"

namespace kurbel {

std::vector<Kind> induction_kinds();

}  // namespace kurbel
