// motion_claims_test.cpp — what falls, who holds, what stands behind springs, what slips meanwhile, what vibrates.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "studies/answers/run_claims.h"
#include "studies/limits/ratings.h"
#include "studies/run/run_findings.h"
#include "studies/steady/steady_words.h"
#include "studies/trials/trials_findings.h"
#include "tests/support/conclusions.h"
#include "tests/support/scenes.h"

namespace kurbel::motion_claims_test {
namespace {

constexpr double pi = std::numbers::pi;

using test::find;
using test::has;
using test::said;

// 40 N·m lift a weight of 20 N·m on 2 kg·m² for 1 s: 10 rad/s then, and −10 rad/s² from there on.
std::string hoist(const std::string& more) {
  return R"(
    line = ["motor", "drum"]
    motor = { kind = "torque source", torque = "40 N*m", inertia = "1 kg*m2", stop = "1 s" }
    drum = { kind = "load", torque = "20 N*m", acts = "always", inertia = "1 kg*m2" }
    run = { start = "rest", until = "5 s" }
  )" + more;
}

TEST(Falling, IsSaidOfAWeightThatNothingHolds) {
  const Result r = test::run(hoist(""));
  const Claim* falls = find(r.claims, Predicate::turns_back, "motor");
  ASSERT_TRUE(falls) << said(r);
  EXPECT_NEAR(*falls->evidence.value, -30, 1e-6);
  EXPECT_TRUE(said(r).starts_with(
      "\"motor\" turns backwards, at -286.5 rpm at the end: its loads drive it, and nothing holds them."))
      << said(r);
}

// Driven backwards for 1 s, to −20 rad/s, and slowed down by friction: nothing falls.
TEST(Falling, IsNotSaidOfWhatWasDrivenBackwards) {
  const Result r = test::run(R"(
    line = ["motor", "drum"]
    motor = { kind = "torque source", torque = "-42 N*m", inertia = "1 kg*m2", stop = "1 s" }
    drum = { kind = "load", torque = "2 N*m", acts = "against motion", inertia = "1 kg*m2" }
    run = { start = "rest", until = "5 s" }
  )");
  EXPECT_FALSE(find(r.claims, Predicate::turns_back)) << said(r);
  EXPECT_NEAR(test::figure(r, "final_speed.drum"), -16, 1e-6);
}

// Driven to −20 rad/s within 1 s, and slowed down by 1 rad/s² since, but for the last 0.1 s, when a load speeds it up by 2.
TEST(Falling, IsNotSaidOfWhatADriveLeftTurningFaster) {
  const Result r = test::run(R"(
    line = ["motor", "drum"]
    motor = { kind = "torque source", torque = "-42 N*m", inertia = "1 kg*m2", stop = "1 s" }
    drum = { kind = "load", torque = "2 N*m", acts = "against motion", inertia = "1 kg*m2" }
    push = { kind = "load", on = "drum", torque = "6 N*m", acts = "always", start = "4.9 s" }
    run = { start = "rest", until = "5 s" }
  )");
  EXPECT_FALSE(find(r.claims, Predicate::turns_back)) << said(r);
  EXPECT_NEAR(test::figure(r, "final_speed.drum"), -20 + 3.9 - 0.2, 1e-6);
}

// What oscillates through more than half a turn, driven or not, falls nowhere.
TEST(Falling, IsNotSaidOfWhatOscillates) {
  const Result r = test::run(R"(
    line = ["source", "wheel"]
    source = { kind = "torque source", torque = "0 N*m", amplitude = "100 N*m", frequency = "0.25 Hz", inertia = "1 kg*m2" }
    wheel = { kind = "load", damping = "0.1 N*m*s/rad", inertia = "1 kg*m2" }
    run = { start = "rest", until = "40 s" }
  )");
  EXPECT_FALSE(find(r.claims, Predicate::turns_back)) << said(r);
}

// It falls until the motor is on, is lifted for twice as long, and falls: from v = 10 t₀ to v − 10 (5 − 3 t₀). Sagging by
// less or more than half a turn, 10 t₀², makes no oscillation of it.
TEST(Falling, IsSaidOfAWeightThatSaggedAtFirst) {
  for (const double late : {0.5, 0.8}) {
    const Result r = test::run(fmt::format(R"(
      line = ["motor", "drum"]
      motor = {{ kind = "torque source", torque = "40 N*m", inertia = "1 kg*m2", start = "{} s", stop = "{} s" }}
      drum = {{ kind = "load", torque = "20 N*m", acts = "always", inertia = "1 kg*m2" }}
      run = {{ start = "rest", until = "5 s" }}
    )",
                                           late, 3 * late));
    const Claim* falls = find(r.claims, Predicate::turns_back, "motor");
    ASSERT_TRUE(falls) << late << ' ' << said(r);
    EXPECT_NEAR(*falls->evidence.value, 10 * late - 10 * (5 - 3 * late), 1e-6);
  }
}

// It falls from 2 s on, is pushed forwards from −10 rad/s by 40 N·m more than it weighs for 0.55 s, to 1 rad/s, and falls on:
// what it regains, 0.1 of 7.5 rad, makes no oscillation of it.
TEST(Falling, IsSaidOfAWeightThatIsPushedUpForAMoment) {
  const Result r = test::run(R"(
    line = ["motor", "drum"]
    motor = { kind = "torque source", torque = "40 N*m", inertia = "1 kg*m2", stop = "1 s" }
    drum = { kind = "load", torque = "20 N*m", acts = "always", inertia = "1 kg*m2" }
    push = { kind = "load", on = "drum", torque = "-60 N*m", acts = "always", start = "3 s", stop = "3.55 s" }
    run = { start = "rest", until = "6 s" }
  )");
  const Claim* falls = find(r.claims, Predicate::turns_back, "motor");
  ASSERT_TRUE(falls) << said(r);
  EXPECT_NEAR(*falls->evidence.value, 1 - 10 * 2.45, 1e-6);
}

// It falls by 6.4 rad until the motor stops it, is lifted again by half of that and switched off, while it rises; the edges of
// "tick" end steps while it does. What it came forwards before and after the switch makes no oscillation of it.
TEST(Falling, IsSaidOfAWeightThatStillRisesWhenItsDriveIsSwitchedOff) {
  const Result r = test::run(R"(
    line = ["motor", "drum"]
    motor = { kind = "torque source", torque = "40 N*m", inertia = "1 kg*m2", start = "0.8 s", stop = "2.4 s" }
    drum = { kind = "load", torque = "20 N*m", acts = "always", inertia = "1 kg*m2" }
    tick = { kind = "load", on = "drum", torque = "1e-6 N*m", start = "2.5 s", stop = "2.6 s" }
    run = { start = "rest", until = "6 s" }
  )");
  const Claim* falls = find(r.claims, Predicate::turns_back, "motor");
  ASSERT_TRUE(falls) << said(r);
  EXPECT_NEAR(*falls->evidence.value, 8 - 10 * 3.6, 1e-5);
}

