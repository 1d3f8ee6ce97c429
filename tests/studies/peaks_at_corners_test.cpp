// peaks_at_corners_test.cpp — forces whose greatest value lies where a load has a corner: the two sides say it, and Simbody's
// reactions in the states of the settled run are the same.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "studies/forces/forces.h"
#include "tests/agreement/agreement.h"
#include "tests/support/scenes.h"

namespace kurbel::peaks_at_corners_test {
namespace {

// The gas force of the diagram is greatest at its point at 390°.
TEST(PeakAtACorner, OfAnIndicatorDiagramIsTheForceThere) {
  const Scene scene = test::scene_file("tests/agreement/indicator_diagram.toml");
  const Forces forces = find_forces(scene, {});
  ASSERT_TRUE(forces.simulated.has_value());
  double there = 0;
  for (const PositionForces& p : forces.simulated->positions)
    if (std::abs(p.forces.state.phi - 390 * std::numbers::pi / 180) < 1e-6)
      there = p.forces.joints[0].force.magnitude();
  ASSERT_GT(there, 0);
  EXPECT_NEAR(forces.simulated->reaction(0).value, there, 1e-6 * there);
}

TEST(PeakAtACorner, IsThatOfSimbodyInTheRunsStates) {
  for (const char* name : {"indicator_diagram", "viscous_damper_crank", "load_over_angle"}) {
    SCOPED_TRACE(name);
    const agreement::Row row =
        agreement::compare_forces(test::scene_file(std::string("tests/agreement/") + name + ".toml"));
    int compared = 0;
    for (const agreement::Compared& figure : row.figures) {
      if (figure.topic != agreement::Topic::reactions) continue;
      ++compared;
      EXPECT_EQ(figure.verdict, agreement::Verdict::agrees)
          << figure.figure << ": " << figure.run << " " << figure.study << " ± " << figure.allowed;
    }
    EXPECT_EQ(compared, 2);
  }
}

}  // namespace
}  // namespace kurbel::peaks_at_corners_test
