// kinds.h — the kinds of executive mechanisms, each with its table of keys.
#pragma once

#include <vector>

#include "engine/scene/keys.h"

namespace kurbel {

std::vector<Kind> mechanism_kinds();

// One file each.
Kind four_bar_kind();
Kind knuckle_press_kind();
Kind linkage_kind();
Kind quick_return_kind();
Kind slider_crank_kind();
Kind slotted_lever_kind();

}  // namespace kurbel
