// stopping_test.cpp — stopping time and angle of an emergency stop, against a constant deceleration in closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/published/published.h"

namespace kurbel::stopping_test {
namespace {

using test::figure;
using test::run;

// A motor holds a wheel with a load at a steady speed ω; at an angle it is switched off and the brake falls in, a load on
// the way is let go and set again: none of these is a signal.
std::string machine(const std::string& steps) {
  return fmt::format(R"(
line = ["motor", "wheel"]
motor = {{ kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", inertia = "0.5 kg*m2" }}
wheel = {{ kind = "flywheel", inertia = "1.5 kg*m2" }}
brake = {{ kind = "brake", on = "wheel", torque = "25 N*m" }}
load = {{ kind = "load", on = "wheel", torque = "15 N*m" }}
sequence = {{ steps = [{{ at = "0 s", set = "brake", to = 0 }}, {}] }}
run = {{ start = {{ speed = "30 rad/s" }}, until = "6 s", accuracy = 1e-10 }}
)",
                     steps);
}

TEST(Stopping, CountsFromTheBrakesSignalAtAnAngle) {
  const Result r = run(machine(R"(
    { at = "0.5 s", set = "load", to = 0 }, { at = "0.5 s", set = "load" },
    { at = "1 s", set = "load" },
    { angle = "90 deg", of = "wheel", set = ["motor", "load"], to = 0 }, { after = "0 s", set = "brake" })"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  // M_d = 60 (1 − 30/40) = 15 N·m: it runs at 30 rad/s until then.
  EXPECT_NEAR(figure(r, "stopping_time.motor"), 2 * 30 / 25.0, 1e-8);
  EXPECT_NEAR(figure(r, "stopping_angle.motor"), 30 * 30 * 2 / (2 * 25.0), 1e-7);
  const double begins = figure(r, "final_angle.motor") - figure(r, "stopping_angle.motor");
  EXPECT_NEAR(std::remainder(begins - std::numbers::pi / 2, 2 * std::numbers::pi), 0, 1e-7);
}

// Off alone it coasts for half a second, which counts; what drove again in between begins anew.
TEST(Stopping, BeginsWithTheFirstThatStopsAfterTheLastThatDrives) {
  const Result r = run(machine(R"(
    { at = "0.2 s", set = "motor", to = 0 }, { at = "0.2 s", set = "motor" },
    { at = "1 s", set = "motor", to = 0 }, { at = "1.5 s", set = "brake" })"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double slowed = 30 - 15 / 2.0 * 0.5, rest = slowed * 2 / 40;
  EXPECT_NEAR(figure(r, "stopping_time.motor"), 0.5 + rest, 1e-8);
  EXPECT_NEAR(figure(r, "stopping_angle.motor"), 0.5 * (30 + slowed) / 2 + 0.5 * slowed * rest, 1e-7);
}

// A difference of angles is as exact as they are: a hundred turns before the signal cost two digits.
TEST(Stopping, HasTheRoundingOfItsAngles) {
  const auto error = [](double signal) {
    Scene scene = test::scene_from(machine(fmt::format(R"(
    {{ at = "{0} s", set = ["motor", "load"], to = 0 }}, {{ at = "{0} s", set = "brake" }})",
                                                       signal)));
    scene.run.until = signal + 3;
    const Result r = run(scene);
    const Figure& angle = *r.find("stopping_angle.motor");
    EXPECT_NEAR(angle.value, 36, *angle.error);
    return *angle.error;
  };
  EXPECT_GT(error(100), 4e-13);  // an ulp of 3000 rad
}

// A rigid belt that the brake makes slip, J₂ ω̇ = −(M_b − M_s), grips again when its pulleys turn alike: that is no new
// drive. The rotor is slowed by M_s all along; both then by the brake alone.
TEST(Stopping, GoesOnWhereABeltThatSlippedGripsAgain) {
  const Result r = run(R"(
line = ["motor", "belt", "wheel"]
motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "100 rad/s", inertia = "0.5 kg*m2" }
belt = { kind = "belt", diameter_in = "200 mm", diameter_out = "200 mm", pretension = "300 N", friction_coefficient = 0.3, wrap_angle = "180 deg" }
wheel = { kind = "flywheel", inertia = "0.5 kg*m2" }
brake = { kind = "brake", on = "wheel", torque = "100 N*m" }
sequence = { steps = [{ at = "0 s", set = "brake", to = 0 }, { at = "5 s", set = "motor", to = 0 },
                      { at = "5 s", set = "brake" }, { at = "5.3 s", set = "brake", to = 0.2 }] }
run = { start = { speed = "100 rad/s" }, until = "12 s", accuracy = 1e-10 }
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double strand = std::exp(0.3 * std::numbers::pi), slip = 2 * 300 * (strand - 1) / (strand + 1) * 0.1;
  const double J = 0.5, begin = 100;
  const double belt_at = begin - (100 - slip) / J * 0.3, rotor_at = begin - slip / J * 0.3;
  const double gripping = (rotor_at - belt_at) / ((slip + slip - 20) / J);  // from 5.3 s on
  const double left = rotor_at - slip / J * gripping;
  EXPECT_NEAR(figure(r, "stopping_time.motor"), 0.3 + gripping + left * 2 * J / 20, 1e-6);
}

// No command stops it: a load that is too heavy does.
TEST(Stopping, IsNoneWithoutASignal) {
  const Result r =
      run(test::with(machine(R"({ at = "1 s", set = "load" })"), "torque = \"15 N*m\"", "torque = \"80 N*m\""));
  EXPECT_EQ(r.find("stopping_time.motor"), nullptr);
}

}  // namespace
}  // namespace kurbel::stopping_test
