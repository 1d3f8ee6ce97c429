// words.h — what words mean, for whoever asks: what a figure is, in sentences for a terminal.
#pragma once

#include <string>

namespace kurbel {

// Throws std::invalid_argument for a name that is none, with those like it.
std::string explained(const std::string& figure);

}  // namespace kurbel
