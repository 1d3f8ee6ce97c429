// ports.h — from an exported machine to its model, with what somebody else may set and see.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/reading/read_scene.h"
#include "library/fmi/exported_machine.h"

namespace kurbel {

// Components that an exported machine may hold: those that are compiled into its run-time.
const std::vector<Kind>& exported_kinds();

// The scene with these values of the parameters, in their order. `folder` holds its files. Throws SceneError.
Scene scene_of(const ExportedMachine& machine, const std::string& folder, std::span<const double> parameters);

// The machine with its inputs at these values from its start on; its tables from the book, where they are in it. Throws
// SceneError where no machine is made.
std::shared_ptr<const Model> model_of(ExportedMachine& machine, const Scene& scene, std::span<const double> inputs);

// Of a shaft by its name: "flywheel", "gearbox.out".
int node_of(const Network& network, const std::string& shaft);

// Of each input, its place among the model's commands.
std::vector<std::size_t> commands_of(const ExportedMachine& machine, const Model& model);

// Finds a number of a scene by its path; null: there is none.
struct FoundNumber {
  const Setting* setting = nullptr;
  const Key* key = nullptr;
};
FoundNumber number_at(const Scene& scene, const std::string& path);

}  // namespace kurbel
