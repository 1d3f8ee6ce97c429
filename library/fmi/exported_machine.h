// exported_machine.h — the machine within an exported component: its scene as a document, its tables, its ports.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "engine/scene/document.h"
#include "mechanisms/reduced/reduced_mechanism.h"

namespace kurbel {

// A quantity that the importer sets while the machine runs.
struct ExportedInput {
  enum class What {
    command,  // of a motor, clutch or brake: replaces the operating sequence [1]
    torque,   // on a shaft, positive in its positive sense [N·m]
    speed     // of a shaft with prescribed speed: replaces the scene's [rad/s]
  };
  What what = What::command;
  std::string of = {};    // component, or shaft: "gearbox.out"
  std::string name = {};  // "brake.command", "flywheel.torque"
  double start = 0;
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool whole = false;  // only 0 or 1

  // The component that receives the value: an element that exerts a torque or follows a speed is a component of its own.
  std::string target() const;
};

// A number of the scene that the importer may change.
struct ExportedParameter {
  std::string path = {};  // "main_coupling.stiffness", "gearbox.stages[2].module"
  std::string unit = {};  // SI, as in a scene
  std::string doc = {};
  double start = 0;
  bool tunable = false;  // the machine keeps its states when the value changes
};

struct ExportedMachine {
  std::string name = {}, title = {}, token = {}, version = {};
  std::string file = {};     // of the scene, within resources/
  std::string effects = {};  // as in --effects; empty: the scene's
  DocumentValue document = {};
  bool model_exchange = true, co_simulation = true;
  std::vector<ExportedInput> inputs = {};
  std::vector<ExportedParameter> parameters = {};
  std::vector<std::string> outputs = {}, peaks = {};  // channels, and extremes within a communication step
  TableBook tables = {};

  // As JSON with exact numbers, and back. from_text throws std::invalid_argument for any other text.
  std::string text() const;
  static ExportedMachine from_text(const std::string& text);
};

}  // namespace kurbel
