// spot_checks_test.cpp — the linear response against the nonlinear cycle at held mean speeds: where the machine is linear
// they agree, where it is not the cycle is that of an independent integration.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "studies/modes/modes.h"
#include "tests/support/scenes.h"

namespace kurbel::spot_checks_test {
namespace {

constexpr double pi = std::numbers::pi;

// Motor 60 (1 − ω/40) N·m, a joint, a load that is a triangle from 0 to `top` three times a turn.
Scene machine(const std::string& joint, double top) {
  return test::scene_from(fmt::format(R"(
line = ["motor", "joint", "work"]
motor = {{ kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", inertia = "0.5 kg*m2" }}
joint = {{ {} }}
work = {{ kind = "load", inertia = "0.3 kg*m2", table = {{ over = "angle", unit = ["deg", "N*m"], points = [[0, 0], [60, {}], [120, 0]], period = "120 deg" }} }}
effects = {{ elasticity = true }}
run = {{ start = "rest", until = "20 s" }}
)",
                                      joint, top));
}
const char* const spring = R"(kind = "coupling", stiffness = "6 kN*m/rad", damping = "15 N*m*s/rad")";
const char* const progressive =
    R"(kind = "progressive coupling", damping = "1.5 N*m*s/rad", table = { over = "twist", unit = ["rad", "N*m"], points = [[0, 0], [0.005, 20], [0.02, 200]] })";

ModesStudy modes_of(const Scene& scene, const ModesOptions& options) {
  return find_modes(scene, scene.effects, options);
}

// The load oscillates so little that its angle is that of uniform motion: below, at and above the resonance of the
// third order (59.6 rad/s), where the motor brakes, both are the same.
TEST(SpotChecks, LinearMachineIsItsLinearResponse) {
  const Scene scene = machine(spring, 0.04);
  const ModesStudy m = modes_of(scene, {.fastest = 90, .orders = 60, .spots = {20, 59.6, 85}});
  ASSERT_EQ(m.spots.size(), 3u);
  for (const SpotCheck& spot : m.spots) {
    ASSERT_TRUE(spot.cycle) << spot.why;
    EXPECT_NEAR(spot.cycle->speed, spot.speed, 1e-8 * spot.speed);
    EXPECT_NEAR(spot.linear.joints[0].peak, spot.cycle->joints[0].peak, 1e-3 * spot.cycle->joints[0].peak);
    EXPECT_NEAR(spot.linear.joints[0].mean, spot.cycle->joints[0].mean, 1e-7);
    EXPECT_NEAR(std::abs(spot.linear.orders[0][3]), std::abs(spot.cycle->orders[0][1]),
                1e-4 * std::abs(spot.cycle->orders[0][1]));
    // The whole machine would accelerate by what motor and mean load leave over.
    EXPECT_NEAR(spot.acceleration, (60 * (1 - spot.speed / 40) - 0.02) / 0.8, 1e-6);
    EXPECT_TRUE(spot.stable);
  }
}

TEST(SpotChecks, AtTheOperatingSpeedTheHeldCycleIsTheSteadyOne) {
  const Scene scene = machine(progressive, 40);
  const double speed = modes_of(scene, {}).cycle.value().speed;
  const ModesStudy m = modes_of(scene, {.spots = {speed}});
  ASSERT_EQ(m.spots.size(), 1u);
  ASSERT_TRUE(m.spots[0].cycle) << m.spots[0].why;
  EXPECT_NEAR(m.spots[0].acceleration, 0, 1e-7);
  const JointResponse &held = m.spots[0].cycle->joints[0], &kept = m.cycle->joints[0];
  EXPECT_NEAR(held.peak, kept.peak, 1e-7 * kept.peak);
  EXPECT_NEAR(held.mean, kept.mean, 1e-7 * kept.peak);
  EXPECT_NEAR(held.dominant_amplitude, kept.dominant_amplitude, 1e-7 * kept.peak);
}

// The two discs of `machine(progressive, top)` with −I a on each, by Runge and Kutta's method in steps of the load's angle.
struct TwoDiscs {
  double top, acceleration;
  struct State {
    double twist = 0, motor = 0, work = 0, time = 0;
  };
  double torque(const State& s) const {
    const double t = std::abs(s.twist), law = t < 0.005 ? 4000 * t : 20 + 12000 * (t - 0.005);
    return std::copysign(law, s.twist) + 1.5 * (s.motor - s.work);
  }
  State rate(double phi, const State& s) const {
    const double place = std::fmod(phi, 2 * pi / 3) / (pi / 3), load = top * (place < 1 ? place : 2 - place);
    const double tau = torque(s);
    return {(s.motor - s.work) / s.work, ((60 * (1 - s.motor / 40) - tau) / 0.5 - acceleration) / s.work,
            ((tau - load) / 0.3 - acceleration) / s.work, 1 / s.work};
  }
  static State add(const State& s, double h, const State& k) {
    return {s.twist + h * k.twist, s.motor + h * k.motor, s.work + h * k.work, s.time + h * k.time};
  }
  void step(double phi, double h, State& s) const {
    const State a = rate(phi, s), b = rate(phi + h / 2, add(s, h / 2, a)), c = rate(phi + h / 2, add(s, h / 2, b)),
                d = rate(phi + h, add(s, h, c));
    s = add(add(add(add(s, h / 6, a), h / 3, b), h / 3, c), h / 6, d);
  }
};

// Beside the resonance that the mean stiffness gives, the joint's vibration crosses its kink: the linear response is
// off by many per cent, and the cycle is where an integration of the two discs comes to rest.
TEST(SpotChecks, ProgressiveCouplingOscillatesAsAnIndependentIntegrationSays) {
  const double top = 40;
  const Scene scene = machine(progressive, top);
  const ModesStudy m = modes_of(scene, {.fastest = 90, .spot_checks = 2, .spots = {50}});
  ASSERT_EQ(m.spots.size(), 3u);
  double most_off = 0;
  for (const SpotCheck& spot : m.spots) {
    ASSERT_TRUE(spot.cycle) << spot.why;
    const JointResponse& cycle = spot.cycle->joints[0];
    const TwoDiscs discs{top, spot.acceleration};
    const int steps = 720;
    TwoDiscs::State s{.twist = 0, .motor = spot.speed, .work = spot.speed, .time = 0};
    double greatest = -HUGE_VAL, least = HUGE_VAL, begin = 0;
    const int turns = 250;
    for (int turn = 0; turn < turns; ++turn) {
      if (turn + 1 == turns) begin = s.time;
      for (int k = 0; k < steps; ++k) {
        discs.step(2 * pi * k / steps, 2 * pi / steps, s);
        if (turn + 1 < turns) continue;
        greatest = std::max(greatest, discs.torque(s));
        least = std::min(least, discs.torque(s));
      }
    }
    EXPECT_NEAR(2 * pi / (s.time - begin), spot.speed, 1e-4 * spot.speed);
    EXPECT_NEAR(greatest, cycle.upper, 2e-3 * cycle.peak) << spot.speed;
    EXPECT_NEAR(least, cycle.lower, 2e-3 * cycle.peak) << spot.speed;
    most_off = std::max(most_off, std::abs(spot.difference(0)) / cycle.peak);
  }
  EXPECT_GT(most_off, 0.05);
}

// The range's peak is examined first, and nothing near the operating speed.
TEST(SpotChecks, LieWhereTheJointCarriesMost) {
  const ModesStudy m = modes_of(machine(spring, 40), {.fastest = 90, .spot_checks = 1});
  ASSERT_EQ(m.spots.size(), 1u);
  double most = 0, speed = 0;
  for (const SpeedResponse& s : m.sweep)
    if (s.joints[0].peak > most) most = s.joints[0].peak, speed = s.speed;
  EXPECT_EQ(m.spots[0].speed, speed);
  EXPECT_TRUE(m.spots[0].share);
  EXPECT_TRUE(modes_of(machine(spring, 40), {.fastest = 90}).spots.empty());
}

// A speed that is given cannot be held at another: said, not guessed.
TEST(SpotChecks, OfAPrescribedSpeedSayWhy) {
  const Scene scene = test::scene_from(R"(
line = ["drive", "joint", "work"]
drive = { kind = "prescribed speed", speed = "30 rad/s" }
joint = { kind = "coupling", stiffness = "6 kN*m/rad", damping = "15 N*m*s/rad" }
work = { kind = "load", inertia = "0.3 kg*m2", table = { over = "angle", unit = ["deg", "N*m"], points = [[0, 0], [60, 5], [120, 0]], period = "120 deg" } }
effects = { elasticity = true }
run = { until = "2 s" }
)");
  const ModesStudy m = modes_of(scene, {.spots = {20}});
  ASSERT_EQ(m.spots.size(), 1u);
  EXPECT_FALSE(m.spots[0].cycle);
  EXPECT_NE(m.spots[0].why.find("prescribed"), std::string::npos) << m.spots[0].why;
}

}  // namespace
}  // namespace kurbel::spot_checks_test
