// classical.h — the classical assumption: the rigid machine at constant speed tells all torques. Where it holds, and what it
// leaves out of a scene.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/orbit/moment.h"

namespace kurbel {

// Nothing but what is part of the machine; clutches count as locked.
Effects classical_effects(const Scene& scene);

// What of the scene, beyond elasticity, a machine of one angle and its speed cannot carry: "gear losses", "\"clutch\",
// which may slip". Empty: it carries all.
std::vector<std::string> beyond_the_rigid_machine(const Scene& scene, const Moment& at = {});

// A scene that is already as of a moment (as_of), its sources and loads as they are then, too.
std::shared_ptr<const Model> compile_at(const Scene& scene, const Effects& effects, const Moment& at);

}  // namespace kurbel
