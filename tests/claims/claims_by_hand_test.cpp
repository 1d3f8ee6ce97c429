// claims_by_hand_test.cpp — what is said of motors and brakes behind gears, of slip in several spells, of strokes and
// sticking shafts, with numbers that are known here.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drivetrain/friction/belt.h"
#include "studies/answers/link_recorder.h"
#include "studies/answers/run_claims.h"
#include "tests/support/conclusions.h"
#include "tests/support/scenes.h"

namespace kurbel::claims_by_hand_test {
namespace {

using test::find;
using test::has;

// The motor's 50 N·m are 150 on the crank, which a brake of 200 stops within its first cycle.
TEST(MotorBehindAGear, DrivesTheLinkByItsTorqueTimesTheRatio) {
  const Result r = test::run(R"(
    line = ["motor", "gear", "crank"]
    motor = { kind = "torque source", torque = "50 N*m", inertia = "0.1 kg*m2" }
    gear = { kind = "gearbox", stages = [{ teeth = [20, 60] }] }
    crank = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "1 kg*m2", slider_mass = "1 g" }
    brake = { kind = "brake", on = "crank", torque = "200 N*m" }
    run = { start = { speed = "0.5 rad/s" }, until = "3 s" }
  )");
  const Claim* halts = find(r.claims, Predicate::does_not_get_round, "crank");
  ASSERT_TRUE(halts);
  EXPECT_NEAR(*halts->evidence.value, 150, 1e-9);
}

// Below its breakdown speed of some 120 rad/s a viscous load holds it, which takes three times its speed on the crank.
TEST(MotorBehindAGear, StaysAtASpeedOfItsOwn) {
  const Result r = test::run(R"(
    line = ["motor", "gear", "crank"]
    motor = { kind = "induction motor", rated_power = "4 kW", rated_speed = "1440 rpm", synchronous_speed = "1500 rpm", breakdown_ratio = 2.8, inertia = "0.02 kg*m2" }
    gear = { kind = "gearbox", stages = [{ teeth = [20, 60] }] }
    crank = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "0.1 kg*m2", slider_mass = "1 g" }
    drag = { kind = "load", on = "crank", damping = "6.2 N*m*s/rad" }
    run = { start = { speed = "10 rad/s" }, until = "5 s" }
  )",
                             false);
  ASSERT_TRUE(r.periods.steady) << r.periods.verdict;
  const Claim* hangs = find(r.claims, Predicate::hangs_below_breakdown, "motor");
  ASSERT_TRUE(hangs);
  const double speed = test::figure(r, "final_speed.motor");
  EXPECT_GT(speed, 40);
  EXPECT_NEAR(*hangs->evidence.value, speed, 1e-3 * speed);
}

// 100 N·m at the sun are −300 at the ring: the brake takes 180 of them, a drag the rest at 20 rad/s. That is backwards
// where the motor, not its wheel, turns backwards.
TEST(BrakeBehindAReversingGear, SlipsTheWayThatTheLinkTurns) {
  for (const double torque : {100.0, -100.0}) {
    const Result r = test::run(fmt::format(R"(
      line = ["motor", "gear", "wheel"]
      motor = {{ kind = "torque source", torque = "{} N*m" }}
      gear = {{ kind = "planetary gear", sun = 20, ring = 60, in = "sun", out = "ring", fixed = "carrier" }}
      wheel = {{ kind = "load", inertia = "1 kg*m2", damping = "6 N*m*s/rad" }}
      brake = {{ kind = "brake", on = "wheel", torque = "180 N*m" }}
      run = {{ start = {{ speed = "{} rad/s" }}, until = "10 s" }}
    )",
                                           torque, torque));
    const Claim* slips = find(r.claims, Predicate::slips_to_the_end, "brake");
    ASSERT_TRUE(slips) << torque;
    EXPECT_NEAR(*slips->evidence.value, 20, 1e-6);
    EXPECT_EQ(has(slips->text, ", backwards,"), torque < 0) << slips->text;
  }
}

