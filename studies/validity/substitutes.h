// substitutes.h — what stands for something that a scene does not give, or not so: diagrams of cylinders that do not fire, the
// lag of fluxes whose circuit is not known, dense tables by fewer pieces.
#pragma once

#include <string>
#include <vector>

#include "engine/model/model.h"

namespace kurbel {

// A sentence each.
std::vector<std::string> substitutes(const Model& model);

}  // namespace kurbel
