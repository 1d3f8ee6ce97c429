// friction_test.cpp — joint friction against published numbers (tests/cases/fr01_friction.toml), closed forms, limits.
#include "mechanisms/friction/friction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/mechanisms/slider_crank_geometry.h"
#include "tests/mechanisms/slider_crank_statics.h"

namespace kurbel::friction_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double relative = 1e-9;

void expect_close(double value, double expected) { EXPECT_NEAR(value, expected, relative * std::fabs(expected)); }

// Bevan, Example 7: steam engine with friction circles at crank pin and crosshead, both tangent on the inside, and at
// the main bearing. He takes ρ = f r, which is the friction circle of the coefficient tan(asin f).
TEST(PublishedFriction, SteamEngineOfBevanDeliversItsTorqueThroughTheFrictionCircles) {
  const double inch = 0.0254, foot = 12 * inch, ton = 1;  // forces in tons
  SliderCrankData d;
  d.radius = 8 * inch;
  d.rod_length = 80 * inch;
  SliderCrankJoints j;
  const double f = std::tan(std::asin(0.05));
  j.main_bearing = {7 * inch, {f, f, 0, 0}};
  j.crank_pin = {15 * inch, {f, f, 0, 0}};
  j.slider_pin = {4.4 * inch, {f, f, 0, 0}};
  const CrankState s{.phi = pi / 3, .omega = 10, .slider_force = -6 * ton};
  const SliderCrankStatics statics(d, j);
  const double without = -statics.solve_frictionless(s).torque / (ton * foot);
  const SliderCrankForces with = statics.solve(s);
  expect_close(without, 3.637959891478);
  expect_close(-with.torque / (ton * foot), 3.062017182427);
  expect_close(-with.torque / (ton * foot) / without, 0.841685250461);
  // The same from the powers: what is lost in the joints is missing at the crank.
  const double input = s.slider_force * SliderCrankGeometry(d).slider(s.phi).slope * s.omega;
  expect_close(1 - with.friction_loss() / input, 0.841685250461);
}

TEST(Friction, StribeckCurveRunsFromStaticOverTheLeastToFluidFriction) {
  const FrictionCoefficient f{.kinetic = 0.02, .resting = 0.12, .stribeck_speed = 0.1, .viscous = 0.01};
  EXPECT_DOUBLE_EQ(f.at(0), 0.12);
  EXPECT_NEAR(f.at(0.1), 0.02 + 0.1 / std::exp(1.0) + 0.001, 1e-15);
  EXPECT_NEAR(f.at(10), 0.12, 1e-15);  // fluid: 0.02 + 0.01 · 10
  EXPECT_LT(f.at(0.35), 0.024);
  EXPECT_DOUBLE_EQ(f.at(-0.2), f.at(0.2));
  const FrictionCoefficient coulomb{.kinetic = 0.1, .resting = 0.15};
  EXPECT_DOUBLE_EQ(coulomb.at(0), 0.15);
  EXPECT_DOUBLE_EQ(coulomb.at(1e-12), 0.1);
}

// A reaction tangent to the friction circle has f times its normal part as its friction: ρ = r sin φ_f, not f r.
TEST(Friction, ReactionTangentToTheFrictionCircleLiesOnTheConeOfFriction) {
  for (const double f : {0.01, 0.1, 0.6}) {
    const double r = 0.03, rho = friction_circle_radius(r, f), friction = rho / r,
                 normal = std::sqrt(1 - rho * rho / (r * r));
    EXPECT_NEAR(friction, f * normal, 1e-15);
  }
  EXPECT_NEAR(friction_circle_radius(0.03, 0.08) * 500, 1.196179, 1e-6);  // the rotor of tests/cases/fr01_friction.toml
}

TEST(Friction, SenselessArgumentsAreRefused) {
  EXPECT_THROW(friction_angle(-0.1), std::invalid_argument);
  EXPECT_THROW(friction_angle(HUGE_VAL), std::invalid_argument);
  EXPECT_THROW(friction_circle_radius(-0.1, 0.1), std::invalid_argument);
}

}  // namespace
}  // namespace kurbel::friction_test