// A blow of 300 N·m on one of two wheels of 5 kg·m² that turn at 100 rad/s: the limiter passes 100 on, so that the slip
// grows by 40 − 20 rad/s² for 50 ms.
TEST(Slip, IsTheDifferenceOfBothSides) {
  const Result r = test::run(R"(
    line = ["wheel", "limiter", "mill"]
    wheel = { kind = "flywheel", inertia = "5 kg*m2" }
    limiter = { kind = "torque limiter", torque = "100 N*m" }
    mill = { kind = "flywheel", inertia = "5 kg*m2" }
    blow = { kind = "load", on = "mill", torque = "300 N*m", acts = "against motion", start = "1 s", stop = "1.05 s" }
    run = { start = { speed = "100 rad/s" }, until = "2 s" }
  )");
  const Claim* slips = find(r.claims, Predicate::limiter_slips, "limiter");
  ASSERT_TRUE(slips);
  EXPECT_NEAR(*slips->evidence.value, 1, 1e-6);
}

// Wheels of 1 kg·m² on a belt that passes on M: a blow of 200 N·m for 50 ms opens a slip at 200 − 2 M, which closes at 2 M.
// Each lasts 50 ms · 200/2M; between them they turn together.
TEST(Slip, OfSeveralSpellsIsReportedByTheirSum) {
  const double carried = 0.08 * eytelwein_force(500, 0.3, 160 * M_PI / 180);
  const Result r = test::run(R"(
    line = ["wheel", "belt", "mill"]
    wheel = { kind = "flywheel", inertia = "1 kg*m2" }
    belt = { kind = "belt", diameter_in = "160 mm", diameter_out = "160 mm", pretension = "500 N", friction_coefficient = 0.3, wrap_angle = "160 deg" }
    mill = { kind = "flywheel", inertia = "1 kg*m2" }
    one = { kind = "load", on = "mill", torque = "200 N*m", acts = "always", start = "0.5 s", stop = "0.55 s" }
    two = { kind = "load", on = "mill", torque = "200 N*m", acts = "always", start = "1.2 s", stop = "1.25 s" }
    run = { start = { speed = "50 rad/s" }, until = "2 s" }
  )");
  const Claim* slips = find(r.claims, Predicate::belt_slips, "belt");
  ASSERT_TRUE(slips);
  EXPECT_EQ(*slips->evidence.value, 2);
  EXPECT_TRUE(
      has(slips->text, fmt::format("slips twice, first at 0.5 s, for {:.4g} s in all", 2 * 0.05 * 100 / carried)))
      << slips->text;
}

// --- by the figures and events of a run ---

Result steady_run() {
  Result r = test::run(R"(
    line = ["motor", "crank", "coupling", "mill"]
    motor = { kind = "dc shunt motor", stall_torque = "200 N*m", no_load_speed = "50 rad/s", inertia = "1 kg*m2" }
    crank = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "0.5 kg*m2", slider_mass = "5 kg" }
    coupling = { kind = "coupling", stiffness = "9 kN*m/rad" }
    mill = { kind = "flywheel", inertia = "0.5 kg*m2" }
    run = { start = { speed = "50 rad/s" }, until = "3 s" }
  )",
                       false);
  EXPECT_TRUE(r.periods.steady) << r.periods.verdict;
  return r;
}

// δ = 2 (ω_max − ω_min)/(ω_max + ω_min) is 2 where the link stops: with 1.9 it turns on at a fortieth of its greatest speed.
TEST(Strokes, AreThoseOfALinkThatStopsInItsCycle) {
  Result r = steady_run();
  const auto fluctuates = [&](double delta, double error) {
    for (Figure& f : r.figures)
      if (f.what == quantities::delta && f.of == "crank") f.value = delta, f.error = error;
    const Claims claims = run_claims(r);
    EXPECT_NE(find(claims, Predicate::works_in_strokes) != nullptr, find(claims, Predicate::runs_steadily) != nullptr);
    return find(claims, Predicate::works_in_strokes) != nullptr;
  };
  ASSERT_TRUE(r.find(quantities::delta, "crank"));
  EXPECT_FALSE(fluctuates(1.2, 1e-6));
  EXPECT_FALSE(fluctuates(1.9, 1e-6));
  EXPECT_TRUE(fluctuates(1.9, 0.11)) << "it may stop";
  EXPECT_TRUE(fluctuates(2, 0));
}

