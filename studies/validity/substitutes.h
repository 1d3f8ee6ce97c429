// substitutes.h — substitutes for data that a scene does not give, or not in this form: diagrams of misfiring
// cylinders, flux lag of motors with unknown circuit, dense tables with fewer pieces.
#pragma once

#include <string>
#include <vector>

#include "engine/model/model.h"

namespace kurbel {

// One sentence each.
std::vector<std::string> substitutes(const Model& model);

}  // namespace kurbel
