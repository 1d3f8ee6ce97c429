// held_and_started_test.cpp — what acts on what is held, brakes that let go again, slow starts, starters that wait, rest.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "studies/answers/run_claims.h"
#include "studies/run/run_findings.h"
#include "studies/steady/steady_words.h"
#include "tests/support/conclusions.h"
#include "tests/support/scenes.h"

namespace kurbel::held_and_started_test {
namespace {

using test::find;
using test::has;
using test::said;

// The acting torque by the note on what is held.
double acting(const Result& r) {
  const std::string words = "the acting torque is ";
  for (const std::string& note : r.notes)
    if (const std::size_t begin = note.find(words); begin != std::string::npos)
      return std::abs(std::stod(note.substr(begin + words.size())));
  return std::nan("");
}

void expect_as_noted(const std::string& scene, double torque, double error) {
  const Result r = test::run(scene, false);
  const Claim* held = find(r.claims, Predicate::held_by, "motor");
  ASSERT_TRUE(held) << said(r);
  EXPECT_NEAR(*held->evidence.value, torque, error) << said(r);
  EXPECT_NEAR(*held->evidence.value, acting(r), 1e-3 * torque) << said(r);
}

// The wheel runs on, and only the drag of its clutch acts on the motor.
TEST(ActingTorque, IsTheDragOfAOneWayClutchThatOverruns) {
  expect_as_noted(R"(
    line = ["motor", "owc", "fly"]
    motor = { kind = "dc shunt motor", stall_torque = "50 N*m", no_load_speed = "150 rad/s", inertia = "0.2 kg*m2" }
    brake = { kind = "brake", on = "motor", torque = "30 N*m" }
    owc = { kind = "one-way clutch", drag = "0.5 N*m" }
    fly = { kind = "load", inertia = "4 kg*m2", damping = "0.1 N*m*s/rad" }
    sequence = { steps = [{ at = "0 s", set = "brake", to = 0 }, { at = "2 s", set = "motor", to = 0 }, { after = "0 s", set = "brake" }] }
    run = { start = "rest", until = "20 s" }
  )",
                  0.5, 1e-9);
}

// A twentieth of 200 N·m is what the clutch transmits while it slips.
TEST(ActingTorque, IsWhatASlippingClutchTransmits) {
  expect_as_noted(R"(
    line = ["motor", "clutch", "drum"]
    motor = { kind = "dc shunt motor", stall_torque = "50 N*m", no_load_speed = "150 rad/s", inertia = "0.2 kg*m2" }
    brake = { kind = "brake", on = "motor", torque = "60 N*m" }
    clutch = { kind = "clutch", torque = "200 N*m" }
    drum = { kind = "load", inertia = "40 kg*m2", damping = "0.5 N*m*s/rad" }
    sequence = { steps = [{ at = "0 s", set = "brake", to = 0 }, { at = "60 s", set = "motor", to = 0 }, { at = "60 s", set = "clutch", to = 0.05 }, { after = "0 s", set = "brake" }] }
    run = { start = "rest", until = "65 s" }
  )",
                  10, 1e-9);
}

// The drum still oscillates on the shaft's spring.
TEST(ActingTorque, IsThatOfTheShaftWhoseFarEndStillOscillates) {
  expect_as_noted(R"(
    line = ["motor", "shaft", "drum"]
    motor = { kind = "dc shunt motor", stall_torque = "200 N*m", no_load_speed = "100 rad/s", inertia = "0.5 kg*m2" }
    brake = { kind = "brake", on = "motor", torque = "150 N*m" }
    shaft = { kind = "shaft", stiffness = "2 kN*m/rad", damping = "0.3 N*m*s/rad" }
    drum = { kind = "load", torque = "40 N*m", acts = "always", inertia = "4 kg*m2" }
    effects = { elasticity = true }
    sequence = { steps = [{ at = "0 s", set = "brake", to = 0 }, { at = "2 s", set = "motor", to = 0 }, { at = "2 s", set = "brake" }] }
    run = { start = "rest", until = "7 s" }
  )",
                  9.663, 0.05);
}

