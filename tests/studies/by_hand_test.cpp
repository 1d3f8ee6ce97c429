// by_hand_test.cpp — figures of studies against formulas written out here: equivalent amplitudes, a flywheel's spokes,
// what a main bearing feels of a counterweight.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "studies/flywheel.h"
#include "studies/forces.h"
#include "studies/rainflow.h"

namespace kurbel {
namespace {

constexpr double pi = std::numbers::pi;

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

// A counterweight is mass on the crank: the forces are those of a crank that has it, at any acceleration.
TEST(Counterweights, ShakeAndLoadTheBearingLikeACrankThatHasThem) {
  SliderCrankData data{.radius = 0.1,
                       .rod_length = 0.35,
                       .offset = 0.02,
                       .crank_mass = 4,
                       .crank_com = 0.03,
                       .crank_inertia = 0.2,
                       .rod_mass = 2,
                       .rod_com = 0.12,
                       .rod_inertia = 0.03,
                       .slider_mass = 3};
  const auto turn = [](const SliderCrankData& d) {
    const SliderCrankStatics statics(d);
    std::vector<CyclePosition> positions(65);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double phi = 2 * pi * static_cast<double>(i) / 64;
      positions[i].state = {phi, 60 + 5 * std::cos(phi), 900 * std::sin(phi + 0.4), 500 * std::cos(phi)};
      positions[i].forces = statics.solve(positions[i].state);
    }
    return positions;
  };
  for (const Counterweight& c : propose_counterweights(SliderCrankStatics(data), turn(data))) {
    SliderCrankData with = data;
    with.crank_com -= c.moment / data.crank_mass;
    with.crank_inertia = 10;
    double shaking = 0, bearing = 0;
    const std::vector<CyclePosition> positions = turn(with);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const SliderCrankForces& f = positions[i].forces;
      EXPECT_NEAR((c.shaking[i] - f.shaking_force).magnitude(), 0, 1e-9 * c.peak_force) << c.name;
      shaking = std::max(shaking, f.shaking_force.magnitude());
      bearing = std::max(bearing, f.main_bearing.magnitude());
    }
    EXPECT_NEAR(c.peak_force, shaking, 1e-9 * shaking) << c.name;
    EXPECT_NEAR(c.peak_bearing, bearing, 1e-9 * bearing) << c.name;
  }
}

TEST(Counterweights, BalanceTheRotatingMassesAndTheirShareOfTheReciprocatingOnes) {
  const SliderCrankData data{.radius = 0.1,
                             .rod_length = 0.4,
                             .crank_mass = 4,
                             .crank_com = 0.03,
                             .crank_inertia = 0.2,
                             .rod_mass = 2,
                             .rod_com = 0.1,
                             .rod_inertia = 0.03,
                             .slider_mass = 3};
  const std::vector<CyclePosition> still(9);
  const auto proposals = propose_counterweights(SliderCrankStatics(data), still);
  const double rotating = 4 * 0.03 + 2 * 0.75 * 0.1, reciprocating = (3 + 2 * 0.25) * 0.1;
  EXPECT_NEAR(proposals[1].moment, rotating, 1e-15);
  EXPECT_NEAR(proposals[2].moment, rotating + 0.5 * reciprocating, 1e-15);
  EXPECT_NEAR(proposals[2].reciprocating_share, 0.5, 1e-15);
}

}  // namespace
}  // namespace kurbel
