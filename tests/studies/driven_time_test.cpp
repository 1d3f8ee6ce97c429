// driven_time_test.cpp — which part of a run is judged, when a drive has been started, and what is no period.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "studies/claims/claim.h"
#include "studies/run/periods.h"
#include "studies/run/run_findings.h"
#include "tests/support/light_crank.h"
#include "tests/support/scenes.h"

namespace kurbel::driven_time_test {
namespace {

using test::figure, test::light_crank, test::run;

constexpr const char* shunt =
    R"(kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2")";

std::string texts(const Claims& claims) {
  std::string all;
  for (const Claim& c : claims) all += c.text + "\n";
  return all;
}

// --- periods ---

// Mid speeds as they are given, a turn in a second, without works.
Periods of_mid_speeds(int count, const std::function<double(int)>& mid) {
  static const auto model = test::model_of(R"(
line = ["motor", "crank"]
motor = { kind = "torque source", torque = "1 N*m", inertia = "1 kg*m2" }
run = { until = "1000 s" }
)" + std::string(light_crank));
  std::vector<CycleRecord> cycles;
  for (int k = 0; k < count; ++k) {
    CycleRecord& c = cycles.emplace_back();
    c.begin = k, c.end = k + 1, c.omega_max = c.omega_min = mid(k);
    c.work.resize(model->accounts.size());
    c.turned = 2 * std::numbers::pi;
  }
  const std::vector<CycleRecord> none;
  const SpeedRecorder speed(1000);
  RunOutcome outcome;
  outcome.t = count;
  return find_periods(*model, {0, cycles, none, speed, outcome, {}}, 1e-9);
}

// A vibration of a governor, a belt, that dies away over the turns: its range comes from the decay itself.
TEST(DrivenTime, AVibrationThatDiesAwayIsNoPeriodOfSeveralTurns) {
  for (const double period : {2.5, 3.0, 4.0, 4.7, 6.0, 7.3, 9.0, 12.0})
    for (const double decay : {4.0, 8.0, 12.0, 20.0, 40.0})
      for (int count = 12; count < 120; ++count) {
        const Periods p = of_mid_speeds(count, [&](int k) {
          return 1 + 0.05 * std::exp(-k / decay) * std::cos(2 * std::numbers::pi * k / period + 0.4);
        });
        EXPECT_EQ(p.cycles, 1) << period << " " << decay << " " << count << ": " << p.verdict;
      }
}
TEST(DrivenTime, APatternOfMidSpeedsIsOne) {
  for (const int n : {2, 3, 5, 12})
    EXPECT_EQ(of_mid_speeds(4 * n, [&](int k) { return k % n == 0 ? 0.95 : 1 + 0.01 * (k % n); }).cycles, n);
}

std::string clocked(const std::string& more, double until, double inertia = 1) {
  return fmt::format(R"(
line = ["motor", "rotor", "crank"]
motor = {{ {} }}
rotor = {{ kind = "flywheel", inertia = "{} kg*m2" }}
press = {{ kind = "load", on = "rotor", acts = "always", table = {{ over = "time", unit = ["s", "N*m"], period = "2 s", points = [[0, 30], [0.6, 30], [0.6, 0], [2, 0], [2, 30]] }} }}
run = {{ start = {{ speed = "91 rad/s" }}, until = "{} s", accuracy = 1e-8 }}
{}
)",
                     shunt, inertia, until, more) +
         light_crank;
}
// Eight edges of the law are no eight other motions.
TEST(DrivenTime, AFewPeriodsOfALawOverTimeAreEnough) {
  for (const double until : {14.0, 16.5, 40.5}) {
    const Result r = run(clocked("", until), false);
    ASSERT_TRUE(r.periods.steady) << until << " " << r.periods.verdict;
    EXPECT_EQ(r.periods.time * r.periods.cycles, 2) << until;
  }
}
// Its mid speeds differ by less than 0.1 %, and the last turns do no useful work, or nothing but that.
TEST(DrivenTime, AHeavyFlywheelDoesNotHideTheClock) {
  for (const double until : {20.5, 21.9}) {
    const Result r = run(clocked("", until, 20000), false);
    ASSERT_TRUE(r.periods.steady) << until << " " << r.periods.verdict;
    EXPECT_EQ(r.periods.time * r.periods.cycles, 2) << until << r.periods.verdict;
    EXPECT_NEAR(figure(r, "useful_work_per_cycle"), -30 * 0.6 * 91, 2) << until;
  }
}
// ω = 91 − 20, on average, with a time constant of 2 s.
TEST(DrivenTime, AStepOfALoadBesideAClockBeginsAnotherMotion) {
  const std::string step =
      R"(more = { kind = "load", on = "rotor", acts = "always", table = { over = "time", unit = ["s", "N*m"], points = [[0, 0], [20, 0], [20, 20], [60, 20]] } })";
  const Result soon = run(clocked(step, 27.9), false), late = run(clocked(step, 50.5), false);
  EXPECT_FALSE(soon.periods.steady) << soon.periods.verdict;
  ASSERT_TRUE(late.periods.steady) << late.periods.verdict;
  EXPECT_NEAR(figure(late, "mean_speed.crank"), 71, 1e-3);
}
// The mean torque is zero: it moves to and fro, whatever rounding leaves of the angle turned.
TEST(DrivenTime, AMotionToAndFroHasAPeriodAndNoTimeOfACycle) {
  const Result r = run(R"(
line = ["rotor", "crank"]
rotor = { kind = "flywheel", inertia = "1 kg*m2" }
shaker = { kind = "load", on = "rotor", acts = "always", table = { over = "time", unit = ["s", "N*m"], period = "1.5 s", points = [[0, 1], [0.5, 1], [0.5, -0.5], [1.5, -0.5], [1.5, 1]] } }
oil = { kind = "load", on = "rotor", damping = "2 N*m*s/rad" }
run = { start = { speed = "1e-3 rad/s" }, until = "40 s" }
)" + std::string(light_crank));
  ASSERT_TRUE(r.periods.steady) << r.periods.verdict;
  EXPECT_EQ(r.periods.time, 1.5);
  EXPECT_FALSE(r.find("cycle_time.crank"));
  const std::string told = texts(findings_of(r).claims);
  EXPECT_NE(told.find("\"crank\" moves to and fro with a period of 1.5 s"), std::string::npos) << told;
}
// It stops in each period and never turns backwards: strokes, with a mechanism's cycle or without.
TEST(DrivenTime, WhatStopsInEachPeriodAndNeverTurnsBackMakesStrokes) {
  const Result r = run(R"(
line = ["motor", "rotor"]
motor = { kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "100 rad/s", inertia = "0.05 kg*m2" }
rotor = { kind = "flywheel", inertia = "0.05 kg*m2" }
load = { kind = "load", on = "rotor", torque = "30 N*m" }
sequence = { every = "2 s", steps = [{ at = "0 s", set = "motor", to = 1 }, { after = "1.2 s", set = "motor", to = 0 }] }
run = { until = "21 s" }
)");
  ASSERT_TRUE(r.periods.steady) << r.periods.verdict;
  const std::string told = texts(findings_of(r).claims);
  EXPECT_NE(told.find("\"motor\" makes single strokes, one every 2 s, and rests between them"), std::string::npos)
      << told;
}
// Switched by the clock, it drives again after its pause.
TEST(DrivenTime, APauseOfADriveByTheClockIsNoRunDown) {
  const Result r = run(fmt::format(R"(
line = ["motor", "rotor"]
motor = {{ {} }}
rotor = {{ kind = "flywheel", inertia = "1 kg*m2" }}
load = {{ kind = "load", on = "rotor", torque = "10 N*m" }}
sequence = {{ every = "2 s", steps = [{{ at = "0 s", set = "motor", to = 1 }}, {{ after = "1.4 s", set = "motor", to = 0 }}] }}
run = {{ until = "39.8 s" }}
)",
                                   shunt));
  ASSERT_TRUE(r.periods.steady) << r.periods.verdict;
  EXPECT_FALSE(r.periods.run_down_begin);
  EXPECT_EQ(r.periods.judged_until, 38);
}

