// idle_effects.h — effects that are on and have data but no influence, because another effect that they need is off.
#pragma once

#include <string>
#include <vector>

#include "engine/model/model.h"

namespace kurbel {

// One sentence for each component. Without variable inertia a mechanism is a crank of constant inertia without rod
// and joints, so that clearance and flexibility have no influence.
std::vector<std::string> idle_effects(const Model& model);

}  // namespace kurbel
