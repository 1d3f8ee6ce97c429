// periods_test.cpp — run-up, steady motion and run-down against closed forms; no figure depends on what is sampled.
#include "studies/run/periods.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "studies/answers/higher_speeds.h"
#include "studies/answers/motion_claims.h"
#include "studies/answers/run_claims.h"
#include "studies/findings/trace.h"
#include "tests/support/scenes.h"

namespace kurbel::periods_test {
namespace {

using test::run;

constexpr double noise = 1e-9;

template <class F>
Approach approach(int n, const F& f) {
  std::vector<double> v;
  for (int k = 0; k < n; ++k) v.push_back(f(k));
  return approach_of(v, noise);
}

// 1 − q^k lacks q^(n−1) to its limit, however little it changes at each step.
TEST(Approach, OfAGeometricSequenceIsExact) {
  for (const double q : {0.1, 0.5, 0.9, 0.99, 0.9995})
    for (const int n : {3, 4, 7, 40}) {
      const Approach a = approach(n, [&](int k) { return 1 - std::pow(q, k); });
      const double rest = std::pow(q, n - 1);
      if (rest * (1 / q - 1) < 1e-8) continue;  // below the noise
      ASSERT_TRUE(a.remaining) << q << " " << n;
      EXPECT_NEAR(*a.remaining, rest, 1e-4 * rest) << q << " " << n;
    }
}

TEST(Approach, HasNoLimitWhereTheChangeDoesNotShrink) {
  for (const double rate : {1e-6, 1e-3, 1.0, -1e-3}) {
    EXPECT_FALSE(approach(50, [&](int k) { return 10 + rate * k; }).remaining) << rate;
    EXPECT_FALSE(approach(50, [&](int k) { return 10 + rate * k * k; }).remaining) << rate;
  }
  EXPECT_FALSE(approach(2, [](int) { return 1.0; }).remaining) << "two values tell no limit";
}

// A transient that dies at once, on a slow one: the slow one counts.
TEST(Approach, OfTwoTransientsIsThatOfTheSlowOne) {
  for (const int n : {24, 60}) {
    const Approach a = approach(n, [](int k) { return 10 - 5 * std::pow(0.3, k) - std::pow(0.99, k); });
    ASSERT_TRUE(a.remaining);
    EXPECT_GT(*a.remaining, 0.8 * std::pow(0.99, n - 1)) << n;
  }
}

// Three cycles from a run-up give one ratio, that of the motion that dies fastest: a slower one is still counted.
TEST(Approach, OfThreeCyclesAllowsForASlowerTransient) {
  for (const double slow : {0.02, 0.06, 0.1}) {
    const auto left = [&](int k) { return 5 * std::pow(0.01, k) + 0.2 * std::pow(slow, k); };
    const Approach a = approach(3, [&](int k) { return 10 - left(k); });
    ASSERT_TRUE(a.remaining) << slow;
    EXPECT_GE(*a.remaining, left(2)) << slow;
    EXPECT_LE(*a.remaining, std::abs(left(2) - left(1)) / 9 * (1 + 1e-12)) << slow;
  }
}

TEST(Approach, ToAndFroIsBoundedByItsRange) {
  const Approach beats = approach(60, [](int k) { return 10 + 1e-3 * std::cos(0.7 * k); });
  EXPECT_NEAR(*beats.remaining, 2e-3, 3e-4);
  EXPECT_LT(*approach(60, [](int k) { return 10 + std::pow(-0.8, k); }).remaining, 1e-3);
  EXPECT_GT(*approach(60, [](int k) { return 10 + 1e-4 * std::pow(-1.2, k); }).remaining, 1);
  EXPECT_LT(*approach(60, [](int k) { return 10 + 1e-10 * std::cos(k * k); }).remaining, 1e-9);
}

// M = 100 (1 − ω/100), I = 2: ω = 100 (1 − e^(−t/2)).
std::string motor_and_rotor(double until, const std::string& rotor = "", double accuracy = 1e-7) {
  return fmt::format(R"(
line = ["motor", "rotor"]
[motor]
kind = "dc shunt motor"
stall_torque = "100 N*m"
no_load_speed = "100 rad/s"
inertia = "1 kg*m2"
[rotor]
kind = "flywheel"
inertia = "1 kg*m2"
{}
[run]
until = "{} s"
accuracy = {}
)",
                     rotor, until, accuracy);
}

// Within 1 % of ω(T) at t = −2 ln(1 − 0.99 (1 − e^(−T/2))).
TEST(Periods, RunUpOfALinearMotorIsThatOfItsExponential) {
  for (const double until : {15.3, 20.0, 40.0})
    for (const double accuracy : {1e-4, 1e-6, 1e-8}) {
      const Result r = run(motor_and_rotor(until, "", accuracy));
      const Figure* f = r.find("run_up_time");
      ASSERT_TRUE(f && f->error) << until << " " << r.periods.verdict;
      EXPECT_NEAR(f->value, -2 * std::log(1 - 0.99 * (1 - std::exp(-until / 2))), *f->error) << until << accuracy;
      EXPECT_LT(*f->error, 1e3 * accuracy);
      EXPECT_NEAR(test::figure(r, "steady_speed.motor"), 100 * (1 - std::exp(-until / 2)), 1e2 * accuracy);
      EXPECT_NEAR(*r.periods.remaining, 100 * std::exp(-until / 2), 100 * (std::exp(-until / 2) + accuracy));
    }
}

// After six time constants the speed still lacks 0.25 %, although it changes by 0.09 % in a twentieth of the time.
TEST(Periods, AMotionOnTheWayIsNotSteadyHoweverSlowly) {
  const Result r = run(motor_and_rotor(12));
  EXPECT_FALSE(r.periods.steady);
  EXPECT_EQ(r.find("steady_speed.motor"), nullptr);
  EXPECT_EQ(r.find("run_up_time"), nullptr);
}

// A crank without mass turns with the flywheel: a cycle of nearly nothing. T = 2 π/ω, τ = I ω∞/M.
std::string with_crank(const std::string& motor, const std::string& flywheel, double speed, double until) {
  return fmt::format(R"(
line = ["motor", "flywheel", "crank"]
[motor]
{}
[flywheel]
kind = "flywheel"
inertia = "{}"
[crank]
kind = "slider-crank"
radius = "0.1 m"
rod = "0.4 m"
slider_mass = "1e-6 kg"
[run]
start = {{ speed = "{} rad/s" }}
until = "{} s"
accuracy = 1e-7
)",
                     motor, flywheel, speed, until);
}

