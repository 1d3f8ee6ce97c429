// troubles_test.cpp — machines with a fault of design each: what is said of them first.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "studies/claims/headline.h"
#include "studies/run/run_findings.h"
#include "tests/support/conclusions.h"
#include "tests/support/scenes.h"

namespace kurbel::troubles_test {
namespace {

std::string first_sentence(const Result& r) {
  test::expect_valid_conclusion(findings_of(r), r.title);
  return concluded(findings_of(r).claims).front();
}
void expect_first(const std::string& scene, const std::string& sentence) {
  EXPECT_EQ(first_sentence(test::run(scene)), sentence);
}

// Kloss with M_b = 100 N·m at s_b = 0.2 gives 58.57 N·m at 60 rad/s, where c ω² takes as much.
TEST(Troubles, AMotorThatStaysBelowItsBreakdownSpeedDoesNotComeUpToSpeed) {
  const double s = 1 - 60 / 157.07963267948966, torque = 200 / (s / 0.2 + 0.2 / s);
  const std::string text = R"(
    line = ["motor", "fan"]
    motor = { kind = "induction motor", breakdown_torque = "100 N*m", breakdown_slip = 0.2, synchronous_speed = "1500 rpm", inertia = "0.1 kg*m2" }
    fan = { kind = "load", inertia = "0.4 kg*m2", quadratic = ")" +
                           std::to_string(torque / 3600) + R"( N*m*s2/rad2" }
    run = { start = "rest", until = "10 s" }
  )";
  expect_first(
      text,
      "\"motor\" does not come up to speed: it stays at 573 rpm, below the 1200 rpm of its breakdown torque; its "
      "loads take all its torque there.");
}

// 100 N·m drive, the brake takes 60 N·m of them, 2 N·m·s/rad the rest: 20 rad/s for ever.
TEST(Troubles, ABrakeThatIsWeakerThanTheDriveDoesNotStopIt) {
  expect_first(R"(
    line = ["motor", "wheel"]
    motor = { kind = "torque source", torque = "100 N*m" }
    wheel = { kind = "load", inertia = "1 kg*m2", damping = "2 N*m*s/rad" }
    brake = { kind = "brake", on = "wheel", torque = "60 N*m" }
    sequence = { steps = [{ after = "0 s", set = "brake", to = 0 }, { after = "2 s", set = "brake", to = 1 }] }
    run = { start = { speed = "50 rad/s" }, until = "10 s" }
  )",
               "\"brake\" does not stop it: it slips at 20 rad/s after 8 s; its 60 N·m are too weak for what drives.");
}

// ω = 100 − 10 t rad/s: after 6 s of braking 40 rad/s are left, and 4 s.
TEST(Troubles, ABrakeThatHasNotStoppedItByTheEndSaysHowLongItTakes) {
  expect_first(R"(
    line = ["wheel"]
    wheel = { kind = "flywheel", inertia = "10 kg*m2" }
    brake = { kind = "brake", on = "wheel", torque = "100 N*m" }
    sequence = { steps = [{ after = "0 s", set = "brake", to = 0 }, { after = "1 s", set = "brake", to = 1 }] }
    run = { start = { speed = "100 rad/s" }, until = "7 s" }
  )",
               "\"brake\" has not stopped it by the end: 40 rad/s are left after 6 s, and 4 s more are needed at this "
               "rate.");
}

// The load's 300 N·m ask 150 N·m of a clutch between equal inertias that holds 120 N·m.
TEST(Troubles, AClosedClutchThatLetsGoOnTheWayIsSaid) {
  const Result r = test::run(R"(
    line = ["motor", "clutch", "wheel"]
    motor = { kind = "dc shunt motor", stall_torque = "2 kN*m", no_load_speed = "100 rad/s", rated_torque = "200 N*m", inertia = "5 kg*m2" }
    clutch = { kind = "clutch", torque = "100 N*m", static_torque = "120 N*m" }
    wheel = { kind = "flywheel", inertia = "5 kg*m2" }
    blow = { kind = "load", on = "wheel", torque = "300 N*m", acts = "against motion", start = "1 s", stop = "1.05 s" }
    run = { start = { speed = "100 rad/s" }, until = "4 s" }
  )");
  const std::vector<std::string> said = concluded(findings_of(r).claims);
  ASSERT_GE(said.size(), 2u);
  EXPECT_EQ(said[0],
            "\"clutch\" slips once although it is closed, first at 1 s: the torque reaches the 120 N·m that it holds.");
}

// It slips from 1 s on: (300 − 100) N·m stop 5 kg·m² at 100 rad/s after 2.5 s, 225 rad on, and hold it there.
TEST(Troubles, AStallBehindAClutchThatSlipsNamesTheClutch) {
  expect_first(
      R"(
    line = ["motor", "clutch", "press"]
    motor = { kind = "dc shunt motor", stall_torque = "2 kN*m", no_load_speed = "100 rad/s", rated_torque = "200 N*m", inertia = "5 kg*m2" }
    clutch = { kind = "clutch", torque = "100 N*m", static_torque = "120 N*m" }
    press = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "5 kg*m2", slider_mass = "1 g" }
    jam = { kind = "load", on = "press", torque = "300 N*m", acts = "against motion", start = "1 s" }
    run = { start = { speed = "100 rad/s" }, until = "6 s" }
  )",
      "\"press\" stalls at 291.6° after 3.5 s: \"clutch\" slips to the end, by 95 rad/s under the 100 N·m that "
      "it can transmit.");
}

// A crank requires 150 % of its motor's rating, on average over a cycle that repeats; nothing where a duty is judged.
TEST(Troubles, AMotorThatIsOverloadedForGoodGetsTooHot) {
  const std::string text = R"(
    line = ["motor", "flywheel", "crank"]
    motor = { kind = "dc shunt motor", stall_torque = "2 kN*m", no_load_speed = "100 rad/s", rated_torque = "100 N*m", inertia = "0.5 kg*m2" }
    flywheel = { kind = "load", inertia = "1 kg*m2", torque = "150 N*m", acts = "against motion" }
    crank = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "0.01 kg*m2", slider_mass = "1 g" }
    run = { start = { speed = "92 rad/s" }, until = "3 s" }
  )";
  expect_first(text,
               "\"motor\" gets too hot: the RMS torque of its steady motion is 150 % of the rated one; by an estimate "
               "it holds from a rated torque of 150 N·m on.");
}

// A belt whose limit lies below the load's torque: it can only slip, whether it stretches or not.
TEST(Troubles, ABeltThatSlipsToTheEndIsSaid) {
  for (const char* elasticity : {"true", "false"}) {
    const Result r = test::run(std::string(R"(
      line = ["motor", "belt", "mill"]
      motor = { kind = "dc shunt motor", stall_torque = "200 N*m", no_load_speed = "100 rad/s", inertia = "0.5 kg*m2" }
      belt = { kind = "belt", diameter_in = "200 mm", diameter_out = "200 mm", centre_distance = "800 mm", friction_coefficient = 0.3, pretension = "300 N", stiffness = "2 kN*m/rad", damping_ratio = 0.05 }
      mill = { kind = "load", inertia = "1 kg*m2", quadratic = "40 mN*m*s2/rad2" }
      effects = { elasticity = )") +
                               elasticity + R"( }
      run = { start = "rest", until = "20 s" }
    )");
    const std::string said = first_sentence(r);
    EXPECT_TRUE(said.starts_with("\"belt\" slips to the end, by ")) << said;
  }
}

}  // namespace
}  // namespace kurbel::troubles_test