// On the drum, a hundred times that on the motor's shaft, where the brake is: 100 N·m against 1 N·m.
TEST(ActingTorque, IsThatOnTheLinkWhereTheBrakeIsBehindAGear) {
  const Result r = test::run(R"(
    line = ["motor", "gear", "drum"]
    motor = { kind = "inertia", inertia = "0.1 kg*m2" }
    brake = { kind = "brake", on = "drum", torque = "300 N*m" }
    gear = { kind = "gearbox", stages = [{ teeth = [20, 200] }] }
    drum = { kind = "load", torque = "100 N*m", acts = "always", inertia = "3 kg*m2" }
    run = { start = "rest", until = "1 s" }
  )",
                             false);
  const Claim* held = find(r.claims, Predicate::held_by);
  ASSERT_TRUE(held) << said(r);
  EXPECT_NEAR(*held->evidence.value, held->of == "drum" ? 100 : 10, 1e-9) << said(r);
}

// 4 kg·m² stop from 40 rad/s under 50 N·m within 3.2 s of 1 s; 20 N·m/s from 10 s on reach 60 N·m at 13 s.
TEST(Brakes, ThatStoppedItAndWereOvercomeAreNotSaidNotToHaveStoppedIt) {
  const Result r = test::run(R"(
    line = ["rotor"]
    rotor = { kind = "flywheel", inertia = "4 kg*m2" }
    brake = { kind = "brake", on = "rotor", torque = "50 N*m", static_torque = "60 N*m" }
    src = { kind = "torque source", on = "rotor", table = { over = "time", unit = ["s", "N*m"], points = [[0, 0], [10, 0], [15, 100], [30, 100]] } }
    sequence = { steps = [{ at = "0 s", set = "brake", to = 0 }, { at = "1 s", set = "brake" }] }
    run = { start = { speed = "40 rad/s" }, until = "14 s" }
  )");
  ASSERT_TRUE(find(r.claims, Predicate::brake_does_not_stop, "brake")) << said(r);
  EXPECT_TRUE(
      said(r).starts_with("\"brake\" stopped it at 4.2 s and held it until 13 s, when more acted on it than the "
                          "60 N·m that it can hold; it slips at 5 rad/s at the end."))
      << said(r);
}

// A brake whose ramp goes on already holds more than the load: 45 N·m against 40.
TEST(Brakes, WhoseRampGoesOnAreSaidOfWhatFalls) {
  const Result r = test::run(R"(
    line = ["motor", "drum"]
    motor = { kind = "torque source", torque = "10 N*m", inertia = "1 kg*m2", stop = "1 s" }
    drum = { kind = "load", torque = "40 N*m", acts = "always", inertia = "1 kg*m2" }
    brake = { kind = "brake", on = "drum", torque = "90 N*m" }
    sequence = { steps = [{ at = "0 s", set = "brake", to = 0 }, { at = "3 s", set = "brake", over = "0.2 s" }] }
    run = { start = "rest", until = "3.11 s" }
  )");
  EXPECT_TRUE(has(said(r), "\"motor\" turns backwards")) << said(r);
  EXPECT_TRUE(has(said(r), "its loads drive it, and \"brake\" has not stopped it yet")) << said(r);
}

// Stalled it gives 33.101 N·m, 0.001 more than the load holds: a deviation grows as e^(λt), slowly at first.
std::string mill(double load) {
  return fmt::format(R"(
    line = ["motor", "mill"]
    motor = {{ kind = "induction motor", rated_power = "4 kW", rated_speed = "1430 rpm", synchronous_speed = "1500 rpm", breakdown_ratio = 2.7, inertia = "0.02 kg*m2" }}
    mill = {{ kind = "load", torque = "{} N*m", inertia = "0.5 kg*m2" }}
    run = {{ start = "rest", until = "5 s" }}
  )",
                     load);
}
TEST(SlowStarts, AreNoStandstill) {
  const Result r = test::run(mill(33.1));
  EXPECT_FALSE(find(r.claims, Predicate::does_not_start)) << said(r);
  const Claim* moves = find(r.claims, Predicate::moves, "motor");
  ASSERT_TRUE(moves) << said(r);
  EXPECT_TRUE(said(r).starts_with("\"motor\" moves at 0.2727 rpm after 5 s, and still gathers speed.")) << said(r);
}
TEST(SlowStarts, AreNotSaidOfWhatItsLoadHolds) {
  const Result r = test::run(mill(33.2));
  EXPECT_TRUE(find(r.claims, Predicate::does_not_start)) << said(r);
}