// Driven until 1 s and from 3 s on; in the pause a load brakes the rotor from 50 to 46 rad/s and lets it come back, at last
// by 50 − 200 (1.6 s − t)². The pause belongs to the driven time: 1 % below 50 it was last at 1.55 s.
TEST(Periods, APauseOfTheDriveBelongsToItsTime) {
  const Result r = run(R"(
line = ["rotor"]
rotor = { kind = "flywheel", inertia = "1 kg*m2" }
early = { kind = "torque source", on = "rotor", torque = "10 N*m", stop = "1 s" }
late = { kind = "torque source", on = "rotor", torque = "10 N*m", start = "3 s" }
brake = { kind = "load", on = "rotor", torque = "10 N*m", acts = "always", start = "3 s" }
load = { kind = "load", on = "rotor", table = { over = "time", unit = ["s", "N*m"], points = [[0, 0], [1.2, 0], [1.3, 40], [1.4, 0], [1.5, -40], [1.6, 0], [10, 0]] } }
run = { start = { speed = "40 rad/s" }, until = "10 s", accuracy = 1e-8 }
)");
  EXPECT_TRUE(r.periods.steady) << r.periods.verdict;
  EXPECT_NEAR(r.periods.steady_speed, 50, 1e-6);
  ASSERT_TRUE(r.periods.run_up_end);
  EXPECT_NEAR(*r.periods.run_up_end, 1.55, 1e-5);
}

