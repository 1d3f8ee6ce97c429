// classical.h — the classical assumption: all torques follow from the rigid machine at constant speed. Its validity,
// and what it omits of a scene.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/orbit/moment.h"
#include "engine/rigid/rigid_machine.h"

namespace kurbel {

// Only the effects that are part of the machine; clutches count as locked.
Effects classical_effects(const Scene& scene);

// Parts of the scene, beyond elasticity, that a machine of one angle and its speed cannot represent: "gear losses",
// "\"clutch\", which may slip". Empty: it represents all.
std::vector<std::string> beyond_the_rigid_machine(const Scene& scene, const Moment& at = {});

// Compiles a scene already as of a moment (as_of), with its sources and loads at that time.
std::shared_ptr<const Model> compile_at(const Scene& scene, const Effects& effects, const Moment& at);

// Angle of the reduction link at the scene's start [rad]; angles of single components are not considered.
double reduction_angle_at_start(const Model& model);

// Part of its arc, about the middle, over which a rocking crank is examined unless another range is given: towards
// the ends quantities reduced to it grow without bound, as 1/(distance to the end).
inline constexpr double share_of_arc = 0.95;
// Angles of the reduction link over which no rocking crank of a model leaves that part of its arc, near the scene's start;
// empty: all cranks turn fully. Throws std::invalid_argument if a `given` range leaves an arc, or if there is none.
std::optional<AngleRange> rocking_range(const Model& model, const std::optional<AngleRange>& given);

// Motion from which torques and inertia are taken.
enum class CycleBasis {
  classical,  // the rigid machine at successive positions, at constant speed
  steady      // the machine's steady cycle with the scene's effects
};

// The machine of a study of the cycle.
class MachineOnBasis {
 protected:
  // On the basis wanted; default: classical if the rigid machine represents all but elasticity, or if no cycle is needed.
  CycleBasis choose_basis(const Scene& scene, const Moment& at, std::optional<CycleBasis> wanted,
                          bool needs_cycle = true);
  void make_rigid(const Scene& scene, const Moment& at);
  const Model& model() const { return machine_ ? machine_->model() : *model_; }

  std::optional<RigidMachine> machine_;  // of the classical basis
  std::shared_ptr<const Model> model_;   // of the steady motion's
  std::vector<std::string> beyond_;      // what the rigid machine cannot represent
};

}  // namespace kurbel