// It falls by 5 rad until the motor is on, and is stopped by it within another second.
TEST(Falling, IsNotSaidOfWhatIsBeingStopped) {
  const Result r = test::run(R"(
    line = ["motor", "drum"]
    motor = { kind = "torque source", torque = "40 N*m", inertia = "1 kg*m2", start = "1 s" }
    drum = { kind = "load", torque = "20 N*m", acts = "always", inertia = "1 kg*m2" }
    run = { start = "rest", until = "1.9 s" }
  )");
  EXPECT_FALSE(find(r.claims, Predicate::turns_back)) << said(r);
  EXPECT_NEAR(test::figure(r, "final_speed.drum"), -1, 1e-6);
}

// A press that its work turns back through a slipping clutch slows down within each cycle, and goes on backwards.
TEST(Falling, IsSaidOfWhatSlowsDownWithinItsCycle) {
  const Result r = test::run(R"(
    line = ["motor", "joint", "press"]
    motor = { kind = "dc shunt motor", stall_torque = "1606.1 N*m", no_load_speed = "140.76 rad/s", inertia = "3.6774 kg*m2" }
    joint = { kind = "clutch", torque = "160.03 N*m", static_torque = "164.79 N*m" }
    press = { kind = "slider-crank", radius = "56.514 mm", rod = "183.8 mm", crank_inertia = "0.57808 kg*m2", slider_mass = "26.36 kg", load = { kind = "table", force = { over = "angle", unit = ["deg", "N"], period = "360 deg", points = [[0, 0], [180, 0], [200, 11295], [330, 11295], [360, 0]] } } }
    run = { start = { speed = "95.516 rad/s" }, until = "2.13398 s" }
  )");
  const Claim* falls = find(r.claims, Predicate::turns_back, "press");
  ASSERT_TRUE(falls) << said(r);
  EXPECT_LT(*falls->evidence.value, -50);
}

// It rises until 2 s: at 2.3 s it is 0.45 rad below and at −3 rad/s, and the conclusion says so.
TEST(Falling, IsToldByTheSpeedAtTheEndBeforeItIsFar) {
  Result r = test::run(hoist("").replace(hoist("").find("5 s"), 3, "2.3 s"));
  EXPECT_FALSE(find(r.claims, Predicate::turns_back)) << said(r);
  EXPECT_TRUE(has(said(r), "; it turns backwards at the end, at -28.65 rpm")) << said(r);
}

// 60 N·m on 2 kg·m² turn it at −30 rad/s² from 5 rad/s to −7 rad/s, faster than the motor's 6 rad/s, within 0.4 rad.
TEST(Falling, IsSaidOfWhatIsFasterBackwardsThanItsUsualSpeed) {
  const Result r = test::run(R"(
    line = ["motor", "drum"]
    motor = { kind = "motor", torque = { over = "speed", unit = ["rad/s", "N*m"], points = [[0, 360], [5, 60], [6, 0]] }, inertia = "1 kg*m2", stop = "2 s" }
    drum = { kind = "load", torque = "60 N*m", acts = "always", inertia = "1 kg*m2" }
    run = { start = "rest", until = "2.4 s" }
  )");
  const Claim* falls = find(r.claims, Predicate::turns_back, "motor");
  ASSERT_TRUE(falls) << said(r);
  EXPECT_NEAR(*falls->evidence.value, 5 - 30 * 0.4, 1e-4);
}

// Lowered by 6 N·m against a motor that brakes by 5 N·m·s/rad beyond 10 rad/s, and let go at 4 s: 3 rad/s² from there on.
TEST(RunningAway, IsSaidOfAWeightThatIsLoweredAndLetGo) {
  const auto lowered = [](const char* until) {
    return test::run(fmt::format(R"(
      line = ["motor", "drum"]
      motor = {{ kind = "dc shunt motor", stall_torque = "50 N*m", no_load_speed = "10 rad/s", inertia = "1 kg*m2", stop = "4 s" }}
      drum = {{ kind = "load", torque = "-6 N*m", acts = "always", inertia = "1 kg*m2" }}
      run = {{ until = "{}" }}
    )",
                                 until));
  };
  const Result off = lowered("5 s"), far = lowered("10 s");
  EXPECT_FALSE(find(off.claims, Predicate::runs_away)) << said(off);
  EXPECT_TRUE(has(said(off), "; its loads drove it on, to ")) << said(off);
  const Claim* away = find(far.claims, Predicate::runs_away, "motor");
  ASSERT_TRUE(away) << said(far);
  EXPECT_NEAR(*away->evidence.value, 10 * 56 / 50.0 * (1 - std::exp(-2.5 * 4)) + 3 * 6, 1e-5);
  EXPECT_TRUE(has(away->text, "its loads drive it, and nothing holds them")) << away->text;
}

// The brake's 100 N·m and the weight's 20 N·m stop 2 kg·m² from 10 rad/s within 1/6 s.
TEST(Holding, IsSaidOfWhatCameToRest) {
  const Result r =
      test::run(hoist("brake = { kind = \"brake\", on = \"drum\", torque = \"100 N*m\", start = \"1 s\" }"));
  const Claim* held = find(r.claims, Predicate::held_by, "motor");
  ASSERT_TRUE(held) << said(r);
  EXPECT_NEAR(*held->evidence.value, 20, 1e-9);
  EXPECT_NEAR(*held->evidence.at, 1 + 1.0 / 6, 1e-6);
  EXPECT_TRUE(has(said(r), ", held by \"brake\" against the 20 N·m that act on it")) << said(r);
  EXPECT_FALSE(find(r.claims, Predicate::stalls));
}

// 100 N·m drive, the brake takes 60 N·m of them from the start on, 2 N·m·s/rad the rest: 20 rad/s.
TEST(Brakes, ThatAreOnFromTheStartAndSlipAreSaid) {
  const Result r = test::run(R"(
    line = ["motor", "wheel"]
    motor = { kind = "torque source", torque = "100 N*m" }
    wheel = { kind = "load", inertia = "1 kg*m2", damping = "2 N*m*s/rad" }
    brake = { kind = "brake", on = "wheel", torque = "60 N*m" }
    run = { start = { speed = "50 rad/s" }, until = "10 s" }
  )");
  const Claim* slips = find(r.claims, Predicate::slips_to_the_end, "brake");
  ASSERT_TRUE(slips) << said(r);
  EXPECT_NEAR(*slips->evidence.value, 20, 1e-3);
  EXPECT_TRUE(has(said(r), "\"brake\" is on and slips to the end, at 20 rad/s under its 60 N·m")) << said(r);
}

