// simbody_module.h — what is linked with Simbody: a module within the program, loaded when a mechanism's bodies are first needed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanisms/bodies/mechanism_tree.h"
#include "mechanisms/bodies/multibody_run.h"

namespace kurbel {

// make_bodies, run_multibody and multibody_integrators, as the module has them.
struct SimbodyModule {
  std::unique_ptr<MechanismBodies> (*bodies)(const BodiesOf&);
  MultibodyResult (*run)(const MultibodyProblem&);
  std::vector<std::string> (*integrators)();
};

namespace simbody {
MultibodyResult run_multibody(const MultibodyProblem& problem);
std::vector<std::string> multibody_integrators();
}  // namespace simbody

}  // namespace kurbel
