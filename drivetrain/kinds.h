// kinds.h — the kinds of components of the drive, each with its table of keys.
#pragma once

#include <vector>

#include "engine/scene/keys.h"

namespace kurbel {

std::vector<Kind> drivetrain_kinds();

}  // namespace kurbel
