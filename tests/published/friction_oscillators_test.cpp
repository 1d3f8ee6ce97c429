// friction_oscillators_test.cpp — stick–slip on a belt, and a pendulum with dry friction
// (tests/cases/el03_friction_oscillators.toml).
#include <fmt/format.h>

#include "tests/published/published.h"
#include "tests/support/validation.h"

namespace kurbel::friction_oscillators_test {
namespace {

using test::Against;
using test::figure;
using test::run;
using test::Validation;

// A disc (J = 1 kg·m², spring 100 N·m/rad to the frame) rubs on a shaft that turns at 0.1 rad/s: static 6 N·m,
// kinetic 4 N·m. The same numbers as the mass on a belt.
const char* const stick_slip = R"(
line = ["belt", "contact", "disc", "spring", "frame"]
[belt]
kind = "prescribed speed"
speed = "0.1 rad/s"
[contact]
kind = "clutch"
torque = "4 N*m"
static_torque = "6 N*m"
[disc]
kind = "flywheel"
inertia = "1 kg*m2"
[spring]
kind = "coupling"
stiffness = "100 N*m/rad"
[frame]
kind = "prescribed speed"
speed = "0 rad/s"
[effects]
elasticity = ["spring"]
[run]
start = { disc = { speed = "0.1 rad/s" } }
until = "8.2 s"
samples = 8201
accuracy = 1e-11
)";

TEST(FrictionOscillator, SticksAndSlipsWithThePeriodOfTheClosedForm) {
  const Validation is(Against::closed_form, "Stick–slip on a belt: spring, static and kinetic friction (case el03)");
  const Result r = run(stick_slip);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  std::vector<double> locks, slips;
  for (const Event& e : r.events) (e.what == "locks" ? locks : slips).push_back(e.t);
  ASSERT_GE(locks.size(), 9u);
  ASSERT_GE(slips.size(), 10u);
  is.near("end of the first sticking", "s", slips[0], 0.6, 1e-10);  // from x = 0 to 0.06 at the speed of the belt
  for (std::size_t k = 0; k < 9; ++k) {
    EXPECT_NEAR(locks[k] - slips[k], 0.40688878715914056, 1e-8) << k;
    EXPECT_NEAR(slips[k + 1] - locks[k], 0.4, 1e-8) << k;
  }
  is.near("nine periods, first to last slip", "s", slips[9] - slips[0], 9 * 0.8068887871591406, 1e-8);
  const auto speed = test::series(r, "speed.disc");
  is.near("least speed of the disc", "rad/s", *std::min_element(speed.begin(), speed.end()), -0.223606797749979,
          1e-5);  // of samples
  is.near("greatest torque of the spring", "N·m", 1, r.find("peak_spring_torque.spring"), 6.23606797749979,
          1e-8);  // k x_max
}

// J = 0.02 kg·m², k = 8 N·m/rad, dry friction 0.4 N·m, released at 0.53 rad: each half-swing loses 2 M_f/k = 0.1 rad.
TEST(FrictionOscillator, PendulumLosesTheSameEachOscillationAndStopsOffTheMiddle) {
  const Validation is(Against::closed_form, "Torsional pendulum with dry friction (case el03)");
  const Result r = run(R"(
line = ["pendulum", "spring", "frame"]
[pendulum]
kind = "flywheel"
inertia = "0.02 kg*m2"
[bearing]
kind = "bearing"
on = "pendulum"
torque = "0.4 N*m"
[spring]
kind = "coupling"
stiffness = "8 N*m/rad"
[frame]
kind = "prescribed speed"
speed = "0 rad/s"
[effects]
elasticity = ["spring"]
[run]
start = { spring = { twist = "0.53 rad" } }
until = "10 s"
accuracy = 1e-11
samples = 10001
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double half = 0.15707963267948966;
  std::size_t turns = 0;
  for (const Event& e : r.events) {
    if (e.what.find("comes to rest") == std::string::npos) {
      ++turns;
      EXPECT_NEAR(e.t, static_cast<double>(turns) * half, 1e-10);
    } else {
      EXPECT_NEAR(e.t, 0.7853981633974483, 1e-10);
    }
  }
  EXPECT_EQ(turns, 4u);
  const auto twist = test::series(r, "twist.spring");
  is.near("twist where it stops", "rad", twist.back(), -0.03, 1e-10);
  EXPECT_EQ(figure(r, "final_speed.pendulum"), 0);
  is.near("energy lost", "J", r.energy.by_line.at("harmful"), -0.5 * 8 * (0.53 * 0.53 - 0.03 * 0.03), 1e-9);
}

}  // namespace
}  // namespace kurbel::friction_oscillators_test