// Put on at 1 s by its window of time: the same as by command.
TEST(Brakes, ThatComeOnInTimeAndAreTooWeakAreSaid) {
  const Result r = test::run(R"(
    line = ["motor", "wheel"]
    motor = { kind = "torque source", torque = "100 N*m" }
    wheel = { kind = "load", inertia = "1 kg*m2", damping = "2 N*m*s/rad" }
    brake = { kind = "brake", on = "wheel", torque = "60 N*m", start = "1 s" }
    run = { start = { speed = "50 rad/s" }, until = "10 s" }
  )");
  EXPECT_TRUE(said(r).starts_with("\"brake\" does not stop it: it slips at 20 rad/s after 9 s")) << said(r);
}

// The brake's 60 N·m stop a crank of 0.5 rad/s within its first cycle against the motor's 50: on from the start it is in the
// way, put on at 1 ms it is meant to stop it.
TEST(Brakes, ThatAreOnFromTheStartLetItNotCompleteACycle) {
  const auto crank = [](const std::string& brake) {
    return test::run(R"(
      line = ["motor", "crank"]
      motor = { kind = "torque source", torque = "50 N*m", inertia = "1 kg*m2" }
      crank = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "1 kg*m2", slider_mass = "1 g" }
      brake = { kind = "brake", on = "motor", torque = "60 N*m")" +
                     brake + R"( }
      run = { start = { speed = "0.5 rad/s" }, until = "3 s" }
    )");
  };
  const Result r = crank("");
  const Claim* halts = find(r.claims, Predicate::does_not_get_round);
  ASSERT_TRUE(halts) << said(r);
  EXPECT_NEAR(*halts->evidence.value, 50, 1e-9);
  EXPECT_TRUE(has(said(r), "where 50 N·m drive it and \"brake\" holds it")) << said(r);
  EXPECT_FALSE(find(crank(", start = \"1 ms\"").claims, Predicate::does_not_get_round));
}

// 100 N·m·(1 − ω/100) on 1 kg·m²: 1 s is no steady motion, 20 s are one, at the load's 60 N·m.
TEST(Motors, WithoutADutyAreNotAssessedBeforeTheMotionIsSteady) {
  const auto claim = [](const char* until, Predicate what) {
    const Claims claims = run_claims(test::run(fmt::format(R"(
      line = ["motor", "load"]
      motor = {{ kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "100 rad/s", rated_torque = "40 N*m", inertia = "0.5 kg*m2" }}
      load = {{ kind = "load", torque = "60 N*m", inertia = "0.5 kg*m2" }}
      run = {{ until = "{}" }}
    )",
                                                           until)));
    const Claim* found = find(claims, what, "motor");
    return found ? std::optional(*found) : std::nullopt;
  };
  const auto open = claim("1 s", Predicate::not_assessed);
  ASSERT_TRUE(open);
  EXPECT_FALSE(open->in_conclusion);
  EXPECT_EQ(*open->evidence.limit, 40);
  EXPECT_FALSE(claim("20 s", Predicate::not_assessed));
  const auto hot = claim("20 s", Predicate::motor_overloaded);
  ASSERT_TRUE(hot);
  EXPECT_NEAR(*hot->evidence.value, 1.5, 1e-6);
}

// A crank whose speed rises and falls in every cycle runs on with its brake on: it slows down within the cycle alone.
TEST(Brakes, AreTooWeakForWhatRunsSteadilyWithThem) {
  const Result r = test::run(R"(
    line = ["motor", "crank"]
    motor = { kind = "dc shunt motor", stall_torque = "200 N*m", no_load_speed = "100 rad/s", inertia = "0.1 kg*m2" }
    crank = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "0.05 kg*m2", slider_mass = "20 kg" }
    brake = { kind = "brake", on = "motor", torque = "10 N*m", start = "1 s" }
    run = { start = { speed = "90 rad/s" }, until = "4.02 s" }
  )",
                             false);
  ASSERT_TRUE(r.periods.steady);
  EXPECT_TRUE(find(r.claims, Predicate::brake_does_not_stop, "brake")) << said(r);
  EXPECT_FALSE(find(r.claims, Predicate::brake_has_not_stopped, "brake")) << said(r);
}

// 50 N·m wind a spring up against a bearing that holds 80 N·m: the motor's own shaft is held by nothing, and stands.
TEST(Stalls, AreSaidOfAMotorThatStandsBehindASpring) {
  const Result r = test::run(R"(
    line = ["motor", "coupling", "mill"]
    motor = { kind = "dc shunt motor", stall_torque = "50 N*m", no_load_speed = "100 rad/s", inertia = "0.2 kg*m2" }
    coupling = { kind = "coupling", stiffness = "2 kN*m/rad", damping_ratio = 0.2 }
    mill = { kind = "load", torque = "80 N*m", inertia = "1 kg*m2" }
    effects = { elasticity = true }
    run = { start = { speed = "20 rad/s" }, until = "6 s" }
  )");
  const Claim* stalls = find(r.claims, Predicate::stalls, "motor");
  ASSERT_TRUE(stalls) << said(r);
  EXPECT_NEAR(*stalls->evidence.value, 50, 1e-3);
  EXPECT_LT(*stalls->evidence.at, 3);
}

// The same behind a shaft that is hardly damped: at 3.51 s it still turns at 1e-3 of its usual speed, between the ends of
// steps; at 5 s it stands.
TEST(Stalls, AreNotSaidWhileItTrembles) {
  const auto machine = [](const char* until) {
    return test::run(fmt::format(R"(
      line = ["motor", "shaft", "machine"]
      motor = {{ kind = "dc shunt motor", stall_torque = "401.38 N*m", no_load_speed = "22.166 rad/s", inertia = "1.3856 kg*m2" }}
      shaft = {{ kind = "shaft", stiffness = "15232 N*m/rad", damping_ratio = 0.017 }}
      effects = {{ elasticity = true }}
      run = {{ until = "{}" }}
      [machine]
      kind = "slider-crank"
      radius = "83.172 mm"
      rod = "216.74 mm"
      crank_inertia = "3.233 kg*m2"
      slider_mass = "64.472 kg"
      load = {{ kind = "table", force = {{ over = "angle", unit = ["deg", "N"], period = "360 deg", points = [[0, 0], [180, 0], [200, 24257], [330, 24257], [360, 0]] }} }}
    )",
                                 until));
  };
  const Result trembles = machine("3.55768 s"), stands = machine("5 s");
  EXPECT_FALSE(find(trembles.claims, Predicate::stalls)) << said(trembles);
  EXPECT_TRUE(find(trembles.claims, Predicate::does_not_get_round)) << said(trembles);
  EXPECT_TRUE(find(stands.claims, Predicate::stalls)) << said(stands);
}

