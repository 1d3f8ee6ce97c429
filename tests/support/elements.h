// elements.h — requirements on every element: exact Jacobian in each mode (jacobians.h), no trace when switched off.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "engine/events/equations.h"
#include "tests/support/jacobians.h"
#include "tests/support/scenes.h"

namespace kurbel::test {

// Two scenes that describe the same machine: same states, Jacobian, guards, and the same trajectory to the last bit.
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
      ASSERT_EQ(ta.value(row, k), tb.value(row, k)) << ta.channels()[k].name.text << " at " << ta.time()[row];
}

}  // namespace kurbel::test
