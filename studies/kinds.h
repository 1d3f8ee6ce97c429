// kinds.h — every component that a scene may hold.
#pragma once

#include <vector>

#include "engine/keys.h"

namespace kurbel {

// Drive first, mechanisms last.
const std::vector<Kind>& all_kinds();

// The table of all keys in Markdown, as docs/keys.md shows it.
std::string keys_in_markdown();

}  // namespace kurbel
