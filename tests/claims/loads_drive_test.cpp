// loads_drive_test.cpp — claims on what loads do after a drive is off or too weak, and on what has left a vibration.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>

#include "studies/answers/run_claims.h"
#include "studies/run/run_findings.h"
#include "tests/support/conclusions.h"
#include "tests/support/scenes.h"

namespace kurbel::loads_drive_test {
namespace {

using test::find;
using test::has;
using test::said;
using test::scene_from;

// A drum vibrates about its weight until the motor is off at 9 s; then it falls at 50 rad/s².
std::string shaken_hoist(const char* brake) {
  return std::string(R"(
line = ["motor", "drum"]
motor = { kind = "torque source", amplitude = "40 N*m", torque = "20 N*m", frequency = "2 Hz", phase = "90 deg", inertia = "0.1 kg*m2", stop = "9 s" }
drum = { kind = "load", torque = "20 N*m", acts = "always", inertia = "0.3 kg*m2" }
run = { start = "rest", until = "10.4 s" }
)") + brake;
}

TEST(LoadsDrive, AFallAfterAVibrationIsNoVibration) {
  const Result r = test::run(shaken_hoist(""), false);
  const Claim* falls = find(r.claims, Predicate::turns_back, "motor");
  ASSERT_TRUE(falls) << said(r);
  EXPECT_NEAR(*falls->evidence.value, -70, 0.1);
  EXPECT_FALSE(find(r.claims, Predicate::vibrates)) << said(r);
  const Result slower = test::run(
      shaken_hoist("catch = { kind = \"brake\", on = \"drum\", torque = \"5 N*m\", start = \"9 s\" }"), false);
  falls = find(slower.claims, Predicate::turns_back, "motor");
  ASSERT_TRUE(falls) << said(slower);
  EXPECT_TRUE(has(falls->text, "\"catch\" does not hold them")) << falls->text;
}

// 50 N·m at rest, 0 at 10 rad/s, off at 4 s: a free flywheel keeps its speed.
TEST(LoadsDrive, AFreeFlywheelIsDrivenByNothing) {
  const Result r = test::run(R"(line = ["motor", "wheel"]
motor = { kind = "dc shunt motor", stall_torque = "50 N*m", no_load_speed = "10 rad/s", inertia = "1 kg*m2", stop = "4 s" }
wheel = { kind = "flywheel", inertia = "1 kg*m2" }
run = { until = "8 s" }
)",
                             false);
  EXPECT_TRUE(has(said(r), ", runs down from 4 s")) << said(r);
  EXPECT_FALSE(has(said(r), "its loads")) << said(r);
}

// A weight of 6 N·m against a brake of 3 N·m.
TEST(LoadsDrive, ABrakeThatIsTooWeakIsNamed) {
  const Result r = test::run(R"(line = ["motor", "drum"]
motor = { kind = "dc shunt motor", stall_torque = "50 N*m", no_load_speed = "10 rad/s", inertia = "1 kg*m2", stop = "4 s" }
drum = { kind = "load", torque = "-6 N*m", acts = "always", inertia = "1 kg*m2" }
brake = { kind = "brake", on = "drum", torque = "3 N*m", start = "4 s" }
run = { until = "14 s" }
)",
                             false);
  const Claim* away = find(r.claims, Predicate::runs_away, "motor");
  ASSERT_TRUE(away) << said(r);
  EXPECT_TRUE(has(away->text, "\"brake\" does not hold them")) << away->text;
}

// A pendulum swings for 9.7 s; then a motor turns it forwards, thrice as fast as ever.
TEST(LoadsDrive, WhatHasJustLeftItsSwingDoesNotTurnToAndFro) {
  const Result r = test::run(R"(line = ["motor", "press"]
motor = { kind = "dc shunt motor", stall_torque = "300 N*m", no_load_speed = "30 rad/s", inertia = "0.01 kg*m2", start = "9.7 s" }
press = { kind = "slider-crank", radius = "100 mm", rod = "400 mm", crank_mass = "20 kg", crank_com = "300 mm", crank_inertia = "3 kg*m2", slider_mass = "1 kg", gravity = "9.81 m/s2", stroke_angle = "0 deg" }
run = { start = { angle = "-30 deg" }, until = "9.9 s" }
)",
                             false);
  EXPECT_FALSE(find(r.claims, Predicate::does_not_get_round)) << said(r);
}

