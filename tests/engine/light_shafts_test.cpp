// light_shafts_test.cpp — shafts of next to no inertia between ties, and of none, against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/published/published.h"
#include "tests/support/scenes.h"

namespace kurbel::light_shafts_test {
namespace {

using test::figure;
using test::run;

constexpr double light[] = {1e-14, 1e-10, 1e-6, 1e-2, 1};  // [kg·m²]

void expect_uniform(const std::string& text, const std::string& shaft, double speed_after_one_second) {
  const Result r = run(text);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_NEAR(figure(r, "final_speed." + shaft), speed_after_one_second, 1e-11 * std::abs(speed_after_one_second));
  EXPECT_LE(r.energy.relative, 1e-11);
}

std::string planetary(const std::string& ring, const std::string& more = "") {
  return fmt::format(R"(
line = ["sun", "gear", "load"]
sun = {{ kind = "torque source", torque = "10 N*m", inertia = "1 kg*m2" }}
gear = {{ kind = "planetary gear", sun = 30, ring = 80{} }}
load = {{ kind = "inertia", inertia = "10 kg*m2" }}
ring = {{ {} }}
run = {{ until = "1 s", start = "rest" }}
[[branch]]
from = "gear.ring"
line = ["ring"]
)",
                     more, ring);
}

// Ring braked: ε_sun = M/(J_s + i_c² J_c), i_c = z_s/(z_s + z_r).
TEST(LightShafts, ABrakedRingPassesTheTorqueHoweverLightItIs) {
  const double ic = 30.0 / 110, expected = 10 / (1 + 10 * ic * ic);
  for (const double ring : light)
    expect_uniform(
        planetary("kind = \"brake\", torque = \"400 N*m\"", fmt::format(", ring_inertia = \"{:g} kg*m2\"", ring)),
        "sun", expected);
}

// A ring without inertia that is driven: its torque stands in Willis' ratio to the others', T_s = T_r/i₀.
TEST(LightShafts, ARingWithoutInertiaIsCarriedByTheOtherTwo) {
  const double i0 = -80.0 / 30;
  for (const double torque : {-30.0, 0.0, 12.0}) {
    const std::string text = planetary(fmt::format("kind = \"torque source\", torque = \"{} N*m\"", torque));
    expect_uniform(text, "sun", 10 + torque / i0);
    expect_uniform(text, "load", -(1 - i0) * torque / i0 / 10);
  }
  expect_uniform(planetary("kind = \"brake\", torque = \"400 N*m\""), "sun", 10 / (1 + 10 * 9.0 / 121));
}

std::string in_a_row(const std::string& first, const std::string& second, double between) {
  return fmt::format(R"(
line = ["a", "first", "between", "second", "b"]
a = {{ kind = "torque source", torque = "10 N*m", inertia = "1 kg*m2" }}
first = {{ {} }}
between = {{ kind = "inertia", inertia = "{:g} kg*m2" }}
second = {{ {} }}
b = {{ kind = "inertia", inertia = "3 kg*m2" }}
run = {{ until = "1 s", start = "rest" }}
)",
                     first, between, second);
}

TEST(LightShafts, BetweenTwoLockedClutchesTheyMoveAlong) {
  const std::string clutch = "kind = \"clutch\", torque = \"100 N*m\"", freewheel = "kind = \"one-way clutch\"";
  for (const double between : light)
    for (const std::string& first : {clutch, freewheel})
      for (const std::string& second : {clutch, freewheel})
        expect_uniform(in_a_row(first, second, between), "b", 10 / (4 + between));
}

// One output of a differential braked: the other turns twice as fast as the cage.
TEST(LightShafts, OfADifferentialHeldByABrakeTurnTheOtherTwiceAsFast) {
  for (const double output : light)
    expect_uniform(fmt::format(R"(
line = ["drive", "axle", "load"]
drive = {{ kind = "torque source", torque = "10 N*m", inertia = "1 kg*m2" }}
axle = {{ kind = "differential", output_inertia = "{:g} kg*m2" }}
load = {{ kind = "inertia", inertia = "10 kg*m2" }}
brake = {{ kind = "brake", torque = "400 N*m" }}
run = {{ until = "1 s", start = "rest" }}
[[branch]]
from = "axle.second"
line = ["brake"]
)",
                               output),
                   "load", 2 * 10 / (4 * (10 + output) + 1.0));
}

// Gear stages with losses and wheels without inertia: the shaft between them is carried by its neighbours.
TEST(LightShafts, WithoutInertiaBetweenGearsWithLossesPassTheTorqueOn) {
  expect_uniform(R"(
line = ["motor", "first", "second", "load"]
motor = { kind = "torque source", torque = "10 N*m", inertia = "0.5 kg*m2" }
first = { kind = "gearbox", stages = [{ teeth = [20, 40], efficiency = 0.9 }] }
second = { kind = "gearbox", stages = [{ teeth = [20, 60], efficiency = 0.8 }] }
load = { kind = "inertia", inertia = "7 kg*m2" }
effects = { gear_losses = true }
run = { until = "1 s", start = { speed = "1 rad/s" } }
)",
                 "motor", 1 + 10 / (0.5 + 7 / (36 * 0.9 * 0.8)));
}

std::string refusal(const std::string& text) {
  try {
    const Scene scene = test::scene_from(text);
    compile(scene, scene.effects);
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

TEST(LightShafts, WithoutInertiaAreRefusedWhereNothingFixesTheirMotion) {
  const std::string clutch = "kind = \"clutch\", torque = \"100 N*m\"";
  const std::string slips = refusal(in_a_row(clutch, clutch, 0));
  EXPECT_NE(slips.find("has no inertia"), std::string::npos) << slips;
  EXPECT_NE(slips.find("may slip"), std::string::npos) << slips;
  const std::string both =
      refusal(test::with(planetary("kind = \"brake\", torque = \"400 N*m\""),
                         "kind = \"inertia\", inertia = \"10 kg*m2\"", "kind = \"torque source\", torque = \"1 N*m\""));
  EXPECT_NE(both.find("ties it to a shaft without inertia"), std::string::npos) << both;
}

}  // namespace
}  // namespace kurbel::light_shafts_test
