// kinds.h — the components of the drive as a scene may name them, each with its table of keys.
#pragma once

#include <vector>

#include "engine/scene/keys.h"

namespace kurbel {

std::vector<Kind> drivetrain_kinds();

}  // namespace kurbel