// In star a third of the torque balances the fan at 1376 rpm.
std::string fan(const std::string& switch_speed) {
  return fmt::format(R"(
    line = ["motor", "fan"]
    motor = {{ kind = "induction motor", rated_power = "30 kW", rated_speed = "1460 rpm", synchronous_speed = "1500 rpm", breakdown_ratio = 2.5, inertia = "0.25 kg*m2", starting = "star-delta", switch_speed = "{}", pause = "80 ms" }}
    fan = {{ kind = "load", quadratic = "0.0072 N*m*s2/rad2", inertia = "9 kg*m2" }}
    run = {{ start = "rest", until = "60 s" }}
  )",
                     switch_speed);
}
TEST(Starters, ThatNeverSwitchAreSaid) {
  const std::string sentence = "\"motor\" stays in star: its switching speed, 1420 rpm, is not reached (1376 rpm)";
  const Scene scene = test::scene_from(fan("1420 rpm"));
  const Result r = test::run(scene, false);
  EXPECT_TRUE(said(r).starts_with(sentence + ".")) << said(r);
  const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
  EXPECT_TRUE(has(said(study), sentence)) << said(study);
}
TEST(Starters, ThatSwitchAreNotSaid) {
  const Scene scene = test::scene_from(fan("1300 rpm"));
  const Result r = test::run(scene, false);
  EXPECT_FALSE(find(r.claims, Predicate::starter_waits)) << said(r);
  const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
  EXPECT_FALSE(has(said(study), "stays in star")) << said(study);
}

// κ i² = 90 N·m, κ = 0.02 N·m/A²: 67.08 A, more than the 60 A at which the last resistance would be cut out.
std::string rheostat(const std::string& current) {
  return fmt::format(R"(
    line = ["motor", "hoist"]
    motor = {{ kind = "dc series motor", voltage = "400 V", resistance = "0.5 Ohm", constant = "0.02 N*m/A2", inertia = "1.5 kg*m2", rated_speed = "90 rad/s", starting_resistances = ["1 Ohm"], switch_current = "{}" }}
    hoist = {{ kind = "load", torque = "90 N*m", damping = "0.001 N*m*s/rad", inertia = "2 kg*m2" }}
    run = {{ start = "rest", until = "60 s" }}
  )",
                     current);
}
TEST(Starters, WhoseResistancesStayInTheCircuitAreSaid) {
  const Result r = test::run(rheostat("60 A"), false);
  const Claim* waits = find(r.claims, Predicate::starter_waits, "motor");
  ASSERT_TRUE(waits) << said(r);
  EXPECT_NEAR(*waits->evidence.value, std::sqrt(90 / 0.02), 0.2);
  EXPECT_TRUE(has(waits->text, "stays on its starting resistances: its current, 67.")) << waits->text;
  const Result cut_out = test::run(rheostat("80 A"), false);
  EXPECT_FALSE(find(cut_out.claims, Predicate::starter_waits)) << said(cut_out);
}

// J ω̇ = −100 N·m − b ω on 2 kg·m² from ω₀: at rest at J/b ln(1 + b ω₀/100 N·m).
TEST(Rest, IsSaidWithItsTime) {
  const Result r = test::run(R"(
    line = ["wheel"]
    wheel = { kind = "flywheel", inertia = "2 kg*m2" }
    load = { kind = "load", on = "wheel", torque = "20 N*m", damping = "0.05 N*m*s/rad" }
    brake = { kind = "brake", on = "wheel", torque = "80 N*m" }
    run = { start = { speed = "1500 rpm" }, until = "5 s" }
  )");
  const double rest = 2 / 0.05 * std::log(1 + 0.05 * 50 * std::numbers::pi / 100);
  const Claims claims = run_claims(r);
  const Claim* at_rest = find(claims, Predicate::at_rest, "wheel");
  ASSERT_TRUE(at_rest) << said(r);
  EXPECT_NEAR(*at_rest->evidence.at, rest, 1e-6);
  EXPECT_TRUE(said(r).starts_with(fmt::format("\"wheel\" comes to rest at {:.4g} s", rest))) << said(r);
}