// δ = 0.014: where ω is 1 % below the last cycle's range the run-up still lasts. After its end ω keeps to that range.
TEST(Periods, ARunUpIsNotOverWithinTheFluctuationOfTheSteadySpeed) {
  const Scene scene = test::scene_file("scenes/six_link_press.toml");
  SimulateOptions options;
  options.traces = true, options.measure_error = false;
  const Result r = simulate(scene, scene.effects, "test", options);
  ASSERT_TRUE(r.periods.steady) << r.periods.verdict;
  ASSERT_TRUE(r.periods.run_up_end);
  const Trace& speed = *r.traces->find("speed.press");
  const CycleTraces& cycle = r.traces->last_cycles.back();
  double low = 1e9, high = 0, least_after = 1e9, most_after = 0;
  for (std::size_t k = 0; k < speed.x.size(); ++k) {
    if (speed.x[k] >= cycle.begin && speed.x[k] <= cycle.end)
      low = std::min(low, speed.y[k]), high = std::max(high, speed.y[k]);
    if (speed.x[k] > *r.periods.run_up_end)
      least_after = std::min(least_after, speed.y[k]), most_after = std::max(most_after, speed.y[k]);
  }
  const double tenth = 0.1 * (high - low);
  EXPECT_GT(least_after, low - tenth);
  EXPECT_LT(most_after, high + tenth);
  EXPECT_GT(*r.periods.run_up_end, 1.3) << "the first stroke, which is deeper, belongs to the run-up";
}

// δω a cycle below 0.1 %, for a hundred cycles: 63 rad/s of 100.
TEST(Periods, ALargeFlywheelIsNotSteadyBecauseItIsSlow) {
  const Result r = run(with_crank(
      "kind = \"dc shunt motor\"\nstall_torque = \"100 N*m\"\nno_load_speed = \"100 rad/s\"\ninertia = \"1e-3 kg*m2\"",
      "150 kg*m2", 50, 10));
  ASSERT_GT(r.cycles.size(), 80u);
  const double last = r.cycles.back().mid_speed(), before = r.cycles[r.cycles.size() - 2].mid_speed();
  EXPECT_LT(last / before - 1, 1e-3);
  EXPECT_FALSE(r.periods.steady);
  EXPECT_EQ(r.find("steady_speed.crank"), nullptr);
  // ω = 100 − 50 e^(−t/150)
  EXPECT_NEAR(*r.periods.remaining, 50 * std::exp(-r.cycles.back().end / 150), 2);
  EXPECT_NE(r.find("mean_speed.crank"), nullptr) << "the last cycle has its figures";
  EXPECT_EQ(r.find("cycle_fluctuation.crank"), nullptr) << "what the speed varies within it is its rise";
  EXPECT_EQ(r.find("delta.crank"), nullptr) << "δ is of motion that repeats";
}

// Constant torque without a load: ω̇ = M/I for ever, here by 1e-5 a cycle.
TEST(Periods, ARunawayIsNeverSteady) {
  const Result r = run(with_crank("kind = \"torque source\"\ntorque = \"1 N*m\"", "60 kg*m2", 50, 5));
  EXPECT_FALSE(r.periods.steady) << r.periods.verdict;
  EXPECT_FALSE(r.periods.remaining);
  EXPECT_EQ(r.find("steady_speed.crank"), nullptr);
  EXPECT_NE(r.periods.verdict.find("does not decrease"), std::string::npos) << r.periods.verdict;
  const Result series = run(R"(
line = ["motor", "rotor"]
[motor]
kind = "dc series motor"
voltage = "220 V"
resistance = "1 Ohm"
constant = "0.02 N*m/A2"
max_speed = "5000 rad/s"
inertia = "1.5 kg*m2"
[rotor]
kind = "flywheel"
inertia = "200 kg*m2"
[run]
until = "5 s"
)");
  ASSERT_TRUE(series.complete) << series.diagnosis;
  EXPECT_FALSE(series.periods.steady) << series.periods.verdict;
}