// Rests between motions of one sense; a shaft that oscillates to and fro rests where it reverses.
TEST(Sticking, IsNotSaidOfAShaftThatOscillates) {
  Result r = steady_run();
  const auto sticks = [&](double first, double second) {
    r.events.clear();
    for (const auto& [t, sense] : {std::pair(0.1, first), std::pair(0.2, second), std::pair(0.3, first)}) {
      r.events.push_back({.t = t, .component = "mill", .what = "rests", .kind = EventKind::rest});
      r.events.push_back(
          {.t = t + 0.01, .component = "mill", .what = "moves", .kind = EventKind::motion, .value = sense});
    }
    return find(run_claims(r), Predicate::sticks_and_slips, "mill") != nullptr;
  };
  EXPECT_TRUE(sticks(1, 1));
  EXPECT_TRUE(sticks(-1, -1));
  EXPECT_FALSE(sticks(1, -1));
}

// The speed of the driven side oscillates by A/(J ω) (1 − cos ω t) above a lead of 2 rad/s: fastest in mid step, half a period after the start.
TEST(LargestSlip, LiesWithinASwing) {
  constexpr double pi = std::numbers::pi, lead = 2, swing = 6 / (0.5 * 2 * pi * 2);
  const Result r = test::run(R"(
    line = ["driver", "freewheel", "driven"]
    driver = { kind = "flywheel", inertia = "2 kg*m2" }
    freewheel = { kind = "one-way clutch" }
    driven = { kind = "flywheel", inertia = "0.5 kg*m2" }
    push = { kind = "torque source", on = "driven", amplitude = "6 N*m", frequency = "2 Hz" }
    run = { start = { driver = { speed = "10 rad/s" }, driven = { speed = "12 rad/s" } }, until = "0.41 s" }
  )");
  const Claim* claim = find(r.claims, Predicate::freewheel_overruns, "freewheel");
  ASSERT_TRUE(claim);
  EXPECT_NEAR(*claim->evidence.value, lead + 2 * swing, 1e-7);
  EXPECT_LE(std::abs(*claim->evidence.value - lead - 2 * swing), *claim->evidence.error);
}

TEST(LargestSlip, IsThatAtTheBeginOfAnEngagement) {
  const Result r = test::run(R"(
    line = ["wheel", "clutch", "mill"]
    wheel = { kind = "flywheel", inertia = "2 kg*m2" }
    clutch = { kind = "clutch", torque = "20 N*m" }
    mill = { kind = "flywheel", inertia = "1 kg*m2" }
    run = { start = { wheel = { speed = "100 rad/s" }, mill = { speed = "0 rad/s" } }, until = "5 s" }
  )");
  const Claim* claim = find(r.claims, Predicate::clutch_slips_engaging, "clutch");
  ASSERT_TRUE(claim);
  EXPECT_NEAR(*claim->evidence.value, 100, 1e-12);
}

// ω = ω₀ e^(−c t/J) passes 1e-3 of the usual speed in mid step.
TEST(LastTurning, IsLocatedOnTheSolution) {
  const auto model = compile(test::scene_from(R"(
    line = ["wheel"]
    wheel = { kind = "flywheel", inertia = "2 kg*m2" }
    drag = { kind = "load", on = "wheel", damping = "6 N*m*s/rad" }
    run = { start = { speed = "50 rad/s" } }
  )"),
                             {});
  Equations equations(model, false);
  LinkRecorder link(*model, 5);
  ASSERT_TRUE(integrate(equations, {.tolerance = 1e-10, .until = 5, .progress = {}}, {&link}).complete);
  EXPECT_NEAR(link.turned_at(), 2.0 / 6 * std::log(50 / (1e-3 * model->speed_scale)), 1e-8);
}

}  // namespace
}  // namespace kurbel::claims_by_hand_test