// 20 N·m on a spring of 1 MN·m/rad: at most 20/√(0.2·10⁶) = 0.045 rad/s, below 1e-3 of the usual speed, until the bearing on
// its own shaft holds it. By command at 1 s or from the start, it never turned.
TEST(Stalls, AreNotSaidOfWhatNeverTurned) {
  for (const char* sequence : {"",
                               "sequence = { steps = [{ at = \"0 s\", set = \"motor\", to = 0 }, { at = \"1 s\", set = "
                               "\"motor\", to = 1 }] }"}) {
    const Result r = test::run(std::string(R"(
      line = ["motor", "shaft", "mill"]
      motor = { kind = "dc shunt motor", stall_torque = "20 N*m", no_load_speed = "100 rad/s", inertia = "0.2 kg*m2" }
      shaft = { kind = "shaft", stiffness = "1 MN*m/rad", damping_ratio = 0.05 }
      mill = { kind = "load", torque = "80 N*m", inertia = "1 kg*m2" }
      drag = { kind = "bearing", on = "motor", torque = "3 N*m" }
      effects = { elasticity = true }
      run = { start = "rest", until = "3 s" }
    )") + sequence);
    EXPECT_FALSE(find(r.claims, Predicate::stalls)) << said(r);
    EXPECT_TRUE(said(r).starts_with("\"motor\" does not start: its loads hold the 20 N·m that drive it")) << said(r);
  }
}

// A motor that has run 1 kg·m² up to 1e-4 of its speed, one commanded to start 1 ms before the end, and one that
// starts anew then: no load holds them.
TEST(Stalls, AreNotSaidOfWhatHasJustBegun) {
  const char* const late =
      R"(sequence = { steps = [{ at = "0 s", set = "motor", to = 0 }, { at = "0.999 s", set = "motor", to = 1 }] })";
  for (const auto& [run, sequence] : std::array<std::pair<const char*, const char*>, 3>{
           {{R"(start = "rest", until = "0.7 ms")", ""},
            {R"(start = "rest", until = "1 s")", late},
            {R"(start = { speed = "2 rad/s" }, until = "1 s")", late}}}) {
    const Result r = test::run(fmt::format(R"(
      line = ["motor", "mill"]
      motor = {{ kind = "dc shunt motor", stall_torque = "20 N*m", no_load_speed = "100 rad/s", inertia = "0.2 kg*m2" }}
      mill = {{ kind = "load", torque = "5 N*m", inertia = "0.8 kg*m2" }}
      run = {{ {} }}
      {}
    )",
                                           run, sequence));
    EXPECT_FALSE(find(r.claims, Predicate::does_not_start)) << said(r);
    EXPECT_FALSE(find(r.claims, Predicate::stalls)) << said(r);
  }
}

// 1 mN·m of 20 N·m is left: it gains 0.003 rad/s in 3 s, and the load holds it, as people say.
TEST(Stalls, AreSaidOfWhatHardlyBegins) {
  const Result r = test::run(R"(
    line = ["motor", "mill"]
    motor = { kind = "dc shunt motor", stall_torque = "20 N*m", no_load_speed = "100 rad/s", inertia = "0.2 kg*m2" }
    mill = { kind = "load", torque = "19.999 N*m", inertia = "0.8 kg*m2" }
    run = { start = "rest", until = "3 s" }
  )");
  EXPECT_TRUE(find(r.claims, Predicate::does_not_start, "motor")) << said(r);
}

// J φ″ + 2 N·m·s/rad φ′ + 20 N·m/rad (φ − 1) = 20 N·m: nothing holds it at 2 rad.
TEST(Stalls, AreSaidOfABalance) {
  const Result r = test::run(R"(
    line = ["motor", "arm"]
    motor = { kind = "dc shunt motor", stall_torque = "20 N*m", no_load_speed = "10 rad/s", inertia = "0.01 kg*m2" }
    arm = { kind = "load", table = { over = "angle", formula = "20 [N*m/rad]*phi - 20 [N*m]" } }
    run = { start = { angle = "1 rad" }, until = "4 s" }
  )");
  ASSERT_TRUE(find(r.claims, Predicate::stalls, "motor")) << said(r);
  EXPECT_TRUE(has(said(r), "\"motor\" stalls at 114.6° after ")) << said(r);
  EXPECT_TRUE(has(said(r), ": its loads balance the 20 N·m that drive there")) << said(r);
}

// What stands beyond an open clutch holds nothing.
TEST(Stalls, AreNotLaidToWhatAnOpenClutchParts) {
  const Result r = test::run(R"(
    line = ["motor", "clutch", "table"]
    motor = { kind = "dc shunt motor", stall_torque = "50 N*m", no_load_speed = "100 rad/s", inertia = "0.2 kg*m2" }
    drag = { kind = "bearing", on = "motor", torque = "60 N*m" }
    clutch = { kind = "clutch", torque = "100 N*m" }
    table = { kind = "load", torque = "20 N*m", inertia = "1 kg*m2" }
    slide = { kind = "bearing", on = "table", torque = "3 N*m" }
    sequence = { steps = [{ at = "0 s", set = "clutch", to = 0 }] }
    run = { start = { motor = { speed = "20 rad/s" } }, until = "3 s" }
  )");
  ASSERT_TRUE(find(r.claims, Predicate::stalls, "motor")) << said(r);
  EXPECT_TRUE(has(said(r), ": \"drag\" can hold the 50 N·m that drive there")) << said(r);
}

