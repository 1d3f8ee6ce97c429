// exported_machine.h — a machine as an exported component carries it: its scene as a document, its tables, its ports.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "engine/scene/document.h"
#include "mechanisms/reduced/reduced_mechanism.h"

namespace kurbel {

// What somebody else sets while the machine runs.
struct ExportedInput {
  enum class What {
    command,  // of a motor, clutch or brake: in the place of the operating sequence [1]
    torque,   // on a shaft, positive in its positive sense [N·m]
    speed     // of a shaft whose speed is prescribed, in the place of the scene's [rad/s]
  };
  What what = What::command;
  std::string of = {};    // component, or shaft: "gearbox.out"
  std::string name = {};  // "brake.command", "flywheel.torque"
  double start = 0;
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool whole = false;  // 0 or 1, nothing between

  // What is commanded: the element that exerts a torque, or follows a speed, has a component of its own.
  std::string target() const;
};

// A number of the scene that may be another one.
struct ExportedParameter {
  std::string path = {};  // "main_coupling.stiffness", "gearbox.stages[2].ratio"
  std::string unit = {};  // SI, as in a scene
  std::string doc = {};
  double start = 0;
  bool tunable = false;  // the machine has the same states with another value
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

  // As JSON, whose numbers are exact, and back. from_text throws std::invalid_argument for what is no such text.
  std::string text() const;
  static ExportedMachine from_text(const std::string& text);
};

}  // namespace kurbel
