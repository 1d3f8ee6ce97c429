// kinds.h — what sticks and slips: clutches and brakes, belts, bearings, as a scene may name them.
#pragma once

#include <vector>

#include "engine/scene/keys.h"

namespace kurbel {

std::vector<Kind> clutch_kinds();
std::vector<Kind> belt_kinds();
std::vector<Kind> bearing_kinds();

}  // namespace kurbel
