// idle_effects.h — effects that are on and have data, and yet do nothing, as another one that is off takes them along.
#pragma once

#include <string>
#include <vector>

#include "engine/model/model.h"

namespace kurbel {

// A sentence for each component. Without variable inertia a mechanism is a crank of constant inertia: it has neither rod
// nor joints, so that clearance and flexibility go with it.
std::vector<std::string> idle_effects(const Model& model);

}  // namespace kurbel
