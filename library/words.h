// words.h — the meaning of a figure, in sentences for a terminal.
#pragma once

#include <string>

namespace kurbel {

// Throws std::invalid_argument for an unknown name, with the nearest ones.
std::string explained(const std::string& figure);

}  // namespace kurbel
