// compare.h — the same scene with two sets of effects: how far apart are the answers, and what does each cost?
#pragma once

#include "studies/run/simulate.h"

namespace kurbel {

struct ComparisonRow {
  std::string name, unit;
  std::optional<double> a, a_error, b, b_error;
  double difference = 0;        // b − a
  std::optional<double> ratio;  // b/a
  QuantityKind what = QuantityKind::other;
  std::string of = {};
};

struct Comparison {
  std::string title;
  Result a, b;  // a: the simpler model
  std::vector<ComparisonRow> rows;
  std::vector<ComparisonRow> amplification;  // torque amplification factors: peak of b over peak of a
  std::vector<std::string> notes;
  std::string conclusion;
};

Comparison compare(const Scene& scene, const Effects& a, const std::string& label_a, const Effects& b,
                   const std::string& label_b, const SimulateOptions& options);

}  // namespace kurbel
