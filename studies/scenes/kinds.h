// kinds.h — every component that a scene may hold, for whoever reads one.
#pragma once

#include <string>
#include <vector>

#include "engine/reading/read_scene.h"

namespace kurbel {

// Drive first, mechanisms last.
const std::vector<Kind>& all_kinds();

// The table of all keys in Markdown, as docs/keys.md shows it.
std::string keys_in_markdown();

// What keys_of knows: every kind of component, what stands inside them, and "run".
std::vector<std::string> names_of_keys();

// The keys of one kind as aligned text. Throws std::invalid_argument for another name.
std::string keys_of(const std::string& kind);

}  // namespace kurbel