// A crank whose rod is too short for a turn.
TEST(LoadsDrive, ACrankThatRocksIsToCompleteNoCycle) {
  const Result r = test::run(R"(line = ["motor", "gear", "pend"]
motor = { kind = "torque source", torque = "8 N*m", inertia = "0.01 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 60], inertia = ["0.001 kg*m2", "0.01 kg*m2"] }] }
[pend]
kind          = "slider-crank"
radius        = "300 mm"
rod           = "200 mm"
offset        = "-280 mm"
crank_mass    = "12 kg"
crank_com     = "450 mm"
crank_inertia = "2.6 kg*m2"
rod_mass      = "0.4 kg"
rod_inertia   = "1.5e-3 kg*m2"
slider_mass   = "0.6 kg"
gravity       = "9.81 m/s2"

load          = { kind = "medium", viscous = "2 N*s/m" }
[run]
start    = { angle = "-80 deg" }
until = "20 s"
)",
                             false);
  EXPECT_FALSE(find(r.claims, Predicate::does_not_get_round)) << said(r);
  EXPECT_TRUE(find(r.claims, Predicate::vibrates)) << said(r);
}

// 20 N·m on 500 kg·m² behind a shaft that vibrates: 0.08 rad/s after 2 s, and nothing holds it.
TEST(LoadsDrive, AHeavyFlywheelThatGathersSpeedDoesNotStall) {
  const Result r = test::run(R"(line = ["motor", "shaft", "wheel"]
motor = { kind = "dc shunt motor", stall_torque = "20 N*m", no_load_speed = "100 rad/s", inertia = "0.02 kg*m2" }
shaft = { kind = "shaft", stiffness = "10 kN*m/rad", damping_ratio = 0.05 }
wheel = { kind = "flywheel", inertia = "500 kg*m2" }
effects = { elasticity = true }
run = { start = "rest", until = "2 s" }
)",
                             false);
  EXPECT_FALSE(find(r.claims, Predicate::stalls)) << said(r);
  EXPECT_FALSE(find(r.claims, Predicate::does_not_start)) << said(r);
}

// 40 N·m, on from 3 s, against a weight of 20 N·m that has brought it to −30 rad/s: −20 rad/s at 4 s.
TEST(LoadsDrive, NoLoadIsStrongerThanWhatStopsIt) {
  const Result r = test::run(R"(line = ["motor", "drum"]
motor = { kind = "torque source", torque = "40 N*m", inertia = "1 kg*m2", start = "3 s" }
drum = { kind = "load", torque = "20 N*m", acts = "always", inertia = "1 kg*m2" }
run = { start = "rest", until = "4 s" }
)",
                             false);
  EXPECT_NEAR(test::figure(r, "final_speed.drum"), -20, 1e-6);
  EXPECT_FALSE(has(said(r), "stronger")) << said(r);
}

// A motor pushes a crank backwards for less than a turn; then it coasts without friction, and its speed varies within each
// turn by 0.65 of its mean.
TEST(LoadsDrive, NoLoadDrivesACrankThatCoastsBackwards) {
  for (const char* times : {"0.03 2.0", "0.08 1.5", "0.08 2.33", "0.1 1.7", "0.13 2.0", "0.25 2.0", "3.1 6"}) {
    const std::string stop(times, std::string_view(times).find(' ')), until(times + stop.size() + 1);
    const Result r = test::run(fmt::format(R"(line = ["motor", "press"]
motor = {{ kind = "torque source", torque = "-60 N*m", inertia = "0.05 kg*m2", stop = "{} s" }}
press = {{ kind = "slider-crank", radius = "100 mm", rod = "400 mm", crank_mass = "2 kg", crank_inertia = "0.1 kg*m2", slider_mass = "40 kg" }}
run = {{ start = "rest", until = "{} s" }}
)",
                                           stop, until),
                               false);
    EXPECT_LT(test::figure(r, "final_speed.press"), -1);
    EXPECT_FALSE(find(r.claims, Predicate::turns_back)) << times << ": " << said(r);
  }
}

// 102 N·m of the motor slip away in a clutch of 20 N·m, behind a gear of 3: 20 N·m reach the press.
TEST(LoadsDrive, AClutchThatSlipsPassesItsOwnTorque) {
  const auto said_of = [](const char* load) {
    return said(test::run(fmt::format(R"(line = ["motor", "gearbox", "clutch", "press", "drag"]
motor = {{ kind = "dc shunt motor", stall_torque = "153 N*m", no_load_speed = "100 rad/s", inertia = "0.1 kg*m2" }}
gearbox = {{ kind = "gearbox", stages = [{{ teeth = [20, 60], inertia = ["0.001 kg*m2", "0.01 kg*m2"] }}] }}
clutch = {{ kind = "clutch", torque = "20 N*m", inertia_in = "0.01 kg*m2", inertia_out = "0.01 kg*m2" }}
press = {{ kind = "slider-crank", radius = "100 mm", rod = "400 mm", crank_mass = "20 kg", crank_inertia = "3 kg*m2", slider_mass = "1 kg" }}
drag = {{ kind = "load", {}, inertia = "0.3 kg*m2" }}
run = {{ start = "rest", until = "12 s" }}
)",
                                      load),
                          false));
  };
  const std::string held = said_of("torque = \"50 N*m\"");
  EXPECT_TRUE(held.starts_with("\"press\" does not start: its loads hold the 20 N·m that drive it")) << held;
  const std::string pushed = said_of("torque = \"26 N*m\", acts = \"always\"");
  EXPECT_TRUE(has(pushed, "its loads are stronger than the 20 N·m that drive it forwards")) << pushed;
}

