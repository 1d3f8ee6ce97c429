// add_kind.h — another kind of component, for programs that bring elements of their own.
#pragma once

#include "engine/scene/keys.h"

namespace kurbel {

// Known to all scenes that are read from now on; those that were read before keep theirs. Throws std::invalid_argument
// where a kind of this name is known. Safe to call from several threads.
void add_kind(Kind kind);

}  // namespace kurbel
