// speed_table_test.cpp — steady motion that oscillates to and fro across a knot of a characteristic.
#include <cmath>

#include "tests/support/scenes.h"

namespace kurbel::speed_table_test {
namespace {

// A load by table with its knot exactly at the mean speed: the slider-crank's inertia carries the speed across it twice
// in every turn, with crossings that come back within a step. The table is a straight line in two pieces, so the motion
// must be that of the viscous load with the same slope.
TEST(CharacteristicOverSpeed, KnotInSteadyMotionIsCrossedWithoutChatter) {
  const std::string machine = R"(
line = ["motor", "crank", "brake"]
[motor]
kind = "dc shunt motor"
stall_torque = "30 N*m"
no_load_speed = "60 rad/s"
inertia = "0.05 kg*m2"
[crank]
kind = "slider-crank"
radius = "60 mm"
rod = "200 mm"
crank_inertia = "0.2 kg*m2"
slider_mass = "1 kg"
[run]
start = { speed = "40 rad/s" }
until = "3 s"
accuracy = 1e-8
[brake]
kind = "load"
)";
  const Result table = test::run(
      machine + "table = { over = \"speed\", unit = [\"rad/s\", \"N*m\"], points = [[0, 0], [40, 10], [80, 20]] }\n");
  const Result straight = test::run(machine + "damping = \"0.25 N*m*s/rad\"\n");
  ASSERT_TRUE(table.complete) << table.diagnosis;
  EXPECT_NEAR(test::figure(table, "final_angle.crank"), test::figure(straight, "final_angle.crank"), 1e-7);
  EXPECT_NEAR(test::figure(table, "final_speed.crank"), test::figure(straight, "final_speed.crank"), 1e-6);
  EXPECT_GT(table.statistics.knots, 50);
}

}  // namespace
}  // namespace kurbel::speed_table_test
