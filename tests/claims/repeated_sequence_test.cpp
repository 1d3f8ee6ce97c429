// repeated_sequence_test.cpp — sequences that repeat: slower than their clock, braking that the end of a run cuts short,
// a clutch that never grips; the fluctuation of a run-up that is not done.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/orbit/orbit.h"
#include "studies/cycle/orbit_cycle.h"
#include "studies/reduce/reduce.h"
#include "studies/run/run_findings.h"
#include "tests/published/published.h"
#include "tests/support/conclusions.h"
#include "tests/support/scenes.h"

namespace kurbel::repeated_sequence_test {
namespace {

using test::find;
using test::has;
using test::said;

// J = 1 kg·m². On: 10 − 0.2 ω, towards 50 rad/s with τ = 5 s; off: −0.1 ω, τ = 10 s.
std::string machine(const std::string& sequence) {
  return fmt::format(R"(
line = ["motor", "fan"]
motor = {{ kind = "dc shunt motor", stall_torque = "10 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2" }}
fan = {{ kind = "load", damping = "0.1 N*m*s/rad" }}
run = {{ until = "150 s", start = {{ speed = "20 rad/s" }} }}
[sequence]
{}
)",
                     sequence);
}
const char* const by_time =
    R"(steps = [{ set = "motor" }, { after = "2 s", set = "motor", to = 0 }, { after = "1 s", set = "fan" }])";
const char* const by_speed =
    R"(steps = [{ set = "motor" }, { speed_above = "40 rad/s", of = "motor", set = "motor", to = 0 },
  { speed_below = "20 rad/s", of = "motor", set = "motor", to = 0 }])";

Orbit orbit_of(const std::string& scene) { return find_orbit(test::model_of(scene), {}); }

// 2 s on, 1 s off, whatever the clock says below 3 s: ω_max = W (1 − a)/(1 − a c), ω_min = c ω_max.
TEST(RepeatedSequence, StepsThatTakeLongerThanTheClockAreThePeriod) {
  const double a = std::exp(-0.4), c = std::exp(-0.1), most = 50 * (1 - a) / (1 - a * c), least = c * most;
  for (const char* every : {"0.5 s", "1 s", "2 s", "2.9 s", "3 s"}) {
    const std::string scene = machine(fmt::format("every = \"{}\"\n{}", every, by_time));
    const Orbit orbit = orbit_of(scene);
    ASSERT_TRUE(orbit.repeats()) << every << orbit.words;
    EXPECT_NEAR(orbit.point.time, 3, 1e-9) << every;
    const Result r = test::run(scene);
    EXPECT_NEAR(test::figure(r, "delta.motor"), 2 * (most - least) / (most + least), 1e-6) << every;
    EXPECT_NEAR(test::figure(r, "period"), 3, 1e-9) << every;
  }
  EXPECT_NEAR(orbit_of(machine(fmt::format("every = \"4 s\"\n{}", by_time))).point.time, 4, 1e-9);
}

// From 20 to 40 rad/s in 5 ln(30/10), and back in 10 ln 2: no clock below that changes it, and above it rules.
TEST(RepeatedSequence, StepsThatWaitForTheMotionMayTakeLongerThanTheClock) {
  const double period = 5 * std::log(3) + 10 * std::log(2);
  for (const char* every : {"1 s", "5 s", "12 s"}) {
    const Orbit orbit = orbit_of(machine(fmt::format("every = \"{}\"\n{}", every, by_speed)));
    ASSERT_TRUE(orbit.repeats()) << every << orbit.words;
    EXPECT_NEAR(orbit.point.time, period, 1e-8) << every;
    EXPECT_TRUE(has(orbit.words, fmt::format("its steps take longer than every = {}", every))) << orbit.words;
    const Result r = test::run(machine(fmt::format("every = \"{}\"\n{}", every, by_speed)));
    EXPECT_NEAR(test::figure(r, "period"), period, 1e-7) << every;
    EXPECT_TRUE(has(said(r), fmt::format(" instead of {}, as its sequence takes longer", every))) << said(r);
  }
  const Orbit kept = orbit_of(machine(fmt::format("every = \"20 s\"\n{}", by_speed)));
  ASSERT_TRUE(kept.repeats()) << kept.words;
  EXPECT_NEAR(kept.point.time, 20, 1e-9);
}

// 60 N·m on 2 kg·m², braked with 100 N·m from 24 down to 20 rad/s, and on up to 24 rad/s: 1/3 s.
std::string between_two_speeds(const std::string& every) {
  return fmt::format(R"(
line = ["src", "wheel"]
src = {{ kind = "torque source", torque = "60 N*m", inertia = "0.1 kg*m2" }}
wheel = {{ kind = "flywheel", inertia = "1.9 kg*m2" }}
brake = {{ kind = "brake", on = "wheel", torque = "100 N*m" }}
[sequence]
every = "{}"
steps = [ {{ at = "0 s", set = "brake" }}, {{ speed_below = "20 rad/s", of = "wheel", set = "brake", to = 0 }},
          {{ speed_above = "24 rad/s", of = "wheel", set = "brake", to = 0 }} ]
[run]
start = {{ speed = "24 rad/s" }}
until = "30 s"
)",
                     every);
}

