// jacobians.h — the exact Jacobian of a scene against central differences of its flow; two scenes that must be one
// model.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/events/equations.h"
#include "engine/model/model.h"
#include "tests/support/scenes.h"

namespace kurbel::test {

// At the state that the scene starts from, in the modes that hold there. `relative`: of the largest entry of a row.
inline void expect_jacobian_is_that_of_the_flow(const std::string& text, double relative) {
  const Scene scene = scene_from(text);
  Equations equations(compile(scene, scene.effects), false);
  std::vector<double> y = equations.start(0);
  const std::size_t n = y.size();
  const SparsityPattern& pattern = equations.jacobian_pattern();
  std::vector<double> values(pattern.row.size()), up(n), down(n);
  equations.jacobian(0, y, values);
  std::vector<std::vector<double>> exact(n, std::vector<double>(n, 0.0)), found = exact;
  for (std::size_t column = 0; column < n; ++column)
    for (auto k = pattern.column_start[column]; k < pattern.column_start[column + 1]; ++k)
      exact[static_cast<std::size_t>(pattern.row[static_cast<std::size_t>(k)])][column] +=
          values[static_cast<std::size_t>(k)];
  const ErrorControl scales = equations.error_control(1e-6);
  for (std::size_t column = 0; column < n; ++column) {
    const double h = 1e-5 * scales.scale[column], kept = y[column];
    y[column] = kept + h;
    equations.flow(0, y, up);
    y[column] = kept - h;
    equations.flow(0, y, down);
    y[column] = kept;
    for (std::size_t row = 0; row < n; ++row) found[row][column] = (up[row] - down[row]) / (2 * h);
  }
  for (std::size_t row = 0; row < n; ++row) {
    double largest = 0;
    for (std::size_t column = 0; column < n; ++column)
      largest = std::max(largest, std::abs(exact[row][column]) * scales.scale[column]);
    for (std::size_t column = 0; column < n; ++column)
      EXPECT_NEAR(exact[row][column] * scales.scale[column], found[row][column] * scales.scale[column],
                  relative * largest + 1e-12)
          << "∂(" << equations.state_name(row) << ")'/∂(" << equations.state_name(column) << ")";
  }
}

// The same states, Jacobian entries and guards.
inline void expect_same_model(const Scene& a, const Scene& b) {
  const auto first = compile(a, a.effects), second = compile(b, b.effects);
  EXPECT_EQ(first->state_count(), second->state_count());
  EXPECT_EQ(first->free_shafts, second->free_shafts);
  EXPECT_EQ(first->jacobian.pattern.row, second->jacobian.pattern.row);
  EXPECT_EQ(first->accounts.size(), second->accounts.size());
  EXPECT_EQ(Equations(first, true).guard_count(), Equations(second, true).guard_count());
}

}  // namespace kurbel::test