// It falls, M = m g r, for ever: no speed is among its data.
TEST(Speeds, OfAMachineWithoutOneInItsDataAreNotCompared) {
  const Result r = test::run(R"(
    line = ["drum"]
    drum = { kind = "slide", radius = "200 mm", inertia = "0.8 kg*m2", mass = "20 kg", inclination = "-90 deg" }
    run = { start = "rest", until = "3 s" }
  )",
                             false);
  EXPECT_TRUE(has(said(r), "runs away: 702.")) << said(r);
  EXPECT_FALSE(has(said(r), "of its data")) << said(r);
}

// The speed is far from the rated torque's at no load; the start takes nearly all of it.
TEST(ThermalLoad, IsSaidOfTheSteadyMotion) {
  const Result r = test::run(R"(
    line = ["motor", "wheel"]
    motor = { kind = "induction motor", rated_power = "11 kW", rated_speed = "1460 rpm", synchronous_speed = "1500 rpm", breakdown_ratio = 2.5, inertia = "0.1 kg*m2" }
    wheel = { kind = "flywheel", inertia = "0.7 kg*m2" }
    run = { start = "rest", until = "3 s" }
  )",
                             false);
  EXPECT_TRUE(has(said(r), "thermal load of \"motor\" in its steady motion is 0 % (RMS over rated torque)")) << said(r);
}

// A scene in rad/s gets its messages in rad/s: 5 times 90 rad/s.
TEST(RunawayOfASeriesMotor, IsSaidInTheUnitOfTheScene) {
  const Result r = test::run(R"(
    line = ["motor", "wheel"]
    motor = { kind = "dc series motor", voltage = "400 V", resistance = "0.5 Ohm", constant = "0.02 N*m/A2", inertia = "1.5 kg*m2", rated_speed = "90 rad/s" }
    wheel = { kind = "inertia", inertia = "0.5 kg*m2" }
    run = { start = "rest", until = "30 s" }
  )",
                             false);
  EXPECT_TRUE(has(r.diagnosis, "its speed passed max_speed = 450 rad/s (by default 5 rated_speed)")) << r.diagnosis;
}

// Two brakes on shafts that a gear i = 10 joins share in proportion to their holds, 20 and 200/10 N·m on the motor: both hold the
// 100/10 N·m that act there.
TEST(Brakes, ThatHoldTogetherAreBothNamedWithWhatTheyHold) {
  const Result r = test::run(R"(
    line = ["motor", "gearbox", "drum"]
    motor = { kind = "inertia", inertia = "0.05 kg*m2" }
    b1 = { kind = "brake", on = "motor", torque = "14 N*m", static_torque = "20 N*m" }
    gearbox = { kind = "gearbox", stages = [{ teeth = [20, 200] }] }
    drum = { kind = "inertia", inertia = "3 kg*m2" }
    b2 = { kind = "brake", on = "drum", torque = "150 N*m", static_torque = "200 N*m" }
    w = { kind = "torque source", on = "drum", torque = "-100 N*m" }
    run = { start = { speed = "10 rad/s" }, until = "10 s" }
  )");
  const auto held =
      std::find_if(r.claims.begin(), r.claims.end(), [](const Claim& c) { return c.predicate == Predicate::held_by; });
  ASSERT_NE(held, r.claims.end());
  EXPECT_EQ(held->text, "\"motor\" is held by \"b1\", \"b2\" against the 10 N·m that act on it");
}

}  // namespace
}  // namespace kurbel::held_and_started_test
