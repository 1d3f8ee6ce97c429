// kinds.h — what turns rotation into translation, as a scene may name it.
#pragma once

#include <vector>

#include "engine/scene/keys.h"

namespace kurbel {

std::vector<Kind> translation_kinds();

}  // namespace kurbel
