// export_machine.h — a scene as a component of FMI 2.0 or 3.0: checked, described, packed.
#pragma once

#include <string>
#include <vector>

#include "engine/run/run.h"
#include "library/fmi/exported_machine.h"
#include "library/fmi/variables.h"

namespace kurbel {

enum class ExportKind { both, co_simulation, model_exchange };

struct ExportRequest {
  int fmi = 3;
  ExportKind kind = ExportKind::both;
  std::vector<std::string> inputs, parameters, outputs;
  std::string effects, name;
};

// A component before it is packed.
struct ExportedComponent {
  ExportedMachine machine;
  double until = 0, accuracy = 0;  // of the scene's run [s]
  ExportedView view;
  ExportedDependencies dependencies;
};

// Throws SceneError for a scene that makes no machine, std::invalid_argument with the reason for what cannot be exported.
ExportedComponent component_of(const Scene& scene, const ExportRequest& asked);

// The archive. `fmi` 2 or 3.
std::string packed(const ExportedComponent& component, int fmi, const std::string& scene_folder);

// Throws std::invalid_argument for a unit that neither version can describe.
std::string model_description(const ExportedComponent& component, int fmi);

}  // namespace kurbel
