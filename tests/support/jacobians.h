// jacobians.h — the exact Jacobian of the equations against central differences of their flow; comparison of two
// scenes that must give one model.
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

// ∂f/∂y, dense, from dual numbers and from central differences over ± step.
struct Slopes {
  std::size_t size = 0;
  std::vector<double> exact, difference;  // row by row
  double exact_at(std::size_t row, std::size_t column) const { return exact[row * size + column]; }
  double difference_at(std::size_t row, std::size_t column) const { return difference[row * size + column]; }
};
inline Slopes slopes_of(Equations& equations, double t, const std::vector<double>& y, const std::vector<double>& step) {
  const std::size_t n = equations.size();
  Slopes slopes{n, std::vector<double>(n * n, 0.0), std::vector<double>(n * n, 0.0)};
  const SparsityPattern& pattern = equations.jacobian_pattern();
  std::vector<double> values(pattern.row.size()), up(n), down(n);
  equations.jacobian(t, y, values);
  for (std::size_t c = 0; c < n; ++c)
    for (auto k = static_cast<std::size_t>(pattern.column_start[c]);
         k < static_cast<std::size_t>(pattern.column_start[c + 1]); ++k)
      slopes.exact[static_cast<std::size_t>(pattern.row[k]) * n + c] += values[k];
  for (std::size_t c = 0; c < n; ++c) {
    std::vector<double> shifted = y;
    shifted[c] = y[c] + step[c];
    equations.flow(t, shifted, up);
    shifted[c] = y[c] - step[c];
    equations.flow(t, shifted, down);
    for (std::size_t r = 0; r < n; ++r) slopes.difference[r * n + c] = (up[r] - down[r]) / (2 * step[c]);
  }
  return slopes;
}
// Over ± part of each state's scale.
inline Slopes slopes_of(Equations& equations, double t, const std::vector<double>& y, double part = 1e-5) {
  std::vector<double> step = equations.error_control(1).scale;
  for (double& s : step) s *= part;
  return slopes_of(equations, t, y, step);
}

// Every entry, relative to the largest of its row, each state in its scale; from `first_row` on if earlier rows are
// known to differ (the slip of a locked clutch).
inline void expect_exact(const Slopes& slopes, Equations& equations, double tolerance, std::size_t first_row = 0) {
  const std::vector<double> scale = equations.error_control(1).scale;
  for (std::size_t r = first_row; r < slopes.size; ++r) {
    double largest = 0;
    for (std::size_t c = 0; c < slopes.size; ++c)
      largest = std::max(largest, std::abs(slopes.difference_at(r, c) * scale[c]));
    for (std::size_t c = 0; c < slopes.size; ++c)
      EXPECT_NEAR(slopes.exact_at(r, c) * scale[c], slopes.difference_at(r, c) * scale[c], tolerance * largest)
          << equations.state_name(r) << " by " << equations.state_name(c);
  }
}
inline void expect_exact_jacobian(Equations& equations, const std::vector<double>& y, double tolerance = 3e-7,
                                  std::size_t first_row = 0) {
  expect_exact(slopes_of(equations, 0.1, y), equations, tolerance, first_row);
}

// The same at given twists and speeds of the free shafts, in the corresponding modes.
inline void expect_exact_jacobian(const std::string& scene_text, double angle, const std::vector<double>& twists,
                                  const std::vector<double>& speeds) {
  const Scene scene = scene_from(scene_text);
  Equations equations(compile(scene, scene.effects), false);
  expect_exact_jacobian(equations, equations.state_of(0.1, angle, twists, speeds));
}

// The same at the start of a scene, in the modes there; the last states are then shifted by `offset`.
inline void expect_exact_jacobian_near_start(const std::string& scene_text, const std::vector<double>& offset = {},
                                             double tolerance = 3e-7) {
  const Scene scene = scene_from(scene_text);
  Equations equations(compile(scene, scene.effects), false);
  std::vector<double> y = equations.start(0);
  for (std::size_t k = 0; k < offset.size(); ++k) y[y.size() - offset.size() + k] += offset[k];
  expect_exact_jacobian(equations, y, tolerance);
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