// --- the start of a drive ---

std::string prescribed(const std::string& points, double until) {
  return fmt::format(R"(
line = ["drive", "rotor", "crank"]
drive = {{ kind = "prescribed speed", table = {{ over = "time", unit = ["s", "rad/s"], points = {} }} }}
rotor = {{ kind = "flywheel", inertia = "1 kg*m2" }}
run = {{ until = "{} s" }}
)",
                     points, until) +
         light_crank;
}
TEST(DrivenTime, OfAPrescribedSpeedWhatComesLaterDoesNotCount) {
  const Result r = run(prescribed("[[0, 0], [5, 100], [40, 100], [60, 0]]", 35), false);
  ASSERT_TRUE(r.periods.steady) << r.periods.verdict;
  EXPECT_NEAR(figure(r, "run_up_time"), 5, 1e-9);
  EXPECT_EQ(run(prescribed("[[0, 0], [50, 100]]", 35), false).periods.verdict,
            "what drives is still being started, until 50 s");
}

std::string motors(const std::string& second, const std::string& steps, double until) {
  return fmt::format(R"(
line = ["motor", "rotor", "crank"]
motor = {{ {0} }}
second = {{ kind = "induction motor", on = "rotor", rated_power = "15 kW", rated_speed = "1460 rpm", synchronous_speed = "1500 rpm", breakdown_ratio = 3.0, inertia = "0.09 kg*m2", {1} }}
rotor = {{ kind = "flywheel", inertia = "0.3 kg*m2" }}
load = {{ kind = "load", on = "rotor", torque = "10 N*m" }}
sequence = {{ steps = [{2}] }}
run = {{ until = "{3} s" }}
)",
                     shunt, second, steps, until) +
         light_crank;
}
constexpr const char* soft = "starting = \"soft start\", ramp = \"20 s\", initial_voltage = 0.5";

