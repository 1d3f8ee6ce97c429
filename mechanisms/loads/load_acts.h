// load_acts.h — whether a load is on: an operating sequence switches a mechanism's loads, together or each by itself.
#pragma once

#include "engine/elements/shaft_pool.h"

namespace kurbel {

// A sequence that sets a mechanism or its loads has a command for it, followed by one for each load.
inline bool acts(const ShaftPorts& at, const Instant& now, std::size_t load) {
  return at.command < 0 || now.command[at.command + 1 + static_cast<int>(load)] > 0.5;
}

}  // namespace kurbel