// A motor of 30 N·m before a crank that weighs 78 N·m rocks it to and fro: so it is said whenever the run ends. What a law over
// time shakes is not expected to complete a turn.
TEST(Cycles, ThatACrankRocksInsteadOfAreMissedAtEveryPhase) {
  const auto crank = [](const char* motor, double until) {
    return test::run(fmt::format(R"(
      line = ["motor", "crank"]
      motor = {{ {}, inertia = "0.2 kg*m2" }}
      crank = {{ kind = "slider-crank", radius = "0.1 m", rod = "0.4 m", crank_inertia = "1.5 kg*m2", crank_mass = "80 kg", crank_com = "0.1 m", slider_mass = "20 kg", gravity = "9.81 m/s2" }}
      run = {{ start = {{ angle = "-90 deg" }}, until = "{} s" }}
    )",
                                 motor, until));
  };
  for (const double until : {2.4, 2.55, 2.7, 2.85, 3.0}) {
    const Result r = crank(R"(kind = "dc shunt motor", stall_torque = "30 N*m", no_load_speed = "50 rad/s")", until);
    ASSERT_TRUE(find(r.claims, Predicate::does_not_get_round, "crank")) << until << ' ' << said(r);
    EXPECT_TRUE(has(said(r), "does not complete a cycle: it turns to and fro, between -")) << said(r);
  }
  for (const double until : {6.0, 6.1, 6.2, 6.3}) {
    const Result r =
        crank(R"(kind = "torque source", torque = "0 N*m", amplitude = "20 N*m", frequency = "1.7 Hz")", until);
    EXPECT_FALSE(find(r.claims, Predicate::does_not_get_round)) << until << ' ' << said(r);
  }
}

// A press that jams in its work while the sequence waits for an angle beyond it does not go through its sequence, also
// while the shafts behind it still vibrate.
TEST(Stalls, AreSaidOfAPressThatJamsBeforeTheAngleThatItsSequenceWaitsFor) {
  const auto press = [](const char* force) {
    return test::run(fmt::format(R"(
      line = ["motor", "clutch", "shaft", "press"]
      motor = {{ kind = "dc shunt motor", stall_torque = "200 N*m", no_load_speed = "14 rad/s", inertia = "10 kg*m2" }}
      clutch = {{ kind = "clutch", torque = "12 kN*m", static_torque = "14 kN*m", inertia_out = "1.5 kg*m2" }}
      shaft = {{ kind = "shaft", stiffness = "3 MN*m/rad", damping = "1 N*m*s/rad" }}
      press = {{ kind = "slider-crank", radius = "40 mm", rod = "400 mm", crank_inertia = "2 kg*m2", slider_mass = "250 kg", load = {{ kind = "press", nominal_force = "{}", nominal_travel = "5 mm" }} }}
      effects = {{ elasticity = true }}
      sequence = {{ steps = [{{ at = "0 s", set = "clutch", to = 0 }}, {{ at = "0.1 s", set = "clutch", to = 1 }}, {{ angle = "150 deg", of = "press", set = "clutch", to = 0 }}] }}
      run = {{ start = {{ angle = "180 deg", motor = {{ speed = "13 rad/s" }}, press = {{ speed = "0 rad/s" }} }}, until = "2 s", accuracy = 1e-4 }}
    )",
                                 force));
  };
  const Result jams = press("4 MN"), passes = press("40 kN");
  EXPECT_TRUE(find(jams.claims, Predicate::stalls, "press")) << said(jams);
  EXPECT_FALSE(has(said(jams), "goes through")) << said(jams);
  EXPECT_FALSE(find(passes.claims, Predicate::stalls)) << said(passes);
}

// What a clutch did on the way is said of a machine that stalls, too.
TEST(Stalls, HideNoClutch) {
  const Result r = test::run(R"(
    line = ["motor", "clutch", "press"]
    motor = { kind = "dc shunt motor", stall_torque = "90 N*m", no_load_speed = "100 rad/s", inertia = "5 kg*m2" }
    clutch = { kind = "clutch", torque = "100 N*m", static_torque = "120 N*m" }
    press = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "5 kg*m2", slider_mass = "1 g" }
    jam = { kind = "load", on = "press", torque = "300 N*m", acts = "against motion", start = "1 s" }
    sequence = { steps = [{ at = "0 s", set = "clutch", to = 0 }, { at = "0.5 s", set = "clutch", to = 1, over = "0.1 s" }] }
    run = { start = { speed = "95 rad/s" }, until = "20 s" }
  )");
  ASSERT_TRUE(find(r.claims, Predicate::stalls, "press")) << said(r);
  EXPECT_TRUE(find(r.claims, Predicate::clutch_opened_by_command, "clutch")) << said(r);
  const Claim* slips = find(r.claims, Predicate::clutch_slips_closed, "clutch");
  ASSERT_TRUE(slips) << said(r);
  EXPECT_NEAR(*slips->evidence.at, 1, 1e-9);
}

// J φ″ + 2 N·m·s/rad φ′ + c (φ − 1) = 20 N·m: it creeps, or vibrates, to where the load balances the motor. At 0.3 s it
// still creeps at 5 % of the no-load speed, and nothing holds it.
TEST(Holding, IsSaidOfAMotorThatItsLoadBalances) {
  const auto balanced = [](double inertia, double stiffness, double until) {
    return test::run(fmt::format(R"(
      line = ["motor", "arm"]
      motor = {{ kind = "dc shunt motor", stall_torque = "20 N*m", no_load_speed = "10 rad/s", rated_torque = "8 N*m", inertia = "{0} kg*m2" }}
      arm = {{ kind = "load", table = {{ over = "angle", formula = "{1} [N*m/rad]*phi - {1} [N*m]" }} }}
      sequence = {{ steps = [{{ at = "0 s", set = "motor", to = 1 }}] }}
      run = {{ start = {{ angle = "1 rad" }}, until = "{2} s" }}
    )",
                                 inertia, stiffness, until));
  };
  const Result creeps = balanced(0.01, 20, 0.55), vibrates = balanced(1, 400, 4.2);
  const double root = std::sqrt(4 - 4 * 0.01 * 20), slow = (-2 + root) / 0.02, fast = (-2 - root) / 0.02;
  const double w = std::sqrt(400 - 1);
  const std::array<std::pair<const Result*, double>, 2> expected{
      {{&creeps, 20 / root * (std::exp(slow * 0.55) - std::exp(fast * 0.55))},
       {&vibrates, 20 / w * std::exp(-4.2) * std::sin(w * 4.2)}}};
  for (const auto& [r, speed] : expected) {
    const Claim* held = find(r->claims, Predicate::held_by, "motor");
    ASSERT_TRUE(held) << said(*r);
    EXPECT_NEAR(*held->evidence.value, 20 - 2 * speed, 1e-5);
    EXPECT_TRUE(has(said(*r), "held by its loads against the ")) << said(*r);
  }
  EXPECT_FALSE(find(balanced(0.01, 20, 0.3).claims, Predicate::held_by));
}

