// speed_limit_test.cpp — where a speed without a cycle goes: limits of closed forms by angles, and of machines against the run-ups
// that they have.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "studies/answers/run_claims.h"
#include "studies/duty/approach.h"
#include "studies/steady/steady.h"
#include "tests/support/scenes.h"

namespace kurbel::speed_limit_test {
namespace {

using test::run;
using Kind = SpeedLimit::Kind;
constexpr int intervals = 512;
constexpr double rpm = std::numbers::pi / 30;

// Of ∫ speed dt, by Simpson's rule.
template <class Speed>
SpeedLimit limit_of(const Speed& speed, double until, double noise = 1e-6) {
  constexpr int cells = 100;
  std::vector<double> angles;
  double angle = 0;
  const double h = until / intervals, cell = h / cells;
  for (int i = 0; i <= intervals; ++i) {
    angles.push_back(angle);
    for (int k = 0; k < cells; ++k) {
      const double t = h * i + cell * k;
      angle += cell / 6 * (speed(t) + 4 * speed(t + cell / 2) + speed(t + cell));
    }
  }
  SpeedLimit found = limit_of_speed(angles, noise * h);
  found.limit /= h, found.speed /= h, found.unsure /= h;
  return found;
}

TEST(SpeedLimit, OfAnExponentialIsExactFromOneFifthOfItsTimeConstantOn) {
  for (const double until : {0.5, 2.0, 5.0, 10.0, 20.0}) {
    const auto speed = [](double t) { return 50 * (1 - std::exp(-t / 2.5)); };
    const SpeedLimit found = limit_of(speed, until);
    ASSERT_EQ(found.kind, Kind::known) << until;
    EXPECT_NEAR(found.limit, 50, found.unsure) << until;
    EXPECT_NEAR(found.speed, speed(until), 1e-6 * 50) << until;
    EXPECT_LT(found.unsure, 0.02 * 50) << until;
  }
}

// A vibration of 0.5 % about it changes neither, wherever in its period the end is.
TEST(SpeedLimit, IsThatOfTheMeanOfAVibration) {
  const auto mean = [](double t) { return 50 * (1 - std::exp(-t / 2.5)); };
  for (double until = 20; until < 20.06; until += 0.007) {
    const SpeedLimit found = limit_of([&](double t) { return mean(t) + 0.26 * std::sin(112 * t); }, until);
    ASSERT_EQ(found.kind, Kind::known) << until;
    EXPECT_NEAR(found.limit, 50, 1e-3) << until;
    EXPECT_NEAR(found.speed, mean(until), 1e-3) << until;
  }
}

// What was before has no influence: a run-up at constant torque up to 2.94 s, then a fast approach.
TEST(SpeedLimit, OfASpeedThatHasSettledIsItself) {
  const auto speed = [](double t) {
    return t < 2.94 ? 153.8 / 2.94 * t : 155.4 - 1.56 * std::exp(-(t - 2.94) / 0.0316);
  };
  for (const double until : {3.1, 3.2, 3.5, 3.8, 4.5, 10.0}) {
    const SpeedLimit found = limit_of(speed, until);
    ASSERT_EQ(found.kind, Kind::known) << until;
    EXPECT_NEAR(found.limit, 155.4, 2e-3) << until;
    EXPECT_NEAR(found.speed, speed(until), 2e-3) << until;
  }
}

TEST(SpeedLimit, IsUnknownWhereASlowVibrationOrARunAwayHasNone) {
  for (const double until : {1.0, 2.0, 3.0, 5.0}) {
    const auto beats = [](double t) { return 100 * (1 - std::exp(-0.63 * t) * std::cos(6.28 * t)); };
    EXPECT_NE(limit_of(beats, until).kind, Kind::known) << until;
  }
  EXPECT_EQ(limit_of([](double t) { return 3 * t; }, 10).kind, Kind::grows);
  EXPECT_EQ(limit_of([](double t) { return 3 * t * t; }, 10).kind, Kind::grows);
  EXPECT_EQ(limit_of([](double t) { return std::exp(t); }, 5).kind, Kind::grows);
}

// Sums of two exponentials towards the same side: in 99 of 100 of them what lacks is right within its error and a fifth.
TEST(SpeedLimit, OfTwoExponentialsIsWithinItsError) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> log_time(-1, 1), part(0, 50);
  constexpr double h = 10.0 / intervals;
  int known = 0, wrong = 0;
  for (int k = 0; k < 3000; ++k) {
    const double fast = std::pow(10, log_time(random)), slow = std::pow(10, log_time(random)), a = part(random),
                 b = part(random);
    std::vector<double> angles;
    for (int i = 0; i <= intervals; ++i)
      angles.push_back(100 * h * i - a * fast * std::exp(-h * i / fast) - b * slow * std::exp(-h * i / slow));
    const SpeedLimit found = limit_of_speed(angles, 1e-6 * h);
    const double lacks = std::abs(found.limit - found.speed) / h, unsure = found.unsure / h;
    if (found.kind != Kind::known || unsure > 0.2 * lacks) continue;
    ++known;
    if (std::abs(found.limit / h - 100) > unsure + 0.2 * lacks) ++wrong;
  }
  EXPECT_GT(known, 1500);
  EXPECT_LT(wrong, known / 100);
}

// An induction motor runs up in 2.94 s and approaches 1483.90 rpm with T = 0.0316 s: from 3.1 s on it is steady; before, no value is
// stated as its final one that is not.
TEST(SpeedLimit, OfAnInductionMotorThatHasRunUp) {
  for (const double until : {2.0, 2.6, 3.2, 3.5, 3.8, 4.0, 4.5}) {
    const Result r = run(fmt::format(R"(
      line = ["motor", "wheel"]
      wheel = {{ kind = "load", torque = "30 N*m" }}
      run = {{ start = "rest", until = "{} s" }}
      [motor]
      kind = "induction motor"
      rated_power = "11 kW"
      rated_speed = "1460 rpm"
      synchronous_speed = "1500 rpm"
      breakdown_ratio = 2.5
      inertia = "0.8 kg*m2"
    )",
                                     until));
    EXPECT_EQ(r.periods.steady, until > 3) << until << ": " << r.periods.verdict;
    if (!r.periods.steady) {
      EXPECT_EQ(r.periods.verdict.find("final value"), std::string::npos) << r.periods.verdict;
      continue;
    }
    EXPECT_NEAR(test::figure(r, "run_up_time"), 2.9407, 2e-3) << until;
    EXPECT_NEAR(r.periods.steady_speed / rpm, 1483.9045, 0.1) << until;
  }
}

