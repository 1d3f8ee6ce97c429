// compare.h — the same scene with two sets of effects: how far apart are the answers, and what does each cost?
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

// Two models of one scene, a the simpler one. What they are called says what differs:
//   rigid, elastic   elasticity alone (engine/scene/effects.h says what that is)
//   bare, full       all effects of the scene; bare, second: those that were asked for
//   rigid, same      nothing: the scene has no effect
//   first, second    whatever was asked for
struct ModelPair {
  Effects a, b;
  std::string label_a, label_b;
};

// Something in the model gives way: a spring between two shafts, or a flexible rod. Clutches that slip are no springs.
bool is_elastic(const Model& model);

// Those of the elastic model with its elasticity taken away and nothing else: motors whose torque lags keep that.
Effects rigid_twin(const Model& elastic);

// Like for like. `effects` are those of b; unset: those of the scene, and with all of its elasticity where it has none on.
// `against` are those of a; unset: those of b's rigid twin, so that elasticity alone differs; where nothing of b
// is elastic, the bare machine. Throws SceneError where the scene makes no machine, std::invalid_argument where both
// models that were asked for are the same.
ModelPair models_to_compare(const Scene& scene, const std::optional<Effects>& effects = {},
                            const std::optional<Effects>& against = {});

struct Comparison {
  std::string title;
  Result a, b;          // a: the simpler model
  std::string in_both;  // effects that both models have: "joint friction"; "none"
  std::vector<ComparisonRow> rows;
  std::vector<ComparisonRow> amplification;  // torque amplification factors: peak of b over peak of a
  std::vector<std::string> notes;
  std::string conclusion;
};

Comparison compare(const Scene& scene, const ModelPair& models, const SimulateOptions& options);

}  // namespace kurbel
