// equation_checks.h — what every element must pass within a scene: its Jacobian equals differences of the flow, and
// switched off it leaves no trace.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/equations.h"
#include "tests/support/scenes.h"

namespace kurbel::test {

// Exact Jacobian against central differences, at the present modes, each column scaled by its state.
inline void expect_jacobian_equals_differences(Equations& equations, double t, const std::vector<double>& y,
                                               double relative = 1e-7) {
  const SparsityPattern& pattern = equations.jacobian_pattern();
  std::vector<double> values(pattern.row.size());
  equations.jacobian(t, y, values);
  const auto n = static_cast<Eigen::Index>(pattern.size);
  Eigen::MatrixXd exact = Eigen::MatrixXd::Zero(n, n), difference = exact;
  for (std::size_t column = 0; column < pattern.size; ++column)
    for (auto k = pattern.column_start[column]; k < pattern.column_start[column + 1]; ++k)
      exact(pattern.row[static_cast<std::size_t>(k)], static_cast<Eigen::Index>(column)) =
          values[static_cast<std::size_t>(k)];
  const ErrorControl control = equations.error_control(1e-6);
  std::vector<double> up(y.size()), down(y.size());
  for (Eigen::Index column = 0; column < n; ++column) {
    const auto c = static_cast<std::size_t>(column);
    const double scale = control.scale[c] > 0 ? control.scale[c] : 1, h = 1e-5 * scale;
    std::vector<double> moved = y;
    moved[c] = y[c] + h;
    equations.flow(t, moved, up);
    moved[c] = y[c] - h;
    equations.flow(t, moved, down);
    for (Eigen::Index row = 0; row < n; ++row)
      difference(row, column) = (up[static_cast<std::size_t>(row)] - down[static_cast<std::size_t>(row)]) / (2 * h);
    exact.col(column) *= scale;
    difference.col(column) *= scale;
  }
  for (Eigen::Index row = 0; row < n; ++row) {
    const double size = std::max(exact.row(row).cwiseAbs().maxCoeff(), difference.row(row).cwiseAbs().maxCoeff());
    for (Eigen::Index column = 0; column < n; ++column)
      EXPECT_NEAR(exact(row, column), difference(row, column), relative * size)
          << "d/dt of " << equations.state_name(static_cast<std::size_t>(row)) << " by "
          << equations.state_name(static_cast<std::size_t>(column));
  }
}

// The same at the start of a scene, with its speeds and own states moved off it.
inline void expect_jacobian_equals_differences(const std::string& text, const std::vector<double>& offset = {}) {
  const Scene scene = scene_from(text);
  Equations equations(compile(scene, scene.effects), false);
  std::vector<double> y = equations.start(0);
  for (std::size_t k = 0; k < offset.size(); ++k) y[y.size() - offset.size() + k] += offset[k];
  expect_jacobian_equals_differences(equations, 0, y);
}

// Two scenes are one machine: states, guards, Jacobian, and every bit of the motion.
inline void expect_same_machine(const std::string& off, const std::string& without) {
  const Scene scenes[] = {scene_from(off), scene_from(without)};
  const auto a = compile(scenes[0], scenes[0].effects), b = compile(scenes[1], scenes[1].effects);
  EXPECT_EQ(a->state_count(), b->state_count());
  EXPECT_EQ(a->jacobian.pattern.row.size(), b->jacobian.pattern.row.size());
  EXPECT_EQ(Equations(a, false).guard_count(), Equations(b, false).guard_count());
  const Result first = run(scenes[0], false), second = run(scenes[1], false);
  ASSERT_EQ(first.trajectory->time().size(), second.trajectory->time().size());
  EXPECT_EQ(first.statistics.stepper.steps, second.statistics.stepper.steps);
  for (std::size_t k = 0; k < first.trajectory->channels().size(); ++k)
    for (std::size_t other = 0; other < second.trajectory->channels().size(); ++other)
      if (first.trajectory->channels()[k].name == second.trajectory->channels()[other].name) {
        for (std::size_t row = 0; row < first.trajectory->time().size(); ++row)
          ASSERT_EQ(first.trajectory->value(row, k), second.trajectory->value(row, other))
              << first.trajectory->channels()[k].name << " in row " << row;
      }
}

}  // namespace kurbel::test
