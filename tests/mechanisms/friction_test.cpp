// friction_test.cpp — classical friction pairs against published numbers (tests/cases/fr01_friction.toml) and limits.
#include "mechanisms/slider_crank/friction.h"

#include <gtest/gtest.h>

#include "mechanisms/slider_crank/slider_crank_forces.h"

namespace kurbel {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double relative = 1e-9;

void expect_close(double value, double expected) { EXPECT_NEAR(value, expected, relative * std::fabs(expected)); }

// --- published ---

TEST(PublishedFriction, ScrewOfExample10_3RaisesItsLoad) {
  const ScrewPair screw{.mean_diameter = 0.037, .lead = 0.006, .coefficient = 0.1};
  expect_close(screw.raise_torque(75e3), 211.461241207);
  expect_close(screw.efficiency(), 0.338689605635);
  expect_close(screw.raise_torque(75e3) * 50 * 2 * pi / 60, 1107.20846982);
}

TEST(PublishedFriction, ScrewJackOfExample10_9RaisesAndLowersByItsLever) {
  const ScrewPair screw{.mean_diameter = 0.05, .lead = 0.01, .coefficient = 0.15};
  expect_close(screw.raise_torque(20e3) / 0.7, 154.087121651);
  expect_close(screw.lower_torque(20e3) / 0.7, 61.086681421);
  EXPECT_TRUE(screw.self_locking());
}

TEST(PublishedFriction, ScrewOfExample10_10HasItsRatioAndEfficiency) {
  const ScrewPair screw{.mean_diameter = 0.05, .lead = 0.0125, .coefficient = 0.13};
  expect_close(screw.raise_torque(25e3), 132.355143109);
  expect_close(screw.lower_torque(25e3), 31.191402996);
  expect_close(screw.raise_torque(25e3) / screw.lower_torque(25e3), 4.243321249);
  expect_close(screw.efficiency(), 0.375776253);
}

TEST(PublishedFriction, ScrewOfExample10_5ClosesItsValve) {
  const ScrewPair screw{.mean_diameter = 0.047, .lead = 0.006, .coefficient = 0.12};
  expect_close(screw.raise_torque(35342.917352885), 134.070787812);
}

// η = tan λ/tan 2λ = (1 − f²)/2 where λ = φ_f: no self-locking screw does better than half.
TEST(PublishedFriction, EfficiencyAtTheLimitOfSelfLocking) {
  for (const double f : {0.05, 0.1, 0.15, 0.3}) {
    ScrewPair screw{.mean_diameter = 0.04, .lead = f * pi * 0.04, .coefficient = f};
    expect_close(screw.efficiency(), (1 - f * f) / 2);
    screw.lead *= 1 + 1e-9;
    EXPECT_FALSE(screw.self_locking());
    screw.lead *= 1 - 1e-8;
    EXPECT_TRUE(screw.self_locking());
    EXPECT_EQ(screw.efficiency_driven_by_load(), 0);
  }
}

TEST(PublishedFriction, JournalStopsItsRotor) {
  const double inertia = 2, load = 500, f = 0.08, r = 0.03, w0 = 50;
  expect_close(friction_circle_radius_approximate(r, f) * load, 1.2);
  expect_close(inertia * w0 / (friction_circle_radius_approximate(r, f) * load), 83.33333333333333);
  // With the exact radius.
  EXPECT_NEAR(journal_torque(load, r, f), 1.196179, 1e-6);
  EXPECT_NEAR(inertia * w0 / journal_torque(load, r, f), 83.5996, 1e-4);
}

TEST(PublishedFriction, WheelRolls) {
  expect_close(rolling_torque(2000, 0.0005), 1.0);
  expect_close(rolling_pull(2000, 0.0005, 0.25), 4.0);
  EXPECT_TRUE(rolls(0.0005, 0.25, 0.1));
  EXPECT_FALSE(rolls(0.05, 0.25, 0.1));
}

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

// --- closed forms and limits ---

TEST(Friction, ThreadAngleWorksAsAGreaterCoefficient) {
  const ScrewPair trapezoidal{.mean_diameter = 0.03, .lead = 0.006, .coefficient = 0.1, .half_thread_angle = pi / 12};
  const ScrewPair square{.mean_diameter = 0.03, .lead = 0.006, .coefficient = 0.1 / std::cos(pi / 12)};
  EXPECT_DOUBLE_EQ(trapezoidal.raise_torque(1e4), square.raise_torque(1e4));
  const ScrewPair flat{.mean_diameter = 0.03, .lead = 0.006, .coefficient = 0.1};
  EXPECT_LT(trapezoidal.efficiency(), 0.99 * flat.efficiency());
}

TEST(Friction, FrictionlessScrewLosesNothing) {
  const ScrewPair screw{.mean_diameter = 0.03, .lead = 0.006};
  EXPECT_NEAR(screw.efficiency(), 1, 1e-15);
  EXPECT_NEAR(screw.efficiency_driven_by_load(), 1, 1e-15);
  EXPECT_NEAR(screw.raise_torque(1e4) * 2 * pi, 1e4 * 0.006, 1e-12);  // work of a turn
  EXPECT_EQ((ScrewPair{.mean_diameter = 0.03, .coefficient = 0.1}.efficiency()), 0);
}

TEST(Friction, InclinedPlaneHoldsItsBodyUpToTheAngleOfFriction) {
  const double f = 0.2, limit = std::atan(f);
  EXPECT_TRUE(inclined_plane_self_locking(0.99 * limit, f));
  EXPECT_FALSE(inclined_plane_self_locking(1.01 * limit, f));
  EXPECT_NEAR(inclined_plane_lower(100, limit, f), 0, 1e-12);
  EXPECT_LT(inclined_plane_lower(100, 0.5, f), 0);
  EXPECT_DOUBLE_EQ(inclined_plane_raise(100, 0, f), 20);
  EXPECT_TRUE(std::isinf(inclined_plane_raise(100, pi / 2 - 0.1, f)));  // λ + φ_f ≥ π/2: no force moves it
}

// By the forces themselves: normal force and friction on the slope under weight and a horizontal push.
TEST(Friction, PushUpAPlaneIsInEquilibrium) {
  const double q = 100, slope = 0.3, f = 0.15, p = inclined_plane_raise(q, slope, f);
  const double normal = q * std::cos(slope) + p * std::sin(slope);
  EXPECT_NEAR(p * std::cos(slope), q * std::sin(slope) + f * normal, 1e-12);
}

TEST(Friction, WedgeSpringsOutJustBeyondTheSumOfItsAnglesOfFriction) {
  const double limit = std::atan(0.1) + std::atan(0.15);
  EXPECT_NEAR(wedge_withdraw(100, limit, 0.1, 0.15), 0, 1e-12);
  EXPECT_TRUE(wedge_self_locking(0.99 * limit, 0.1, 0.15));
  EXPECT_LT(wedge_withdraw(100, 1.01 * limit, 0.1, 0.15), 0);
  EXPECT_DOUBLE_EQ(wedge_drive(100, 0, 0.1, 0.15), 25);
}

TEST(Friction, RollersBetweenTwoTracksAndTheWheelAgree) {
  EXPECT_DOUBLE_EQ(roller_pull(2000, 0.0005, 0.0005, 0.25), rolling_pull(2000, 0.0005, 0.25));
  EXPECT_DOUBLE_EQ(rolling_bearing_torque(1000, 0.04, 0.0015), 0.03);
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

TEST(Friction, SenselessArgumentsAreRefused) {
  EXPECT_THROW(friction_angle(-0.1), std::invalid_argument);
  EXPECT_THROW(inclined_plane_raise(1, 2, 0.1), std::invalid_argument);
  EXPECT_THROW((ScrewPair{.mean_diameter = 0, .lead = 0.1}.lead_angle()), std::invalid_argument);
  EXPECT_THROW(rolling_pull(1, 0.1, 0), std::invalid_argument);
}

}  // namespace
}  // namespace kurbel