// From 24 rad/s the steps take 1/3 s; the clock's 0.5 s let it come to 29 rad/s, from where they take 0.58333 s.
TEST(RepeatedSequence, EverySecondRepetitionIsLate) {
  const Orbit orbit = orbit_of(between_two_speeds("0.5 s"));
  ASSERT_TRUE(orbit.repeats()) << orbit.words;
  EXPECT_NEAR(orbit.point.time, 0.5 + 7.0 / 12, 1e-8) << orbit.words;
}

// Every repetition is late by 1/30 s: a run has the period that the machine has.
TEST(RepeatedSequence, ARunHasThePeriodOfLateRepetitions) {
  const std::string scene = between_two_speeds("0.3 s");
  EXPECT_NEAR(orbit_of(scene).point.time, 1.0 / 3, 1e-9);
  for (const char* until : {"6 s", "30 s"}) {
    const Result r = test::run(test::with(scene, "until = \"30 s\"", fmt::format("until = \"{}\"", until)));
    EXPECT_TRUE(r.periods.steady) << r.periods.verdict;
    EXPECT_NEAR(test::figure(r, "period"), 1.0 / 3, 1e-8) << until;
    EXPECT_NEAR(test::figure(r, "driving_work_per_cycle"), 60 * 22 / 3.0, 1e-5) << until;
    EXPECT_NEAR(test::figure(r, "delta.src"), 4.0 / 22, 1e-8) << until;
  }
}

// 60 − 1.5 ω drives against 16 N·m of the brake on average, and from 10 s on 20 N·m more: ω = 16 rad/s.
TEST(RepeatedSequence, WhatBeginsLaterBelongsToTheSteadyMotion) {
  for (const char* begin : {"0 s", "2 s", "10 s"})
    for (const char* repeats : {"every = \"0.5 s\"", "repeat = true"}) {
      const bool clocked = repeats[0] == 'e';
      const Orbit orbit = orbit_of(fmt::format(R"(
line = ["motor", "wheel"]
motor = {{ kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", inertia = "0.1 kg*m2" }}
wheel = {{ kind = "flywheel", inertia = "1.9 kg*m2" }}
src = {{ kind = "load", on = "wheel", torque = "20 N*m", start = "{}" }}
brake = {{ kind = "brake", on = "wheel", torque = "40 N*m" }}
run = {{ start = {{ speed = "30 rad/s" }}, until = "60 s" }}
[sequence]
{}
steps = [ {{ {}set = "brake" }}, {{ after = "0.2 s", set = "brake", to = 0 }} ]
)",
                                               begin, repeats, clocked ? "" : "after = \"0.3 s\", "));
      ASSERT_TRUE(orbit.repeats()) << begin << repeats << orbit.words;
      const double off = std::exp(-0.75 * 0.3), on = std::exp(-0.75 * 0.2);  // 2 ω̇ = M − 1.5 ω
      const double to_off = 40 / 1.5, to_on = 0;
      // ω after the braking, and before it
      const double low = (to_on * (1 - on) + on * to_off * (1 - off)) / (1 - on * off);
      const double high = to_off + (low - to_off) * off;
      const OrbitCycle cycle = orbit_cycle(orbit, {});
      EXPECT_NEAR(cycle.mean_speed(), 16, 1e-6) << begin << repeats;
      EXPECT_NEAR(cycle.mid_speed(), 0.5 * (low + high), 1e-6) << begin << repeats;
    }
}

std::string hoist(const std::string& clutch, const std::string& until) {
  return fmt::format(R"(
line  = ["motor", "clutch", "brake", "drum"]
motor = {{ kind = "motor", inertia = "0.4 kg*m2", torque = {{ over = "speed", points = [[0, 220], [100, 110], [160, -22]], unit = ["rad/s", "N*m"] }} }}
clutch = {{ kind = "clutch", torque = "{}", inertia_out = "0.06 kg*m2" }}
brake = {{ kind = "brake", torque = "75 N*m" }}
drum  = {{ kind = "load", torque = "36 N*m", acts = "always", inertia = "0.1 kg*m2" }}
[sequence]
every = "4 s"
steps = [ {{ set = "clutch", to = 0 }}, {{ after = "0.5 s", set = "clutch" }}, {{ set = "brake", to = 0 }},
          {{ after = "2 s", set = "clutch", to = 0 }}, {{ set = "brake" }} ]
[run]
start = {{ motor = {{ speed = "140 rad/s" }} }}
until = "{}"
)",
                     clutch, until);
}