// Started at its steady speed, which it keeps: nothing to run up.
TEST(Periods, AMachineThatBeginsSteadyIsSteadyAndHasNoRunUp) {
  const Result r = run(with_crank(
      "kind = \"dc shunt motor\"\nstall_torque = \"100 N*m\"\nno_load_speed = \"100 rad/s\"\ninertia = \"1e-3 kg*m2\"",
      "1 kg*m2", 100, 1));
  EXPECT_TRUE(r.periods.steady) << r.periods.verdict;
  EXPECT_EQ(r.find("run_up_time"), nullptr);
  EXPECT_NEAR(test::figure(r, "steady_speed.crank"), 100, 1e-4);
}

// Dry friction stops the rotor behind the coupling at once; the pendulum crank swings on: its turning points are no
// rest.
TEST(Periods, AMachineThatOscillatesIsNotAtRestWhereItTurnsBack) {
  const Result r = run(R"(
line = ["motor", "crank"]
[motor]
kind = "torque source"
torque = "40 N*m"
stop = "0.5 s"
inertia = "0.05 kg*m2"
[crank]
kind = "slider-crank"
radius = "0.1 m"
rod = "0.4 m"
slider_mass = "20 kg"
gravity = "9.81 m/s2"
stroke_angle = "-90 deg"
[run]
start = { angle = "10 deg" }
until = "6 s"
accuracy = 1e-7
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_TRUE(r.periods.run_down_begin);
  EXPECT_FALSE(r.periods.standstill);
}

// A compressor oscillates about its dead centre, slower and slower, and is held for a moment where it turns: below 0.1
// % for good before the last such turn, which is no rest.
TEST(Periods, AHoldThatEndsAnOscillationIsNoRest) {
  const Result r = run(R"(
line = ["motor", "coupling", "flywheel", "machine"]
[motor]
kind = "motor"
torque = { over = "speed", unit = ["rad/s", "N*m"], points = [[0, 1612], [76.764, 967.18], [99.794, 0]] }
inertia = "1.409 kg*m2"
stop = "5.7843 s"
[coupling]
kind = "rubber coupling"
stiffness = "258.91 N*m/rad"
damping_ratio = 0.05
branches = [{ stiffness = "103.56 N*m/rad", relaxation_time = "10 ms" }]
[flywheel]
kind = "flywheel"
inertia = "1.0225 kg*m2"
[machine]
kind = "slider-crank"
radius = "0.094276 m"
rod = "0.37873 m"
crank_inertia = "3.2876 kg*m2"
slider_mass = "17.434 kg"
gravity = "9.81 m/s2"
stroke_angle = "0 deg"
load = { kind = "compressor", bore = "0.17188 m", suction_pressure = "50513 Pa", delivery_pressure = "2.0205e+05 Pa", clearance = 0.06 }
[effects]
elasticity = true
[run]
until = "40 s"
)",
                       false);
  ASSERT_TRUE(r.complete && r.periods.standstill) << r.diagnosis;
  const auto hold = std::find_if(r.events.begin(), r.events.end(), [&](const Event& e) {
    return e.kind == EventKind::rest && e.t >= *r.periods.standstill;
  });
  ASSERT_NE(hold, r.events.end());
  EXPECT_GT(hold->t, *r.periods.standstill + 0.5);
  EXPECT_TRUE(std::any_of(hold, r.events.end(), [](const Event& e) { return e.kind == EventKind::motion; }));
}