// 2 N·m on a spring of 4 N·m/rad before a load that holds 10: ± 0.5 rad at 76 1/s at first, and the motor turns no mill.
TEST(Holding, IsSaidOfAMotorThatVibratesBeforeALoadThatStands) {
  const auto vibrating = [](double until) {
    return test::run(fmt::format(R"(
      line = ["motor", "coupling", "mill"]
      motor = {{ kind = "dc shunt motor", stall_torque = "2 N*m", no_load_speed = "1000 rad/s", rated_torque = "2 N*m", inertia = "7 kg*cm2" }}
      coupling = {{ kind = "coupling", stiffness = "4 N*m/rad", damping_ratio = 0.01 }}
      mill = {{ kind = "load", torque = "10 N*m", inertia = "200 kg*cm2" }}
      effects = {{ elasticity = true }}
      run = {{ until = "{} s" }}
    )",
                                 until));
  };
  for (const double until : {0.3, 0.36, 0.39}) {
    const Result r = vibrating(until);
    EXPECT_TRUE(find(r.claims, Predicate::vibrates, "motor")) << said(r);
    EXPECT_TRUE(has(said(r), "\"motor\" is held by \"mill\" against the ")) << said(r);
  }
  // Slow for a moment, with fewer than two reversals in the last quarter.
  const Result passes = vibrating(0.33);
  EXPECT_FALSE(has(said(passes), "rest")) << said(passes);
}

// Both brakes stop their sides of the open clutch: the weight's 60 N·m act on the drum alone.
TEST(Holding, OfALinkCountsNoTorqueBeyondAnOpenClutch) {
  const Result r = test::run(R"(
    line = ["motor", "clutch", "drum"]
    motor = { kind = "dc shunt motor", stall_torque = "200 N*m", no_load_speed = "50 rad/s", inertia = "1 kg*m2" }
    motor_brake = { kind = "brake", on = "motor", torque = "30 N*m", start = "2 s" }
    clutch = { kind = "clutch", torque = "150 N*m" }
    drum = { kind = "load", torque = "60 N*m", acts = "always", inertia = "2 kg*m2" }
    drum_brake = { kind = "brake", on = "drum", torque = "100 N*m", start = "2 s" }
    sequence = { steps = [{ at = "2 s", set = ["motor", "clutch"], to = 0 }] }
    run = { until = "6 s" }
  )");
  EXPECT_TRUE(find(r.claims, Predicate::held_by, "motor")) << said(r);
  EXPECT_TRUE(said(r).starts_with("\"motor\" goes through its operating sequence and ends at rest. ")) << said(r);
}

// The brake of 60 N·m stops a motor that stays on; what still trembles behind the coupling runs up to nothing.
TEST(Holding, IsSaidOfAMotorThatStaysOnAgainstABrake) {
  const Result r = test::run(R"(
    line = ["motor", "coupling", "drum"]
    motor = { kind = "dc shunt motor", stall_torque = "20 N*m", no_load_speed = "100 rad/s", inertia = "0.05 kg*m2" }
    coupling = { kind = "coupling", stiffness = "500 N*m/rad", damping_ratio = 0.02 }
    drum = { kind = "load", damping = "0.05 N*m*s/rad", inertia = "0.3 kg*m2" }
    brake = { kind = "brake", on = "drum", torque = "60 N*m", start = "3 s" }
    effects = { elasticity = true }
    run = { until = "6 s" }
  )");
  EXPECT_TRUE(has(said(r), "rest")) << said(r);
  EXPECT_TRUE(has(said(r), ", held by \"brake\" against the 20 N·m that act on it")) << said(r);
}

// The motor's bearing stops it within 4 s; the mill goes on, from 29 rad/s by 0.2 rad/s² less.
TEST(Freewheels, SayThatTheirDrivenSideRunsOn) {
  const Result r = test::run(R"(
    line = ["motor", "freewheel", "mill"]
    motor = { kind = "dc shunt motor", stall_torque = "80 N*m", no_load_speed = "30 rad/s", inertia = "0.5 kg*m2", stop = "12 s" }
    freewheel = { kind = "one-way clutch" }
    mill = { kind = "load", torque = "1 N*m", inertia = "5 kg*m2" }
    drag = { kind = "bearing", on = "motor", torque = "4 N*m" }
    run = { until = "17 s" }
  )");
  EXPECT_TRUE(has(said(r), "\"freewheel\" lets its driven side run ahead, first at ")) << said(r);
  EXPECT_TRUE(has(said(r), "s, by 27.")) << said(r);
}

// Two masses of 1 kg·m² on 100 N·m/rad: f = √200/2π, each to and fro by half the spring's 0.05 rad.
// The last quarter of 2.654 s is 1.49 periods long, from one end of the swing to the other.
TEST(Vibration, HasItsFrequencyAndItsPlaces) {
  for (const char* until : {"4 s", "2.654 s"}) {
    const Result r = test::run(fmt::format(R"(
      line = ["left", "spring", "right"]
      left = {{ kind = "inertia", inertia = "1 kg*m2" }}
      right = {{ kind = "inertia", inertia = "1 kg*m2" }}
      spring = {{ kind = "coupling", stiffness = "100 N*m/rad" }}
      effects = {{ elasticity = true }}
      run = {{ start = {{ spring = {{ twist = "0.05 rad" }} }}, until = "{}" }}
    )",
                                           until));
    const Claim* vibrates = find(r.claims, Predicate::vibrates, "left");
    ASSERT_TRUE(vibrates) << said(r);
    EXPECT_NEAR(*vibrates->evidence.value, std::sqrt(200) / (2 * pi), 1e-6);
    EXPECT_TRUE(has(said(r), "\"left\" vibrates to the end, between ")) << said(r);
  }
}

// The same masses with damping c: the twist decays as e^(−δt), δ = c (1/J + 1/J)/2, at ω_d = √(ω² − δ²). The angle of "left"
// turns back at the extremes of the twist, π/ω_d apart.
TEST(Vibration, ThatDecaysIsSaidWithItsAmplitudes) {
  const Result r = test::run(R"(
    line = ["left", "spring", "right"]
    left = { kind = "inertia", inertia = "1 kg*m2" }
    right = { kind = "inertia", inertia = "1 kg*m2" }
    spring = { kind = "coupling", stiffness = "100 N*m/rad", damping = "0.5 N*m*s/rad" }
    effects = { elasticity = true }
    run = { start = { spring = { twist = "0.05 rad" } }, until = "4 s", accuracy = 1e-9 }
  )");
  const Claim* vibrates = find(r.claims, Predicate::vibrates, "left");
  ASSERT_TRUE(vibrates) << said(r);
  const double decay = 0.5, w = std::sqrt(200 - decay * decay), half = pi / w;
  EXPECT_NEAR(*vibrates->evidence.value, 0.5 / half, 1e-6);
  // Reversals at k·half, k ≥ 1; those from 3 s on count once the speed has changed its sense within the last quarter.
  const auto amplitude = [&](double k) {  // of the half oscillation from k to k + 1 [°]
    return 0.5 * 0.025 * std::exp(-decay * k * half) * (1 + std::exp(-decay * half)) * 180 / pi;
  };
  const double first = std::ceil(3 / half), last = std::floor(4 / half) - 1;
  EXPECT_TRUE(
      has(vibrates->text, fmt::format("decays: its amplitude falls from {:.3g}° to {:.3g}° in the last {:.3g} s",
                                      amplitude(first), amplitude(last), (last + 1 - first) * half)))
      << vibrates->text;
}

