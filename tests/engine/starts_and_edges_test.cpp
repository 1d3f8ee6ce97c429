// starts_and_edges_test.cpp — starts in balance behind a reversing gear, edges of laws on slower shafts, and scales of
// given motions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/rigid/work_equation.h"
#include "tests/support/scenes.h"

namespace kurbel::starts_and_edges_test {
namespace {

using test::figure;
using test::run;
using test::scene_from;

double first_of(const Result& r, const std::string& name) {
  const auto& c = r.trajectory->channels();
  for (std::size_t k = 0; k < c.size(); ++k)
    if (c[k].name == name) return r.trajectory->value(0, k);
  return std::nan("");
}

TEST(Start, InBalanceKnowsABrakeBehindAReversingGear) {
  for (const double push : {5.0, -5.0, 3.0, -3.0}) {
    const Result r = run(fmt::format(R"(
line = ["drive", "c", "gear", "drum"]
drive = {{ kind = "torque source", torque = "{} N*m", inertia = "0.3 kg*m2" }}
c = {{ kind = "coupling", stiffness = "2 kN*m/rad" }}
gear = {{ kind = "planetary gear", sun = 20, ring = 50, in = "sun", out = "ring", fixed = "carrier" }}
drum = {{ kind = "brake", torque = "8 N*m", inertia = "2 kg*m2" }}
effects = {{ elasticity = true }}
run = {{ until = "0.01 s", samples = 2, start = "equilibrium" }}
)",
                                     push),
                         false);
    const double held = std::copysign(std::min(std::abs(push), 8 / 2.5), push);
    const double acceleration = (push - held) / (0.3 + 2 / (2.5 * 2.5));
    EXPECT_NEAR(first_of(r, "torque.c"), push - 0.3 * acceleration, 1e-9) << push;
    EXPECT_NEAR(figure(r, "final_speed.drum"), -acceleration / 2.5 * 0.01, 1e-7) << push;
  }
}

TEST(RigidMachine, FindsRoundEdgesOfATableOnASlowerShaft) {
  const Scene scene = scene_from(R"(
line = ["wheel", "gear", "slow"]
wheel = { kind = "inertia", inertia = "0.5 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 50] }] }
slow = { kind = "torque source", inertia = "2 kg*m2", table = { over = "angle", unit = ["deg", "N*m"], points = [[0, 4], [60, 6], [110, -3], [247, 9]] } }
)");
  RigidMachine machine(compile(scene, scene.effects));
  for (const int direction : {1, -1}) {
    const std::vector<double> edges = machine.edges(direction);
    ASSERT_EQ(edges.size(), 8u) << direction;
    const double own[] = {0, 60, 110, 247};
    for (std::size_t k = 0; k < 8; ++k)
      EXPECT_NEAR(edges[k], (own[k % 4] + (k < 4 ? 0 : 360)) * 2.5 * M_PI / 180, 1e-9);
  }
}

// Two turns of the slow shaft: 2 · (50·60 + 15·50 + 30·137 + 65·113) deg N·m = 530.7546 J.
TEST(WorkOverAngle, WorkOfATableOnASlowerShaftIsItsArea) {
  const Scene scene = scene_from(R"(
line = ["wheel", "gear", "slow"]
wheel = { kind = "inertia", inertia = "0.5 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 50] }] }
slow = { kind = "torque source", inertia = "2 kg*m2", table = { over = "angle", unit = ["deg", "N*m"], points = [[0, 40], [60, 60], [110, -30], [247, 90]] } }
)");
  WorkTables tables(compile(scene, scene.effects));
  for (const int direction : {1, -1})
    EXPECT_NEAR(tables.diagram(direction).work_per_cycle(),
                direction * 2 * (50 * 60 + 15 * 50 + 30 * 137 + 65 * 113) * M_PI / 180, 1e-9);
}

TEST(Scales, OfGivenMotionsAloneLetTheRunGoOn) {
  const Result r = run(R"(
line = ["drive", "c", "frame"]
drive = { kind = "prescribed speed", speed = "10 rad/s", amplitude = "3 rad/s", frequency = "4 Hz" }
frame = { kind = "prescribed speed", speed = "10 rad/s" }
c = { kind = "coupling", stiffness = "700 N*m/rad", damping = "20 N*m*s/rad" }
effects = { elasticity = true }
run = { until = "0.125 s", budget = "1 s", start = { speed = "10 rad/s" } }
)",
                       false);
  EXPECT_TRUE(r.complete) << r.diagnosis.substr(0, 60);
}
}  // namespace
}  // namespace kurbel::starts_and_edges_test