// Behind the clutch a gear of 3 makes 60 N·m of its 20; in a line that begins with the load it makes 6.667 N·m.
TEST(LoadsDrive, TheTorqueOfAClutchIsReducedToTheLink) {
  const auto said_of = [](const char* line) {
    return said(test::run(fmt::format(R"(line = [{}]
motor = {{ kind = "dc shunt motor", stall_torque = "153 N*m", no_load_speed = "100 rad/s", inertia = "0.1 kg*m2" }}
gearbox = {{ kind = "gearbox", stages = [{{ teeth = [20, 60], inertia = ["0.001 kg*m2", "0.01 kg*m2"] }}] }}
clutch = {{ kind = "clutch", torque = "20 N*m", inertia_in = "0.01 kg*m2", inertia_out = "0.01 kg*m2" }}
press = {{ kind = "slider-crank", radius = "100 mm", rod = "400 mm", crank_mass = "20 kg", crank_inertia = "3 kg*m2", slider_mass = "1 kg" }}
drag = {{ kind = "load", torque = "90 N*m", inertia = "0.3 kg*m2" }}
run = {{ start = "rest", until = "3 s" }}
)",
                                      line),
                          false));
  };
  const std::string geared = said_of(R"("motor", "clutch", "gearbox", "press", "drag")");
  EXPECT_TRUE(has(geared, "its loads hold the 60 N·m that drive it.")) << geared;
  const std::string mirrored = said_of(R"("drag", "press", "gearbox", "clutch", "motor")");
  EXPECT_TRUE(has(mirrored, "its loads hold the 6.667 N·m that drive it.")) << mirrored;
}

// A pendulum of 59 N·m behind that clutch comes to rest where it balances the clutch's torque.
TEST(LoadsDrive, WhatRestsHasNoSpeedOfRounding) {
  const Result r = test::run(R"(line = ["motor", "clutch", "press"]
motor = { kind = "dc shunt motor", stall_torque = "153 N*m", no_load_speed = "100 rad/s", inertia = "0.1 kg*m2" }
clutch = { kind = "clutch", torque = "20 N*m", inertia_in = "0.01 kg*m2", inertia_out = "0.01 kg*m2" }
press = { kind = "slider-crank", radius = "100 mm", rod = "400 mm", crank_mass = "20 kg", crank_com = "300 mm", crank_inertia = "3 kg*m2", slider_mass = "1 kg", gravity = "9.81 m/s2", stroke_angle = "0 deg", load = { kind = "medium", viscous = "2000 N*s/m" } }
run = { start = { angle = "-30 deg" }, until = "12 s" }
)",
                             false);
  EXPECT_TRUE(has(said(r), "at the end, at rest, where 20 N·m drive it")) << said(r);
}

// What stood at the end of a run stands in its continuation, however short.
TEST(LoadsDrive, AMachineThatStandsIsNamedInItsContinuation) {
  const Scene scene = scene_from(R"(line = ["motor", "drum"]
motor = { kind = "dc shunt motor", stall_torque = "20 N*m", no_load_speed = "100 rad/s", inertia = "0.1 kg*m2" }
drum = { kind = "load", torque = "50 N*m", inertia = "0.3 kg*m2" }
run = { start = "rest", until = "6 s" }
)");
  SimulateOptions options{.measure_error = false, .method = {}, .accuracy = {}, .until = {}, .keep_state = true};
  const Result first = simulate(scene, scene.effects, "first", options);
  options.go_on_from = first.checkpoint;
  for (const double until : {6.01, 6.5, 60.0}) {
    options.until = until;
    const Result on = simulate(scene, scene.effects, "continued", options);
    EXPECT_TRUE(said(on).starts_with("\"motor\" does not turn: its loads hold the 20 N·m that drive it")) << said(on);
  }
}

}  // namespace
}  // namespace kurbel::loads_drive_test
