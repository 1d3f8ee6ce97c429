// by_hand_test.cpp — figures of studies against formulas written out here: equivalent amplitudes, a flywheel's spokes,
// what a main bearing feels of a counterweight.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "studies/forces/forces.h"
#include "studies/history/rainflow.h"
#include "studies/size/flywheel.h"
#include "tests/support/scenes.h"

namespace kurbel::by_hand_test {
namespace {

constexpr double pi = std::numbers::pi;

// ASTM E1049-85, figure 6, step by step: ranges, means and counts.
TEST(Rainflow, CyclesOfTheStandardsExampleHaveTheirMeans) {
  const double expected[][3] = {{3, -0.5, 0.5}, {4, -1, 0.5}, {4, 1, 1},  {8, 1, 0.5},
                                {9, 0.5, 0.5},  {8, 0, 0.5},  {6, 1, 0.5}};
  const std::vector<LoadCycle> cycles = rainflow({-2, 1, -3, 5, -1, 3, -4, 4, -2});
  ASSERT_EQ(cycles.size(), std::size(expected));
  for (std::size_t k = 0; k < cycles.size(); ++k) {
    EXPECT_EQ(cycles[k].range, expected[k][0]) << k;
    EXPECT_EQ(cycles[k].mean, expected[k][1]) << k;
    EXPECT_EQ(cycles[k].count, expected[k][2]) << k;
  }
}

// Its rule 4: a range X closes the one before, Y, where X ≥ Y, equal ones included.
TEST(Rainflow, RangeThatEqualsTheOneBeforeClosesIt) {
  const std::vector<LoadCycle> cycles = rainflow({-3, 6, 1, 4, 1});
  ASSERT_EQ(cycles.size(), 3u);
  EXPECT_EQ(cycles[0].range, 3);
  EXPECT_EQ(cycles[0].mean, 2.5);
  EXPECT_EQ(cycles[0].count, 1);
}

// ½ (Σ n R^m/Σ n)^(1/m): of one cycle of range 10 and two of range 4.
TEST(Rainflow, EquivalentAmplitudeIsThePowerMeanOverTheCycles) {
  const std::vector<LoadCycle> cycles = {{10, 1, 1}, {4, -2, 1.5}, {4, 0, 0.5}};
  for (const double m : {1.0, 3.0, 8.0}) {
    const double mean = (std::pow(10, m) + 2 * std::pow(4, m)) / 3;
    EXPECT_NEAR(equivalent_amplitude(cycles, m), 0.5 * std::pow(mean, 1 / m), 1e-12);
  }
}

// Rim, hub, and spokes ∫ r² dm between them; stresses of the ring and between the spokes.
TEST(FlywheelDimensions, SpokedWheelHasTheInertiaAndTheStressesOfItsParts) {
  FlywheelRequest request{FlywheelForm::rim, flywheel_material("cast steel"), 400, 25, 1.6, 0};
  const FlywheelDimensions d = flywheel_dimensions(request);
  const double rho = d.material.density, outer = 0.5 * d.diameter, inner = outer - d.thickness, hub = 0.2 * outer;
  const auto ring = [&](double r2, double r1) {
    return 0.5 * pi * rho * d.breadth * (std::pow(r2, 4) - std::pow(r1, 4));
  };
  const double section = pi / 4 * d.thickness * 0.5 * d.thickness;
  const double spokes = 6 * rho * section * (std::pow(inner, 3) - std::pow(hub, 3)) / 3;
  EXPECT_NEAR(ring(outer, inner) + spokes + ring(hub, 0), 400, 1e-9 * 400);
  EXPECT_NEAR(d.rim_share, ring(outer, inner) / 400, 1e-9);
  const double middle = 0.5 * (outer + inner), stress = rho * std::pow(25 * middle, 2);
  EXPECT_NEAR(d.stress, stress, 1e-9 * stress);
  EXPECT_NEAR(d.spoked_stress, stress * (0.75 + 4.935 * middle / (36 * d.thickness)), 1e-9 * stress);
  EXPECT_GT(d.spoked_stress, d.stress);
  EXPECT_NEAR(d.safety, d.material.strength / d.spoked_stress, 1e-9 * d.safety);
}

// A crank with its centre of mass out by this, at a given speed.
Forces crank_forces(double crank_com) {
  ForcesOptions options;
  options.simulate = false;
  return find_forces(test::scene_from(fmt::format(R"(
line = ["crank"]
crank = {{ kind = "slider-crank", radius = "100 mm", rod = "400 mm", offset = "20 mm", crank_mass = "4 kg", crank_com = "{:.17g} m", crank_inertia = "10 kg*m2", rod_mass = "2 kg", rod_com = "100 mm", rod_inertia = "0.03 kg*m2", slider_mass = "3 kg" }}
run = {{ start = {{ speed = "60 rad/s" }}, until = "1 s" }}
)",
                                                  crank_com)),
                     options);
}

// A counterweight is mass on the crank: the forces are those of a crank that has it.
TEST(Counterweights, ShakeAndLoadTheBearingLikeACrankThatHasThem) {
  const Forces bare = crank_forces(0.03);
  ASSERT_GE(bare.balancing->counterweights.size(), 3u);
  for (const Counterweight& c : bare.balancing->counterweights) {
    const Forces with = crank_forces(0.03 - c.moment / 4);
    EXPECT_NEAR(c.peak_force.value, with.prescribed->shaking_force.value, 1e-7 * c.peak_force.value) << c.name;
    EXPECT_NEAR(c.peak_bearing.value, with.prescribed->reaction(0).value, 1e-7 * c.peak_bearing.value) << c.name;
  }
}

// The rod's mass at its two pins by the lever: ¾ on the crank, ¼ on the slider.
TEST(Forces, RodIsSharedBetweenItsPins) {
  const Forces f = crank_forces(0.03);
  EXPECT_NEAR(f.balancing->rotating_moment, 4 * 0.03 + 2 * 0.75 * 0.1, 1e-15);
  EXPECT_NEAR(f.balancing->reciprocating_mass, 3 + 2 * 0.25, 1e-15);
}

TEST(Counterweights, BalanceTheRotatingMassesAndTheirShareOfTheReciprocatingOnes) {
  const auto proposals = crank_forces(0.03).balancing->counterweights;
  const double rotating = 4 * 0.03 + 2 * 0.75 * 0.1, reciprocating = (3 + 2 * 0.25) * 0.1;
  EXPECT_NEAR(proposals[1].moment, rotating, 1e-15);
  EXPECT_NEAR(proposals[2].moment, rotating + 0.5 * reciprocating, 1e-15);
  EXPECT_NEAR(proposals[2].reciprocating_share, 0.5, 1e-15);
}

}  // namespace
}  // namespace kurbel::by_hand_test
