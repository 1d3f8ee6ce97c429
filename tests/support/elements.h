// elements.h — the demands that every element must meet: exact Jacobian in each mode, energy, no trace when off.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "engine/events/equations.h"
#include "tests/support/scenes.h"

namespace kurbel::test {

// ∂f/∂y of the whole machine from dual numbers against central differences, relative to the largest of each row; from
// a row on, where those before it are known (the slip of a locked clutch).
inline void expect_exact_jacobian(Equations& equations, const std::vector<double>& y, double tolerance = 3e-7,
                                  std::size_t first_row = 0) {
  const std::size_t n = equations.size();
  const SparsityPattern& pattern = equations.jacobian_pattern();
  std::vector<double> values(pattern.row.size()), dense(n * n, 0.0);
  equations.jacobian(0.1, y, values);
  for (std::size_t c = 0; c < n; ++c)
    for (auto k = static_cast<std::size_t>(pattern.column_start[c]);
         k < static_cast<std::size_t>(pattern.column_start[c + 1]); ++k)
      dense[static_cast<std::size_t>(pattern.row[k]) * n + c] += values[k];
  const ErrorControl control = equations.error_control(1);
  std::vector<double> up(n), down(n), difference(n * n);
  for (std::size_t c = 0; c < n; ++c) {
    const double h = 1e-5 * control.scale[c];
    std::vector<double> shifted = y;
    shifted[c] = y[c] + h;
    equations.flow(0.1, shifted, up);
    shifted[c] = y[c] - h;
    equations.flow(0.1, shifted, down);
    for (std::size_t r = 0; r < n; ++r) difference[r * n + c] = (up[r] - down[r]) / (2 * h);
  }
  for (std::size_t r = first_row; r < n; ++r) {
    double row_scale = 0;
    for (std::size_t c = 0; c < n; ++c)
      row_scale = std::max(row_scale, std::abs(difference[r * n + c] * control.scale[c]));
    for (std::size_t c = 0; c < n; ++c)
      EXPECT_NEAR(dense[r * n + c] * control.scale[c], difference[r * n + c] * control.scale[c], tolerance * row_scale)
          << equations.state_name(r) << " by " << equations.state_name(c);
  }
}

// The same at given twists and speeds of the free shafts, in the modes that belong to them.
inline void expect_exact_jacobian(const std::string& scene_text, double angle, const std::vector<double>& twists,
                                  const std::vector<double>& speeds) {
  const Scene scene = scene_from(scene_text);
  Equations equations(compile(scene, scene.effects), false);
  expect_exact_jacobian(equations, equations.state_of(0.1, angle, twists, speeds));
}

// The same at the start of a scene, in the modes that hold there; the last states are then moved off it by `offset`.
inline void expect_exact_jacobian_near_start(const std::string& scene_text, const std::vector<double>& offset = {}) {
  const Scene scene = scene_from(scene_text);
  Equations equations(compile(scene, scene.effects), false);
  std::vector<double> y = equations.start(0);
  for (std::size_t k = 0; k < offset.size(); ++k) y[y.size() - offset.size() + k] += offset[k];
  expect_exact_jacobian(equations, y);
}

// Two scenes that are the same machine: same states, Jacobian, guards, and the same trajectory to the last bit.
inline void expect_same_machine(const std::string& off, const std::string& without) {
  const Scene a = scene_from(off), b = scene_from(without);
  Equations ea(compile(a, a.effects), false), eb(compile(b, b.effects), false);
  EXPECT_EQ(ea.size(), eb.size());
  EXPECT_EQ(ea.guard_count(), eb.guard_count());
  EXPECT_EQ(ea.jacobian_pattern().row.size(), eb.jacobian_pattern().row.size());
  EXPECT_EQ(ea.model().mode_slots, eb.model().mode_slots);
  EXPECT_EQ(ea.model().pools.size(), eb.model().pools.size());
  const Result ra = run(a, false), rb = run(b, false);
  ASSERT_TRUE(ra.complete && rb.complete) << ra.diagnosis << rb.diagnosis;
  const TrajectoryRecorder &ta = *ra.trajectory, &tb = *rb.trajectory;
  ASSERT_EQ(ta.channels().size(), tb.channels().size());
  ASSERT_EQ(ta.time().size(), tb.time().size());
  for (std::size_t row = 0; row < ta.time().size(); ++row)
    for (std::size_t k = 0; k < ta.channels().size(); ++k)
      ASSERT_EQ(ta.value(row, k), tb.value(row, k)) << ta.channels()[k].name << " at " << ta.time()[row];
}

}  // namespace kurbel::test