// A ripple of 5 Hz, ± 31.4/(2π 5)² rad, on an oscillation of 1 rad/s and ± 0.5 rad: its reversals are the ripple's,
// and say nothing about the oscillation's amplitude.
TEST(Vibration, OfTwoFrequenciesNeitherGrowsNorDecays) {
  const Result r = test::run(R"(
    line = ["source", "arm"]
    source = { kind = "torque source", torque = "0 N*m", amplitude = "31.4 N*m", frequency = "5 Hz", inertia = "0.5 kg*m2" }
    arm = { kind = "load", inertia = "0.5 kg*m2", table = { over = "angle", formula = "1 [N*m/rad]*phi - 3 [N*m]" } }
    run = { start = { angle = "3.5 rad" }, until = "20 s" }
  )");
  const Claim* vibrates = find(r.claims, Predicate::vibrates, "source");
  ASSERT_TRUE(vibrates) << said(r);
  EXPECT_TRUE(has(vibrates->text, "to the end, between ")) << vibrates->text;
}

// A screw's force comes from its energy: the conclusion has it.
TEST(Screw, ConclusionHasTheForceOfTheStroke) {
  const Result r = test::run(test::scene_file("scenes/screw_press.toml"), false);
  EXPECT_TRUE(has(said(r), "the force on \"screw\" reaches 285.3 kN at 0.9082 s")) << said(r);
  EXPECT_TRUE(has(said(r), "the vibration decays")) << said(r);
}

TEST(Sticking, IsSaidOfAShaftThatRestsAgainAndAgain) {
  const Result r = test::run(test::scene_file("scenes/stick_slip.toml"), false);
  const std::string text = said(r);
  EXPECT_TRUE(has(text, "\"train.out\" sticks and slips: it rests ")) << text;
  EXPECT_TRUE(has(text, "\"drive\" runs steadily at 0.05 rad/s")) << text;
}

// A governed drive that a compressor shakes loose again and again: the angles at the end are off by turns, speeds by some
// rad/s; what slips while the clutch engages is known, most of all when it begins.
TEST(Clutches, ThatEngageAreSaidThoughNoAngleIsKnown) {
  const std::string scene = R"(
    line = ["motor", "flywheel", "clutch", "press"]
    motor = { kind = "governor", speed = "142.97 rad/s", proportional_gain = "201.63 N*m*s/rad", integral_gain = "469.46 N*m/rad", max_torque = "2162 N*m", inertia = "1.299 kg*m2" }
    flywheel = { kind = "flywheel", inertia = "2.1178 kg*m2" }
    clutch = { kind = "clutch", torque = "2187.3 N*m", static_torque = "2217.2 N*m" }
    press = { kind = "slider-crank", radius = "0.060227 m", rod = "0.24523 m", crank_inertia = "3.031 kg*m2", slider_mass = "127.47 kg", load = { kind = "compressor", bore = "0.14071 m", suction_pressure = "1.0048e+06 Pa", delivery_pressure = "4.0192e+06 Pa", clearance = 0.06 } }
    sequence = { steps = [{ at = "0 s", set = "clutch", to = 0 }, { at = "1.477 s", set = "clutch", to = 1, over = "0.14907 s" }] }
    run = { start = { angle = "30 deg" }, until = )";
  const Result r = test::run(scene + "\"3.51956 s\" }"), open = test::run(scene + "\"1.477 s\" }");
  const Claim* engages = find(r.claims, Predicate::clutch_slips_engaging, "clutch");
  ASSERT_TRUE(engages) << said(r);
  const double begins = open.find("final_speed.flywheel")->value - open.find("final_speed.press")->value;
  EXPECT_GT(begins, 100);
  EXPECT_NEAR(*engages->evidence.value, begins, 1e-3 * begins);
}

// The clutch's 50 N·m are less than the weight's 60: the motor runs at 50 rad/s·(1 − 50/200), the weight falls by 5 rad/s².
TEST(Clutches, ThatSlipUnderAWeightSayThatItFalls) {
  const Result r = test::run(R"(
    line = ["motor", "clutch", "drum"]
    motor = { kind = "dc shunt motor", stall_torque = "200 N*m", no_load_speed = "50 rad/s", inertia = "1 kg*m2" }
    clutch = { kind = "clutch", torque = "50 N*m" }
    drum = { kind = "load", torque = "60 N*m", acts = "always", inertia = "2 kg*m2" }
    run = { until = "5 s", start = "rest" }
  )");
  EXPECT_TRUE(has(said(r), "under the 50 N·m that it can transmit, and what it drives turns backwards, at -25 rad/s"))
      << said(r);
}

// A limiter that lets go has a rating that does not hold.
TEST(Limiters, ThatSlipLeaveNoSentenceThatAllHolds) {
  const Result r = test::run(R"(
    line = ["motor", "limiter", "wheel"]
    motor = { kind = "dc shunt motor", stall_torque = "2 kN*m", no_load_speed = "100 rad/s", inertia = "5 kg*m2" }
    limiter = { kind = "torque limiter", torque = "100 N*m", allowable_heat = "1 MJ" }
    wheel = { kind = "flywheel", inertia = "5 kg*m2", rim_radius = "100 mm", allowable_rim_speed = "100 m/s" }
    blow = { kind = "load", on = "wheel", torque = "300 N*m", acts = "against motion", start = "1 s", stop = "1.05 s" }
    run = { start = { speed = "100 rad/s" }, until = "4 s" }
  )");
  EXPECT_TRUE(find(r.claims, Predicate::limiter_slips, "limiter")) << said(r);
  EXPECT_FALSE(has(said(r), "ratings hold")) << said(r);
  EXPECT_TRUE(has(said(r), "1 of 3 ratings EXCEEDED, worst \"limiter\", holding torque")) << said(r);
}

