// add_kind.h — registers further kinds of components, for programs with user-defined elements.
#pragma once

#include "engine/scene/keys.h"

namespace kurbel {

// Registers a kind for all scenes read from now on; scenes read before are unaffected. Throws std::invalid_argument
// if a kind of this name exists. Safe to call from several threads.
void add_kind(Kind kind);

}  // namespace kurbel
