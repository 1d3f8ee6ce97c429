// kinds.h — what drives: motors, engines, governors, torques given as functions, as a scene may name them.
#pragma once

#include <vector>

#include "engine/scene/keys.h"

namespace kurbel {

std::vector<Kind> dc_kinds();
std::vector<Kind> engine_kinds();
std::vector<Kind> fluid_motor_kinds();
std::vector<Kind> motor_kinds();
std::vector<Kind> governor_kinds();
std::vector<Kind> source_kinds();

}  // namespace kurbel
