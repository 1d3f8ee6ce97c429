// multibody.h — the rigid machine with Simbody's closed loop at every step: the reference for the reduced run.
#pragma once

#include "studies/run/simulate.h"

namespace kurbel {

// Throws SceneError unless the scene is one mechanism on one rigid shaft.
Result simulate_multibody(std::shared_ptr<const Model> model, const std::string& label, const SimulateOptions& options);

}  // namespace kurbel
