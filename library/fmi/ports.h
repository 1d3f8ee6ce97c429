// ports.h — from an exported machine to its model with the inputs and outputs of its importer.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/reading/read_scene.h"
#include "library/fmi/exported_machine.h"

namespace kurbel {

// Kinds of components that an exported machine may contain: those compiled into its run-time.
const std::vector<Kind>& exported_kinds();

// The scene with these parameter values, in their order. `folder` contains its files. Throws SceneError.
Scene scene_of(const ExportedMachine& machine, const std::string& folder, std::span<const double> parameters);

// The machine with these inputs from its start on; tables are taken from the book if present there. Throws SceneError
// if no machine can be made.
std::shared_ptr<const Model> model_of(ExportedMachine& machine, const Scene& scene, std::span<const double> inputs);

// The node of a shaft by name: "flywheel", "gearbox.out".
int node_of(const Network& network, const std::string& shaft);

// For each input its index among the model's commands.
std::vector<std::size_t> commands_of(const ExportedMachine& machine, const Model& model);

// Finds a number of a scene by its path; null: not found.
struct FoundNumber {
  const Setting* setting = nullptr;
  const Key* key = nullptr;
};
FoundNumber number_at(const Scene& scene, const std::string& path);

}  // namespace kurbel
