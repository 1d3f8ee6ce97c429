// substitutes.h — notes on a model and its run: substitutes for data that a scene does not give, or not in this form (diagrams of misfiring
// cylinders, flux lag of motors with unknown circuit, dense tables with fewer pieces, the branch beyond a change point); effects without influence.
#pragma once

#include <string>
#include <vector>

#include "engine/model/model.h"

namespace kurbel {

// One sentence for each substitute.
std::vector<std::string> substitutes(const Model& model);
// One for each contact that chattered, by its name, and followed a law without events; a name may repeat.
std::vector<std::string> regularised(const std::vector<std::string>& contacts);

// Effects that are on and have data but no influence, because another effect that they need is off: one sentence for
// each component. Without variable inertia a mechanism is a crank of constant inertia without rod
// and joints, so that clearance and flexibility have no influence.
std::vector<std::string> idle_effects(const Model& model);

}  // namespace kurbel
