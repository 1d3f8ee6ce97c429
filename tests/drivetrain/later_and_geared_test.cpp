// later_and_geared_test.cpp — what is switched on later than at zero, and what is given by an angle instead of lengths.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drivetrain/induction/starters.h"
#include "engine/model/model.h"
#include "tests/support/scenes.h"

namespace kurbel::later_and_geared_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

// η = tan γ/tan(γ + ρ′), tan ρ′ = μ/cos α_n, whatever the number of starts.
TEST(WormGear, GivenByItsLeadAngleHasTheEfficiencyOfThatAngle) {
  for (const int starts : {1, 3}) {
    const Scene scene = test::scene_from(fmt::format(R"(
line = ["source", "worm", "load"]
source = {{ kind = "torque source", torque = "5 N*m", inertia = "0.1 kg*m2" }}
worm = {{ kind = "worm gear", starts = {}, teeth = 40, lead_angle = "18 deg", friction_coefficient = 0.06 }}
load = {{ kind = "load", torque = "40 N*m", inertia = "2 kg*m2" }}
effects = {{ gear_losses = true }}
)",
                                                     starts));
    const auto model = compile(scene, scene.effects);
    ASSERT_EQ(model->network.relations.size(), 1u);
    const double gamma = 18 * degree, rho = std::atan(0.06 / std::cos(20 * degree));
    EXPECT_NEAR(1 - model->network.relations[0].loss.line(1, 1).slope, std::tan(gamma) / std::tan(gamma + rho), 1e-12);
  }
}

// Above the rated frequency the torque falls with the square of the flux; the ramp counts from where it is switched on.
TEST(FrequencyConverter, SwitchedOnLaterRisesFromThereAndWeakensTheField) {
  const FrequencyConverter converter{.ramp = 4, .target_speed = 200, .synchronous_speed = 150};
  EXPECT_DOUBLE_EQ(converter.rated_frequency_at(), 3);
  const Supply rising = converter.supply(FrequencyConverter::constant_flux, 2),
               weak = converter.supply(FrequencyConverter::weak_field, 3.5),
               there = converter.supply(FrequencyConverter::at_target, 6);
  EXPECT_DOUBLE_EQ(rising.factor, 1);
  EXPECT_DOUBLE_EQ(rising.lag, 50);
  EXPECT_DOUBLE_EQ(weak.factor, std::pow(150.0 / 175, 2));
  EXPECT_DOUBLE_EQ(weak.lag, -25);
  EXPECT_DOUBLE_EQ(there.factor, std::pow(0.75, 2));
}

// J ω = M (½ T + what is left after the ramp).
TEST(TorqueSource, RampSwitchedOnLaterGivesItsImpulse) {
  const Result r = test::run(R"(
line = ["source"]
source = { kind = "torque source", torque = "6 N*m", ramp = "0.4 s", start = "0.3 s", inertia = "2 kg*m2" }
run = { until = "1 s", accuracy = 1e-9 }
)",
                             false);
  EXPECT_NEAR(test::figure(r, "final_speed.source"), 6 * (0.2 + 0.3) / 2, 1e-8);
}

}  // namespace
}  // namespace kurbel::later_and_geared_test