// Braked on the motor's side, the press vibrates on behind its coupling: at the end it passes through rest at less than
// 1 % of its usual 170 rad/s, and was at 27 rad/s within the same half cycle.
TEST(Periods, AnOscillationIsNotNearlyAtRestWhereItTurns) {
  const Result r = run(R"(
line = ["motor", "brake", "coupling", "machine"]
[motor]
kind = "dc shunt motor"
stall_torque = "3960.2 N*m"
no_load_speed = "170.18 rad/s"
inertia = "1.4714 kg*m2"
[brake]
kind = "brake"
torque = "9269.7 N*m"
static_torque = "11363 N*m"
inertia = "0.49047 kg*m2"
[coupling]
kind = "coupling"
stiffness = "6690 N*m/rad"
damping_ratio = 0.0154
[machine]
kind = "slider-crank"
radius = "0.030677 m"
rod = "0.13496 m"
crank_inertia = "3.4333 kg*m2"
slider_mass = "716.68 kg"
load = { kind = "table", force = { over = "angle", unit = ["deg", "N"], period = "360 deg", points = [[0, 0], [180, 0], [200, 43390], [330, 43390], [360, 0]] } }
[sequence]
steps = [{ at = "0 s", set = "brake", to = 0 }, { at = "1.516 s", set = "brake" }]
[effects]
elasticity = true
[run]
until = "3.06579 s"
)",
                       false);
  ASSERT_LT(std::abs(test::figure(r, "final_speed.machine")), 1.7);
  std::string said;
  for (const Claim& c : run_claims(r)) said += c.text + ". ";
  EXPECT_NE(said.find("ends vibrating, at up to 2"), std::string::npos) << said;
  EXPECT_EQ(said.find("nearly at rest"), std::string::npos) << said;
}

// What drives is held by what the coupling's damper takes, which no balance of the rigid machine has in it: the crank's uneven
// inertia shakes it. At 1.7 times its speed the machine still gains by no less from turn to turn; it settles at three times.
Scene held_by_its_damper(double until) {
  return test::scene_from(fmt::format(R"(
line = ["motor", "crank", "coupling", "wheel"]
motor = {{ kind = "torque source", torque = "4 N*m", inertia = "0.01 kg*m2" }}
coupling = {{ kind = "coupling", stiffness = "4000 N*m/rad", damping = "3 N*m*s/rad" }}
wheel = {{ kind = "flywheel", inertia = "1 kg*m2" }}
effects = {{ elasticity = true }}
run = {{ start = {{ speed = "20 rad/s" }}, until = "{} s" }}
[crank]
kind = "slider-crank"
radius = "0.1 m"
rod = "0.4 m"
slider_mass = "10 kg"
crank_inertia = "0.03 kg*m2"
)",
                                      until));
}
bool says(const Claims& all, Predicate what) {
  return std::any_of(all.begin(), all.end(), [&](const Claim& c) { return c.predicate == what; });
}
TEST(Periods, WhatADamperSettlesDoesNotRunAway) {
  EXPECT_FALSE(says(run_claims(run(held_by_its_damper(4), false)), Predicate::runs_away));
  EXPECT_TRUE(says(run_claims(run(held_by_its_damper(64), false)), Predicate::runs_steadily));
}
TEST(RunsAway, WhatGainsByNoLess) {
  EXPECT_TRUE(keeps_gaining({10, 20, 30}) && keeps_gaining({10, 20, 40}));
  for (const std::array<double, 3>& mean : {std::array{10.0, 20.0, 29.0}, {100, 50, 40}, {100, 90, 70}, {20, 10, 10}})
    EXPECT_FALSE(keeps_gaining(mean)) << mean[0] << ' ' << mean[1] << ' ' << mean[2];
}
// Interrupted, or without a budget, the trial that would deny it ends.
TEST(RunsAway, ItsTrialIsEndedByWhatEndsTheRun) {
  const Scene scene = held_by_its_damper(4);
  const Result r = run(scene, false);
  const auto model = compile(scene, scene.effects);
  Equations equations(model, false);
  SlipRecorder slips(*model);
  LinkRecorder link(*model, 4);
  const RunOutcome outcome =
      integrate(equations, {.tolerance = 1e-7, .method = "auto", .until = 4, .progress = {}}, {&slips, &link});
  const std::atomic<bool> stop = true;
  const auto runs_away = [&](const Watch& watch, double budget) {
    return says(motion_claims(equations, outcome, r, slips, link, watch, budget), Predicate::runs_away);
  };
  EXPECT_FALSE(runs_away({}, 300));
  EXPECT_TRUE(runs_away({.interrupted = &stop}, 300));
  EXPECT_TRUE(runs_away({}, outcome.statistics.cpu_seconds));
}

