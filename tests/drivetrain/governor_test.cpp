// governor_test.cpp — proportional–integral speed governor: second-order response, limits, droop.
#include "drivetrain/motors/governor.h"

#include <fmt/format.h>

#include <cmath>
#include <complex>

#include "engine/matrices/linear_algebra.h"
#include "tests/published/published.h"
#include "tests/support/elements.h"

namespace kurbel::governor_test {
namespace {

using test::figure;
using test::run;

// J = 2 kg·m², ω_ref = 50 rad/s
std::string governed(double kp, double ki, const std::string& more, const std::string& rest) {
  return fmt::format(R"(
line = ["drive"]
[drive]
kind = "governor"
speed = "50 rad/s"
proportional_gain = "{} N*m*s/rad"
integral_gain = "{} N*m/rad"
max_torque = "1000 N*m"
min_torque = "-1000 N*m"
inertia = "2 kg*m2"
{}
{})",
                     kp, ki, more, rest);
}
const std::string load =
    "[load]\nkind = \"load\"\non = \"drive\"\ntorque = \"30 N*m\"\nacts = \"always\"\nstart = \"1 "
    "s\"\n";

// A step of load on the settled drive: J ω̈ + K_p ω̇ + K_i (ω − ω_ref) = 0 with ω̇(0) = −M_L/J.
TEST(SpeedGovernor, AnswersAStepOfLoadAsASecondOrderSystem) {
  for (const auto& [kp, ki] : {std::pair{12.0, 40.0}, std::pair{40.0, 100.0}, std::pair{3.0, 200.0}}) {
    const std::string text =
        governed(kp, ki, "",
                 load + "[run]\nstart = { speed = \"50 rad/s\" }\nuntil = \"6 s\"\nsamples = 601\naccuracy = 1e-10\n");
    const std::complex<double> half = kp / 4, root = std::sqrt(half * half - ki / 2), a = -half + root,
                               b = -half - root;
    const Eigen::VectorXcd lambda = eigenvalues(test::state_matrix(text));
    for (const std::complex<double>& expected : {a, b}) {
      double nearest = 1;
      for (const auto& l : lambda) nearest = std::min(nearest, std::abs(l - expected));
      EXPECT_LT(nearest, 1e-9 * std::abs(a));
    }
    const Result r = run(text);
    ASSERT_TRUE(r.complete) << r.diagnosis;
    const auto speed = test::series(r, "speed.drive");
    for (std::size_t row = 0; row < speed.size(); ++row) {
      const double t = r.trajectory->time()[row] - 1;
      const double fall = t <= 0 ? 0 : (-30 / 2.0 * (std::exp(a * t) - std::exp(b * t)) / (a - b)).real();
      EXPECT_NEAR(speed[row], 50 + fall, 1e-8) << t;
    }
  }
}

// The integral leaves no steady error; with droop the speed falls by d per torque.
TEST(SpeedGovernor, HoldsItsSpeedAndFallsByItsDroop) {
  for (const double droop : {0.0, 0.02, 0.1}) {
    const Result r = run(governed(20, 60, fmt::format("droop = \"{} rad/s/N/m\"", droop),
                                  load + "[run]\nuntil = \"60 s\"\naccuracy = 1e-9\n"));
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_NEAR(figure(r, "final_speed.drive"), 50 - 30 * droop, 1e-7);
    EXPECT_NEAR(test::series(r, "torque.drive").back(), 30, 1e-6);
  }
}

// From rest at its upper limit: ω = M_max t/J; with T_t = K_p/K_i the integral follows as I = M_max (1 − e^{−t/T_t}),
// so that it governs from K_p (ω_ref − M_max t/J) = M_max e^{−t/T_t} on. It reaches the lower limit when a load drives
// it.
TEST(SpeedGovernor, ReachesAndLeavesItsLimitsAtLocatedEvents) {
  std::string text =
      governed(20, 60, "",
               "[wind]\nkind = \"load\"\non = \"drive\"\ntorque = \"-90 N*m\"\nacts = "
               "\"always\"\nstart = \"5 s\"\nstop = \"6 s\"\n[run]\nuntil = \"20 s\"\naccuracy = 1e-10\n");
  text = test::with(text, "max_torque = \"1000 N*m\"", "max_torque = \"80 N*m\"");
  text = test::with(text, "min_torque = \"-1000 N*m\"", "min_torque = \"-40 N*m\"");
  const Result r = run(text);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  double low = 0, high = 50 * 2 / 80.0;  // of the time at which it begins to govern
  for (int i = 0; i < 100; ++i) {
    const double t = 0.5 * (low + high);
    (20 * (50 - 40 * t) > 80 * std::exp(-3 * t) ? low : high) = t;
  }
  std::vector<std::string> said;
  std::vector<double> at;
  for (const Event& e : r.events)
    if (e.component == "drive") said.push_back(e.what), at.push_back(e.t);
  ASSERT_EQ(said, (std::vector<std::string>{"governs", "at its lower limit", "governs"}));
  EXPECT_NEAR(at[0], low, 1e-9);
  EXPECT_GT(at[1], 5);
  EXPECT_GT(at[2], 6);
  EXPECT_EQ(r.events[0].from, "at its upper limit");
  const auto torque = test::series(r, "torque.drive");
  EXPECT_EQ(*std::max_element(torque.begin(), torque.end()), 80);
  EXPECT_EQ(*std::min_element(torque.begin(), torque.end()), -40);
  EXPECT_NEAR(figure(r, "final_speed.drive"), 50, 1e-8);
  EXPECT_LT(r.energy.relative, 1e-9);
}

// The sequence sets the part of the reference speed; off it exerts nothing and forgets.
TEST(SpeedGovernor, FollowsTheOperatingSequence) {
  const Result r = run(governed(20, 60, "",
                                "[sequence]\nsteps = [{ at = \"20 s\", set = \"drive\", to = 0.5 }, { at = \"40 s\", "
                                "set = \"drive\", to = 0 }, { at = \"45 s\", set = \"drive\", to = 0.8 }]\n" +
                                    test::with(load, "start = \"1 s\"\n", "stop = \"30 s\"\n") +
                                    "[run]\nuntil = \"65 s\"\nsamples = 651\naccuracy = 1e-9\n"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto speed = test::series(r, "speed.drive"), torque = test::series(r, "torque.drive"),
             integral = test::series(r, "integral.drive");
  EXPECT_NEAR(speed[199], 50, 1e-7);
  EXPECT_NEAR(integral[199], 30, 1e-6);
  EXPECT_NEAR(speed[399], 25, 1e-7);
  for (const std::size_t row : {401u, 425u, 449u}) {
    EXPECT_EQ(torque[row], 0);
    EXPECT_EQ(integral[row], 0);
  }
  EXPECT_NEAR(speed[650], 40, 1e-7);
}

TEST(SpeedGovernor, JacobianEqualsDifferencesInEveryMode) {
  for (const auto& [speed, limit] : {std::pair{45.0, 1000.0}, std::pair{0.0, 80.0}, std::pair{90.0, 80.0}}) {
    std::string text = governed(20, 60, "droop = \"0.01 rad/s/N/m\"",
                                fmt::format("[run]\nstart = {{ speed = \"{} rad/s\" }}\n", speed));
    text = test::with(text, "max_torque = \"1000 N*m\"", fmt::format("max_torque = \"{} N*m\"", limit));
    text = test::with(text, "min_torque = \"-1000 N*m\"", fmt::format("min_torque = \"{} N*m\"", -limit));
    test::expect_exact_jacobian_near_start(text, {0.1, 2});
  }
}

}  // namespace
}  // namespace kurbel::governor_test