// The brake stops its drum within 0.2 s in each repetition, also in that which the end of the run cuts short.
TEST(RepeatedSequence, TheEndOfARunWithinABrakingIsNoBrakeThatIsTooWeak) {
  for (const char* until : {"14.55 s", "18.6 s", "22.65 s"}) {
    const Result r = test::run(hoist("90 N*m", until), false);
    EXPECT_FALSE(has(said(r), "does not stop")) << until << said(r);
    EXPECT_FALSE(has(said(r), "too weak")) << until << said(r);
    EXPECT_TRUE(has(said(r), "runs steadily")) << until << said(r);
  }
}

// A brake of 100 N·m from 3 s on takes 6 s for 20 kg·m² at 30 rad/s: as long as nothing drives it is not too weak; nor is it
// against 90 N·m; against 110 N·m it is.
TEST(RepeatedSequence, ABrakeThatSlowsIsNotTooWeak) {
  const auto words = [](const std::string& until, const std::string& drive) {
    return said(test::run(fmt::format(R"(
line = ["wheel", "x"]
wheel = {{ kind = "flywheel", inertia = "19 kg*m2" }}
x = {{ kind = "flywheel", inertia = "1 kg*m2" }}
brake = {{ kind = "brake", on = "wheel", torque = "100 N*m", start = "3 s" }}
src = {{ kind = "torque source", on = "x", torque = "{}" }}
run = {{ start = {{ speed = "30 rad/s" }}, until = "{}" }}
)",
                                      drive, until),
                          false));
  };
  for (const char* until : {"3.05 s", "3.5 s", "4 s", "6 s"})
    for (const char* drive : {"0 N*m", "90 N*m"}) {
      EXPECT_FALSE(has(words(until, drive), "too weak")) << until << drive << words(until, drive);
      EXPECT_TRUE(has(words(until, drive), "\"brake\" has not stopped it by the end")) << words(until, drive);
    }
  EXPECT_TRUE(has(words("6 s", "110 N*m"), "too weak for what drives")) << words("6 s", "110 N*m");
}

// 30 N·m against the weight's 36 N·m: the drum sinks while the clutch is closed.
TEST(RepeatedSequence, AClutchThatNeverGripsIsNamed) {
  const Result r = test::run(hoist("30 N*m", "12 s"), false);
  EXPECT_TRUE(has(said(r),
                  "\"clutch\" slips whenever it is closed, 3 times, first at 0.5 s, and is opened each time "
                  "before its sides turn together"))
      << said(r);
  EXPECT_LT(test::figure(r, "final_angle.drum"), -1);
  const Result grips = test::run(hoist("90 N*m", "12 s"), false);
  EXPECT_FALSE(has(said(grips), "whenever")) << said(grips);
}

// ω rises as W (1 − e^{−t/τ}), τ = 5 s, and a ripple of 1 N·m at 20 Hz makes δ = 2 · 1/(J 2π 20 W): in the run-up the range
// of the speed within a cycle is that of the rise, not of the ripple.
TEST(RepeatedSequence, ARunUpHasNoFluctuation) {
  const auto scene = [](double until) {
    return fmt::format(R"(
line = ["motor", "fan", "ripple"]
motor = {{ kind = "dc shunt motor", stall_torque = "10 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2" }}
fan = {{ kind = "load", damping = "0.1 N*m*s/rad" }}
ripple = {{ kind = "torque source", amplitude = "0.1 N*m", frequency = "20 Hz" }}
run = {{ until = "{} s", accuracy = 1e-8 }}
)",
                       until);
  };
  for (const double until : {3.0, 30.0}) {
    const Result rising = test::run(scene(until));
    EXPECT_FALSE(rising.find("delta.motor")) << until;
    EXPECT_FALSE(rising.find("cycle_fluctuation.motor")) << until;
  }
  const double expected = 2 * 0.1 / (2 * M_PI * 20) / 50;
  EXPECT_NEAR(test::figure(test::run(scene(90)), "delta.motor"), expected, 0.01 * expected);
}

// A prescribed speed sets no scale: a mass and a force on the slider, reduced to the slider, are themselves.
TEST(RepeatedSequence, ReductionToASliderOfAPrescribedSpeed) {
  for (const char* speed : {"speed = \"90 rpm\"", "speed = \"-300 rpm\""}) {
    const std::string scene = fmt::format(R"(
line  = ["drive", "press"]
drive = {{ kind = "prescribed speed", {} }}
press = {{ kind = "slider-crank", radius = "50 mm", rod = "200 mm", slider_mass = "100 kg", load = {{ kind = "constant", force = "-1 kN" }} }}
)",
                                          speed);
    ReduceOptions options;
    options.to = "press.slider";
    const MachineReduction r = reduce(test::scene_from(scene), options);
    int regular = 0;
    for (const ReducedPosition& p : r.positions) {
      if (!p.singular.empty()) continue;
      ++regular;
      EXPECT_NEAR(p.inertia, 100, 1e-8) << p.phi;
      EXPECT_NEAR(std::abs(p.load), 1000, 1e-6) << p.phi;
    }
    EXPECT_EQ(regular, 10);
  }
}

}  // namespace
}  // namespace kurbel::repeated_sequence_test
