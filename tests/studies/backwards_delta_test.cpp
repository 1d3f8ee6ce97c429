// backwards_delta_test.cpp — the speed fluctuation of shafts that turn the other way.
#include <gtest/gtest.h>

#include <numbers>

#include "studies/steady/steady.h"
#include "tests/support/scenes.h"
#include "tests/support/steady_simulation.h"

namespace kurbel::backwards_delta_test {
namespace {

// δ = (|ω|_max − |ω|_min)/|ω|_mean of each shaft; rigid, it is the same on all, also behind a gear that reverses.
TEST(Fluctuation, IsPositiveOnAShaftThatTurnsBackwards) {
  const Scene scene = test::scene_from(R"(
line = ["motor", "gear", "pump"]
motor = { kind = "torque source", table = { over = "speed", unit = ["rad/s", "N*m"], points = [[-60, 60], [0, -66]] }, inertia = "0.5 kg*m2" }
gear = { kind = "planetary gear", sun = 20, ring = 60, in = "sun", out = "ring", fixed = "carrier" }
pump = { kind = "slider-crank", radius = "100 mm", rod = "350 mm", crank_inertia = "0.5 kg*m2", slider_mass = "3 kg", load = { kind = "opposing", force = "300 N" } }
run = { start = { speed = "8 rad/s" } }
)");
  const SteadyStudy study = steady(scene, {Effects{}}, {.start_search = false});
  ASSERT_TRUE(study.complete) << study.diagnosis;
  const SteadyCycle& c = study.cycles[0];
  const double link = c.find("delta.pump")->value;
  EXPECT_GT(link, 0);
  EXPECT_NEAR(c.find("delta.motor")->value, link, 1e-9);
  const auto model = compile(scene, Effects{});
  const test::SteadySimulation s =
      test::simulate_steady(scene, Effects{}, 8, 2 * std::numbers::pi, model->network.ports.at("motor").in, {}, 10);
  EXPECT_NEAR(s.motor_delta, s.link_delta, 1e-9);
}

}  // namespace
}  // namespace kurbel::backwards_delta_test