// 60 N·m drive; the brake's 100 N·m are among the loads: no remedy is named beside it.
TEST(Steady, NamesABrakeThatIsOn) {
  const auto why = [](const std::string& brake) {
    const Scene scene = test::scene_from(R"(
      line = ["motor", "mill"]
      motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "100 rad/s", inertia = "0.1 kg*m2" }
      mill = { kind = "load", torque = "20 N*m", inertia = "1 kg*m2" }
    )" + brake);
    return steady(scene, {scene.effects}, {.start_search = false}).diagnosis;
  };
  const std::string braked = why("brake = { kind = \"brake\", on = \"motor\", torque = \"100 N*m\" }"),
                    heavy = why("more = { kind = \"load\", on = \"motor\", torque = \"100 N*m\" }");
  EXPECT_TRUE(has(braked, "(120 N·m against 60 N·m at ")) << braked;
  EXPECT_TRUE(has(braked, "These loads include \"brake\", which is on")) << braked;
  EXPECT_FALSE(has(braked, "is needed")) << braked;
  EXPECT_TRUE(has(heavy, "A stronger drive, a higher ratio, or a lighter load is needed")) << heavy;
}

// 40 N·m·sin φ balance the motor's 20 N·m at 30°: from 29.9° it moves at 0.002 rad/s, usual are 100, until the bearing
// holds it. On the mean nothing but the bearing's 0.05 N·m is against the motor.
TEST(Steady, SaysOfWhatNeverTurnedNoRunDown) {
  const Scene scene = test::scene_from(R"(
    line = ["motor", "arm"]
    motor = { kind = "dc shunt motor", stall_torque = "20 N*m", no_load_speed = "100 rad/s", inertia = "0.5 kg*m2" }
    arm = { kind = "load", inertia = "0.5 kg*m2", table = { over = "angle", formula = "sin(phi)*40 [N*m]" } }
    drag = { kind = "bearing", on = "motor", torque = "0.05 N*m" }
    run = { start = { angle = "29.9 deg" } }
  )");
  const std::string why = steady(scene, {scene.effects}, {.start_search = false}).diagnosis;
  EXPECT_TRUE(has(why, "the machine stays at rest: \"motor\" never reaches 0.1 % of its rated speed")) << why;
}

TEST(Steady, WarnsOfAStartWhoseShaftsDisagree) {
  const Scene scene = test::scene_from(R"(
    line = ["motor", "coupling", "wheel"]
    motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2" }
    coupling = { kind = "coupling", stiffness = "10 kN*m/rad", relative_damping = 0.8 }
    wheel = { kind = "load", damping = "0.2 N*m*s/rad", inertia = "4 kg*m2" }
    effects = { elasticity = true }
    run = { until = "0.5 s", start = { motor = { speed = "70 rad/s" } } }
  )");
  const Claims claims = claims_of(steady(scene, {scene.effects}, {.start_search = false}));
  const Claim* disagree = find(claims, Predicate::start_shafts_disagree, "coupling");
  ASSERT_TRUE(disagree);
  EXPECT_NEAR(*disagree->evidence.value, 70, 1e-9);
  EXPECT_TRUE(find(claims, Predicate::runs_steadily));
}

// Two shafts that are too thin: each diameter was computed, whichever is worse.
TEST(Remedies, OfAllVerdictsAreTried) {
  Result run = test::run(R"(
    line = ["motor", "first", "wheel", "second", "mill"]
    motor = { kind = "dc shunt motor", stall_torque = "400 N*m", no_load_speed = "100 rad/s", inertia = "0.5 kg*m2" }
    first = { kind = "shaft", length = "300 mm", diameter = "30 mm", inertia = "0 kg*m2", allowable_shear_stress = "40 MPa" }
    wheel = { kind = "load", damping = "0.2 N*m*s/rad", inertia = "1.5 kg*m2" }
    second = { kind = "shaft", length = "300 mm", diameter = "20 mm", inertia = "0 kg*m2", allowable_shear_stress = "40 MPa" }
    mill = { kind = "load", damping = "0.1 N*m*s/rad", inertia = "1 kg*m2" }
    run = { until = "3 s" }
  )");
  run.cpu_total = 60;  // for as many values as it takes
  const auto tried = with_trials(std::move(run), {});
  int count = 0;
  for (const Verdict& v : judge_ratings(tried.study)) {
    ASSERT_EQ(v.state(), Compliance::exceeded) << v.component;
    EXPECT_TRUE(v.remedy && v.remedy->tried) << v.component << ": " << v.note;
    // A rigid shaft's torque is the same whatever its diameter: W_p goes with d³.
    const double given = v.component == "first" ? 0.03 : 0.02;
    EXPECT_NEAR(v.remedy->value, given * std::cbrt((v.value + v.known_error()) / v.limit), 1e-3 * given) << v.component;
    ++count;
  }
  EXPECT_EQ(count, 2);
}

// Of 0.1 kg·m² at more than 20 rad/s 4 N·m take off 12 rad/s in the 0.3 s that the brake is on; 40 N·m stop it in half the time.
TEST(Brakes, ThatASequenceTakesOffTooEarlyAreNamed) {
  for (const double torque : {4.0, 40.0}) {
    const Result r = test::run(fmt::format(R"(
      line = ["motor", "clutch", "brake", "mill"]
      motor = {{ kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", inertia = "0.5 kg*m2" }}
      clutch = {{ kind = "clutch", torque = "50 N*m" }}
      brake = {{ kind = "brake", torque = "{} N*m" }}
      mill = {{ kind = "flywheel", inertia = "0.1 kg*m2" }}
      sequence = {{ repeat = true, steps = [{{ after = "0.01 s", set = "brake", to = 0 }}, {{ after = "0.5 s", set = "clutch", to = 0 }}, {{ after = "0 s", set = "brake", to = 1 }}, {{ after = "0.3 s", set = "brake", to = 0 }}, {{ after = "0.01 s", set = "clutch", to = 1 }}] }}
      run = {{ until = "3 s", start = {{ speed = "20 rad/s" }} }}
    )",
                                           torque),
                               false);
    const Claim* claim = find(r.claims, Predicate::brake_has_not_stopped, "brake");
    EXPECT_EQ(claim != nullptr, torque == 4);
    if (!claim) continue;
    EXPECT_NEAR(*claim->evidence.at, 0.81, 1e-9) << claim->text;
    EXPECT_EQ(claim->text.find("\"brake\" is taken off 3 times while its shaft still turns"), 0u) << claim->text;
  }
}

}  // namespace
}  // namespace kurbel::motion_claims_test