// Along a law over time, from 40 s to 140 s: ω = 100 − (t − 40)/2 with a lag of 2 s. What counts is the time since its end.
TEST(Periods, AreJudgedSinceTheEndOfALawOverTime) {
  const Result r =
      run(motor_and_rotor(170) +
          "[sequence]\nsteps = [{ at = \"40 s\", set = \"motor\", law = { over = \"time\", formula = \"1 - "
          "t/(200 s)\", range = [\"0 s\", \"100 s\"] } }]\n");
  EXPECT_TRUE(r.periods.steady) << r.periods.verdict;
  EXPECT_NEAR(r.periods.steady_speed, 50, 1e-3);
}

// Half the voltage from 40 s on: ω = 50 + 50 e^(−(t−40)/2). What it still has to go is that of the time since.
TEST(Periods, AreJudgedSinceTheLastCommand) {
  const Result r = run(motor_and_rotor(56) + "[sequence]\nsteps = [{ at = \"40 s\", set = \"motor\", to = 0.5 }]\n");
  EXPECT_TRUE(r.periods.steady) << r.periods.verdict;
  EXPECT_NEAR(*r.periods.remaining, 50 * std::exp(-8.0), 50 * std::exp(-8.0));
  ASSERT_TRUE(r.periods.run_up_end);
  // Within 1 % of ω(56) = 50.0168 from above: 50 e^(−x/2) = 0.01 ω + 50 e^(−8)
  const double last = 50 + 50 * std::exp(-8.0);
  EXPECT_NEAR(*r.periods.run_up_end, 40 - 2 * std::log((1.01 * last - 50) / 50), 1e-5);
}

// Two cycles of a motion since the last command are too few, though their mid speeds and those before the motor was
// reversed lie on a sequence with a limit: the limit is 0.04 % off.
TEST(Periods, OfFewCyclesSinceTheLastCommandAreNotSteady) {
  const auto reversed = [](double until) {
    return run(fmt::format(R"(
line = ["motor", "coupling", "machine"]
motor = {{ kind = "dc shunt motor", stall_torque = "76.85 N*m", no_load_speed = "31.503 rad/s", inertia = "0.1181 kg*m2" }}
coupling = {{ kind = "coupling", stiffness = "1136.6 N*m/rad", damping_ratio = 0.0252 }}
sequence = {{ steps = [{{ at = "0.8619 s", set = "motor", to = -0.5, over = "0.15516 s" }}] }}
effects = {{ elasticity = true }}
run = {{ until = "{} s" }}
[machine]
kind = "slider-crank"
radius = "0.10992 m"
rod = "0.49679 m"
crank_inertia = "0.27556 kg*m2"
slider_mass = "2.0849 kg"
load = {{ kind = "opposing", force = "171.81 N" }}
)",
                           until));
  };
  const Result r = reversed(2.87286);
  ASSERT_EQ(std::count_if(r.cycles.begin(), r.cycles.end(), [](const CycleRecord& c) { return c.begin > 1.01706; }), 2);
  ASSERT_GT(r.cycles.size(), 3u);
  EXPECT_FALSE(r.periods.steady);
  EXPECT_EQ(r.periods.verdict, "2 whole cycles since 1.01706 s, of at least 3 needed");
  const Result longer = reversed(11.5);
  ASSERT_TRUE(longer.periods.steady) << longer.periods.verdict;
  EXPECT_GT(std::abs(longer.cycles.back().mid_speed() / r.cycles.back().mid_speed() - 1), 2e-4);
}