TEST(DrivenTime, AMotorThatIsNeverOnIsNotWaitedFor) {
  const Result r = run(motors(soft, R"({ at = "0 s", set = "second", to = 0 })", 19), false);
  ASSERT_TRUE(r.periods.steady) << r.periods.verdict;
  EXPECT_LT(figure(r, "run_up_time"), 19);
}
// Switched off long before its ramp is through, it is not being started any more.
TEST(DrivenTime, AStartThatIsBrokenOffIsNotWaitedFor) {
  const Result off = run(motors(soft, R"({ at = "2 s", set = "second", to = 0 })", 19), false);
  ASSERT_TRUE(off.periods.steady) << off.periods.verdict;
  EXPECT_LT(figure(off, "run_up_time"), 19);
  const Result again =
      run(motors(soft, R"({ at = "2 s", set = "second", to = 0 }, { at = "4 s", set = "second", to = 1 })", 30), false);
  ASSERT_TRUE(again.periods.steady) << again.periods.verdict;
  EXPECT_NEAR(figure(again, "run_up_time"), 24, 1e-9);
}
TEST(DrivenTime, AMotorSwitchedOnLaterIsStartedFromThen) {
  const Result r =
      run(motors(soft, R"({ at = "0 s", set = "second", to = 0 }, { at = "3 s", set = "second", to = 1 })", 30), false);
  ASSERT_TRUE(r.periods.steady) << r.periods.verdict;
  EXPECT_NEAR(figure(r, "run_up_time"), 23, 1e-9);
}
// It has been on since the start, on its ramp of 20 s: to command it on again starts nothing.
TEST(DrivenTime, ACommandToWhatIsOnIsNoStart) {
  const Result r = run(motors(soft, R"({ at = "24 s", set = ["second", "load"], to = 1 })", 30), false);
  ASSERT_TRUE(r.periods.steady) << r.periods.verdict;
  EXPECT_NEAR(figure(r, "run_up_time"), 20, 1e-9);
}
// A ramp from the very start has no event; one that lowers a drive starts none.
TEST(DrivenTime, ARampFromTheStartIsAStart) {
  const auto ramped = [](const std::string& steps) {
    return run(fmt::format(R"(
line = ["motor", "rotor", "crank"]
motor = {{ kind = "dc shunt motor", stall_torque = "100000 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2" }}
rotor = {{ kind = "flywheel", inertia = "1 kg*m2" }}
sequence = {{ steps = [{}] }}
run = {{ until = "14 s" }}
)",
                           steps) +
                   light_crank,
               false);
  };
  const Result up =
      ramped(R"({ at = "0 s", set = "motor", to = 0.995 }, { at = "0 s", set = "motor", to = 1, over = "8 s" })");
  ASSERT_TRUE(up.periods.steady) << up.periods.verdict;
  EXPECT_NEAR(figure(up, "run_up_time"), 8, 1e-9);
  const Result down =
      ramped(R"({ at = "0 s", set = "motor", to = 1 }, { at = "1 s", set = "motor", to = 0.995, over = "8 s" })");
  ASSERT_TRUE(down.periods.steady) << down.periods.verdict;
  EXPECT_LT(down.periods.run_up_end.value_or(0), 8.9);
}
// The turns on the ramp say nothing about the motion after it.
TEST(DrivenTime, AFewTurnsAfterAStartAreNotJudgedByThoseBefore) {
  const Result r = run(motors(soft, R"({ at = "0 s", set = "second", to = 1 })", 20.05), false);
  EXPECT_FALSE(r.periods.steady) << r.periods.verdict;
  EXPECT_NE(r.periods.verdict.find("since 20 s"), std::string::npos) << r.periods.verdict;
}
// Of one run, and of the same run in two parts.
TEST(DrivenTime, AStartBeforeACheckpointIsKnownAfterIt) {
  const Scene scene = test::scene_from(
      motors(soft, R"({ at = "0 s", set = "second", to = 0 }, { at = "3 s", set = "second", to = 1 })", 30));
  SimulateOptions options;
  options.measure_error = false, options.keep_state = true;
  Scene first = scene;
  first.run.until = 10;
  const Result half = simulate(first, first.effects, "", options);
  options.go_on_from = half.checkpoint;
  const Result whole = simulate(scene, scene.effects, "", options);
  EXPECT_NEAR(figure(whole, "run_up_time"), 23, 1e-9) << whole.periods.verdict;
}

}  // namespace
}  // namespace kurbel::driven_time_test
