// compare.h — the same scene with two sets of effects: difference of the results, and cost of each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/run/simulate.h"

namespace kurbel {

struct ComparisonRow {
  std::string name, unit;
  std::optional<Estimate> a, b;
  double difference = 0;        // b − a
  std::optional<double> ratio;  // b/a
  QuantityKind what = {};
  std::string of = {};
};

// Two models of one scene, a the simpler one. Their labels say what differs:
//   rigid, elastic   elasticity alone (engine/scene/effects.h says what that is)
//   bare, full       all effects of the scene; bare, second: the requested ones
//   rigid, same      nothing: the scene has no effect
//   first, second    any requested effects
struct ModelPair {
  Effects a, b;
  std::string label_a, label_b;
};

// Whether the model has an elastic part: a spring between two shafts, or a flexible rod. Slipping clutches are no springs.
bool is_elastic(const Model& model);

// The effects of the elastic model without elasticity and otherwise unchanged, including torque lag of motors.
Effects rigid_twin(const Model& elastic);

// Effects of comparable models. `effects` are those of b; unset: those of the scene, with all elasticity if it has
// none on. `against` are those of a; unset: those of b's rigid twin, so that only elasticity differs; if nothing of b
// is elastic, the bare machine. Throws SceneError if no machine can be made, std::invalid_argument if both requested
// models are the same.
ModelPair models_to_compare(const Scene& scene, const std::optional<Effects>& effects = {},
                            const std::optional<Effects>& against = {});

struct Comparison {
  std::string title;
  Result a, b;               // a: the simpler model
  std::string in_both;       // effects that both models have: "joint friction"; "none"
  bool lag_in_both = false;  // the torque lag of motors among them
  std::vector<ComparisonRow> rows;
  std::vector<ComparisonRow> amplification;  // torque amplification factors: peak of b over peak of a
  std::vector<std::string> notes;
  std::string conclusion;
};

Comparison compare(const Scene& scene, const ModelPair& models, const SimulateOptions& options);

}  // namespace kurbel