// A constant torque on a large inertia, and a slow approach: within the noise in short parts, but not in longer ones.
TEST(SpeedLimit, OfASlowDriftIsNone) {
  for (const double accuracy : {1e-2, 1e-3, 1e-4, 1e-6})
    for (const char* damping : {"0", "1"}) {
      const Result r = run(fmt::format(R"(
        line = ["wheel"]
        wheel = {{ kind = "flywheel", inertia = "1000 kg*m2" }}
        source = {{ kind = "torque source", on = "wheel", torque = "50 N*m" }}
        drag = {{ kind = "bearing drag", on = "wheel", damping = "{} N*m*s/rad" }}
        run = {{ start = {{ speed = "100 rad/s" }}, until = "0.5 s", accuracy = {} }}
      )",
                                       damping, accuracy));
      EXPECT_FALSE(r.periods.steady) << accuracy << " " << damping << ": " << r.periods.verdict;
    }
}

// The percentage is that of the speed at the end, and the limit is that of `steady`.
TEST(SpeedLimit, OfAStraightCharacteristicIsStatedFromTheSpeedAtTheEnd) {
  const Result r = run(R"(
    line = ["motor", "rotor"]
    motor = { kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2" }
    rotor = { kind = "flywheel", inertia = "1 kg*m2" }
    run = { until = "4 s" }
  )");
  EXPECT_FALSE(r.periods.steady);
  EXPECT_NE(r.periods.verdict.find("the speed is still 14 % below its final value"), std::string::npos)  // e⁻²
      << r.periods.verdict;
}

// 100 N·m against 2 N·m·s/rad is 50 rad/s; the shafts vibrate about it.
TEST(SpeedLimit, SteadySpeedOfAVibratingShaftIsItsMean) {
  for (const double until : {20.0, 20.02, 20.03, 20.05}) {
    const Result r = run(fmt::format(R"(
      line = ["motor", "k", "b"]
      motor = {{ kind = "torque source", torque = "100 N*m", inertia = "1 kg*m2" }}
      k = {{ kind = "coupling", stiffness = "10 kN*m/rad" }}
      b = {{ kind = "load", damping = "2 N*m*s/rad", inertia = "4 kg*m2" }}
      effects = {{ elasticity = true }}
      run = {{ start = "rest", until = "{} s" }}
    )",
                                     until));
    ASSERT_TRUE(r.periods.steady) << until << ": " << r.periods.verdict;
    EXPECT_NEAR(r.periods.steady_speed, 50 * (1 - std::exp(-until / 2.5)), 5e-3) << until;
    ASSERT_TRUE(r.periods.run_up_end) << until;
    // 50 e^(−t/2.5) is 1 % at 11.5 s; what vibrates about it leaves the range later.
    EXPECT_GT(*r.periods.run_up_end, 2.5 * std::log(100)) << until;
    EXPECT_LT(*r.periods.run_up_end, 15) << until;
  }
}

}  // namespace
}  // namespace kurbel::speed_limit_test
