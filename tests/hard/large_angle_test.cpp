// large_angle_test.cpp — a machine that has turned a million times is as precise as one that has just begun: twists are
// states of their own, and turns are kept apart from the remainder.
#include <fmt/format.h>

#include "tests/published/published.h"

namespace kurbel::large_angle_test {
namespace {

using test::figure;
using test::run;
using test::series;
using test::with;

std::string chain_from(double angle) {
  return with(with(test::project_text("scenes/six_inertia_chain.toml"), "start    = \"rest\"",
                   fmt::format("start    = {{ angle = \"{} rad\" }}", angle)),
              "accuracy = 1e-8", "accuracy = 1e-11");
}

const std::vector<std::string> inertias = {"motor", "j2", "j3", "j4", "j5", "fan"};

// `stiff`: of c2 and c3, whose fast modes ring at the level of the tolerance while stability holds the explicit steps.
void expect_alike(const Result& near, const Result& far, double relative, double stiff) {
  ASSERT_TRUE(near.complete && far.complete);
  const auto compare = [&](const std::string& channel, double scale, double relative_here) {
    const auto a = series(near, channel), b = series(far, channel);
    ASSERT_EQ(a.size(), b.size());
    double largest = 0;
    for (std::size_t row = 0; row < a.size(); ++row) largest = std::max(largest, std::abs(a[row] - b[row]));
    EXPECT_LE(largest, relative_here * scale) << channel;
  };
  for (const std::string& name : inertias) compare("speed." + name, 150, relative);  // no-load speed
  for (int i = 1; i <= 5; ++i)
    compare(fmt::format("spring_torque.c{}", i), 200, i == 2 || i == 3 ? stiff : relative);  // stall torque
}

// 4π·79577 and what it is beyond whole turns begin in the same configuration.
TEST(LargeAngle, TwistsAndSpeedsOfAChainAreAsPreciseAtAMillionRadiansAsAtZero) {
  const double far_angle = 79577 * 2 * test::two_pi;
  const auto remainder =
      static_cast<double>(static_cast<long double>(far_angle) - 79577 * 4 * std::numbers::pi_v<long double>);
  ASSERT_GT(far_angle, 999'990);
  ASSERT_LT(std::abs(remainder), 2e-10);
  const Result near = run(chain_from(remainder)), far = run(chain_from(far_angle));
  expect_alike(near, far, 1e-12, 1e-10);
  EXPECT_NEAR(figure(far, "final_angle.fan") - far_angle, figure(near, "final_angle.fan"),
              2e-10);  // a last digit of 1e6
}

// From another angle the turns are taken out at other moments and the steps fall otherwise: what differs is the error
// of the integration, the same whether the angle is 1 rad or 1e6.
TEST(LargeAngle, AMillionRadiansAreNoWorseThanOne) {
  const Result near = run(chain_from(0));
  expect_alike(near, run(chain_from(1)), 1e-12, 1e-10);
  expect_alike(near, run(chain_from(1e6)), 1e-12, 1e-10);
}

// k θ from the difference of two absolute angles of 1e6 rad would have lost the torque's last six digits:
// one digit of 1e6 rad is 1.2e-10 rad, times 2e5 N·m/rad is 2e-5 N·m.
TEST(LargeAngle, PeakTorqueOfAChainIsThatOfTheReferenceAtAMillionRadians) {
  EXPECT_NEAR(figure(run(chain_from(1e6)), "peak_spring_torque.c1"), 290.808843395416, 1e-9);  // reference.toml, E1
}

// --- a crank mechanism; φ and φ − 2πn are the same configuration ---

Scene driven_crank(double angle) {
  Scene scene = test::scene_from(
      with(test::project_text("scenes/driven_slider_crank.toml"), "accuracy = 1e-7", "accuracy = 1e-10"));
  scene.run.start.angle = angle;
  scene.run.until = 3;
  return scene;
}

TEST(LargeAngle, CrankMechanismAtAMillionTurnsBehavesAsAtItsRemainder) {
  const double far_angle = 1e6 * test::two_pi;  // to a last digit of 9e-10 rad
  const auto remainder =
      static_cast<double>(static_cast<long double>(far_angle) - 1'000'000 * 2 * std::numbers::pi_v<long double>);
  ASSERT_LT(std::abs(remainder), 1e-9);
  const Result near = run(driven_crank(remainder)), far = run(driven_crank(far_angle));
  ASSERT_TRUE(near.complete && far.complete);
  const auto a = series(near, "speed.crank"), b = series(far, "speed.crank");
  for (std::size_t row = 0; row < a.size(); ++row) EXPECT_NEAR(a[row], b[row], 1e-11) << row;
  const auto x = series(near, "position.crank"), y = series(far, "position.crank");
  for (std::size_t row = 0; row < x.size(); ++row) EXPECT_NEAR(x[row], y[row], 1e-13) << row;
  EXPECT_EQ(near.events.size(), far.events.size());
  EXPECT_NEAR(figure(far, "final_angle.crank") - far_angle, figure(near, "final_angle.crank"), 2e-9);
}

TEST(LargeAngle, WrittenInTurnsAMillionIsAsGoodAsNone) {
  const std::string text = with(test::project_text("scenes/driven_slider_crank.toml"), "speed = \"20 rad/s\" }",
                                "speed = \"20 rad/s\", angle = \"1e6 rev\" }");
  const Result far = run(text), near = run(test::project_text("scenes/driven_slider_crank.toml"));
  EXPECT_NEAR(figure(far, "final_speed.crank"), figure(near, "final_speed.crank"),
              1e-8);  // 1e6 rev in radians has an error of 5e-10 rad
}

// Angles of negative sense and of geared shafts wrap as well.
TEST(LargeAngle, BackwardMillionsBehaveAlike) {
  const double far_angle = -1e6 * test::two_pi;
  const auto remainder =
      static_cast<double>(static_cast<long double>(far_angle) + 1'000'000 * 2 * std::numbers::pi_v<long double>);
  const Result near = run(driven_crank(remainder)), far = run(driven_crank(far_angle));
  EXPECT_NEAR(figure(near, "final_speed.crank"), figure(far, "final_speed.crank"), 1e-11);
}

}  // namespace
}  // namespace kurbel::large_angle_test