// Off after 1 ms at a tenth of the usual 100 rad/s: ω = 50 − 40 e^(−t), then e^(−t/2) down to 0.1 rad/s.
TEST(Periods, StandstillIsByTheUsualSpeedHoweverSlowTheDriveWas) {
  const Result r = run(R"(
line = ["motor", "rotor"]
motor = { kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2", stop = "1 ms" }
rotor = { kind = "load", damping = "1 N*m*s/rad", inertia = "1 kg*m2" }
run = { start = { speed = "10 rad/s" }, until = "20 s", accuracy = 1e-7 }
)");
  ASSERT_TRUE(r.periods.standstill) << r.periods.verdict;
  EXPECT_NEAR(*r.periods.standstill, 1e-3 + 2 * std::log((50 - 40 * std::exp(-1e-3)) / 0.1), 1e-5);
}

// A weight of 10 N·m, seen through a gear of η = 0.45 that no weight drives: 100 N·m (1 − ω/100) lift it at 100 − 10/η. Off
// at 20 s the motor's 1 kg·m² lift it on against the drum's 0.1, by 10/(η + 0.1) rad/s², until the gear holds.
TEST(Periods, StandstillIsWhereTheLossesOfAGearHoldTheLink) {
  const Result r = run(R"(
line = ["motor", "gear", "drum"]
motor = { kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2", stop = "20 s" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 40] }], efficiency_forwards = 0.45, efficiency_backwards = -0.2 }
drum = { kind = "flywheel", inertia = "0.4 kg*m2" }
weight = { kind = "load", on = "drum", torque = "20 N*m", acts = "always" }
run = { until = "40 s", accuracy = 1e-8 }
)");
  const double steady = 100 - 10 / 0.45, fades = 1 + 0.1 / 0.45;
  ASSERT_TRUE(r.periods.standstill) << r.periods.verdict;
  EXPECT_NEAR(*r.periods.standstill, 20 + steady * (1 - std::exp(-20 / fades)) * (0.45 + 0.1) / 10, 1e-6);
}

// --- nothing depends on what is sampled ---

void expect_same_figures(const Result& a, const Result& b, const std::string& what) {
  ASSERT_EQ(a.figures.size(), b.figures.size()) << what;
  for (std::size_t k = 0; k < a.figures.size(); ++k) {
    EXPECT_EQ(a.figures[k].name, b.figures[k].name) << what;
    EXPECT_EQ(a.figures[k].value, b.figures[k].value) << what << " " << a.figures[k].name;
    EXPECT_EQ(a.figures[k].error, b.figures[k].error) << what << " " << a.figures[k].name;
    EXPECT_EQ(a.figures[k].at, b.figures[k].at) << what << " " << a.figures[k].name;
  }
  EXPECT_EQ(a.periods.steady, b.periods.steady) << what;
  EXPECT_EQ(a.periods.run_up_end, b.periods.run_up_end) << what;
  EXPECT_EQ(a.periods.standstill, b.periods.standstill) << what;
}

class FiguresOf : public testing::TestWithParam<std::pair<const char*, double>> {};
INSTANTIATE_TEST_SUITE_P(Each, FiguresOf,
                         testing::Values(std::pair{"crank_press", 0.8}, std::pair{"driven_slider_crank", 2.0},
                                         std::pair{"stick_slip", 0.5}, std::pair{"series_motor_crane", 1.0},
                                         std::pair{"six_inertia_chain", 0.3}, std::pair{"diesel_generator", 0.2},
                                         std::pair{"compressor", 0.4}, std::pair{"press_drive", 1.5},
                                         std::pair{"planetary_brake", 2.0}, std::pair{"dc_hoist", 1.0},
                                         std::pair{"worn_crank_pin", 0.05}, std::pair{"belt_mill", 1.0}),
                         [](const auto& info) { return std::string(info.param.first); });

TEST_P(FiguresOf, AScenesRunAreTheSameWhateverIsSampled) {
  const std::string file = std::string("scenes/") + GetParam().first + ".toml";
  Scene scene = test::scene_file(file);
  scene.run.until = GetParam().second;
  const Result usual = run(scene);
  for (const int samples : {2, 50, 2000}) {
    Scene other = scene;
    other.run.samples = samples;
    if (samples == 50) other.run.output = {scene.components.front().name};
    if (samples == 2) other.run.output = {scene.components.back().name};
    SimulateOptions options;
    options.traces = samples == 2;
    const Result r = simulate(other, other.effects, "test", options);
    expect_same_figures(usual, r, fmt::format("{} samples", samples));
  }
}

}  // namespace
}  // namespace kurbel::periods_test
