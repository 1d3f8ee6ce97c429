// variables.h — the variables of an exported component in the order of their value references: description and
// run-time make the same list from the same model.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/run/recorders.h"
#include "library/fmi/exported_machine.h"

namespace kurbel {

struct ExportedVariable {
  enum class Role { time, input, parameter, output, peak, state, derivative, indicator };
  Role role = Role::time;
  std::size_t place = 0;                // index among those of its role
  std::string name, unit, description;  // unit: SI, as in a scene
};

// What an exported machine shows, according to its model.
struct ExportedView {
  // Throws std::invalid_argument if the model has no such channel or extreme.
  ExportedView(const ExportedMachine& machine, const Equations& equations);

  std::vector<ExportedVariable> variables;  // by value reference
  std::vector<Channel> outputs;
  std::vector<ExtremeOf> peaks;

  std::uint32_t reference(ExportedVariable::Role role, std::size_t place) const;
};

// Possible dependencies of a variable: from the sparsity pattern of the exact Jacobian, including couplings by active
// constraints, and from the places where inputs and laws over time act.
struct ExportedDependency {
  bool known = true;  // false: it may depend on anything
  bool time = false;
  std::vector<std::size_t> states = {}, inputs = {};  // ascending
};
struct ExportedDependencies {
  std::vector<ExportedDependency> derivatives, outputs;
};
ExportedDependencies dependencies_of(const ExportedMachine& machine, const ExportedView& view, Flow& flow);

}  // namespace kurbel
