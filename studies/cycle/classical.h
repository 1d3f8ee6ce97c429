// classical.h — the classical assumption: all torques follow from the rigid machine at constant speed. Its validity,
// and what it omits of a scene.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/orbit/moment.h"

namespace kurbel {

// Only the effects that are part of the machine; clutches count as locked.
Effects classical_effects(const Scene& scene);

// Parts of the scene, beyond elasticity, that a machine of one angle and its speed cannot represent: "gear losses",
// "\"clutch\", which may slip". Empty: it represents all.
std::vector<std::string> beyond_the_rigid_machine(const Scene& scene, const Moment& at = {});

// Compiles a scene already as of a moment (as_of), with its sources and loads at that time.
std::shared_ptr<const Model> compile_at(const Scene& scene, const Effects& effects, const Moment& at);

}  // namespace kurbel
