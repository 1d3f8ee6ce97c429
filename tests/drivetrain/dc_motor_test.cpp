// dc_motor_test.cpp — DC series motor: its law, what becomes of it without a load and driven backwards.
#include <fmt/format.h>

#include <cmath>

#include "drivetrain/motors/dc_series_motor.h"
#include "tests/support/scenes.h"

namespace kurbel::dc_motor_test {
namespace {

using test::figure;
using test::run;

const std::string motor = R"(
line = ["motor"]
[motor]
kind = "dc series motor"
voltage = "100 V"
resistance = "1 Ohm"
constant = "0.01 N*m/A2"
inertia = "0.3 kg*m2"
)";

// M = κ i² with U = (R + κ ω) i: the current found from the circuit.
TEST(DcSeriesMotor, TorqueIsThatOfItsCircuit) {
  const DcSeriesMotor m{220, 0.8, 0.02, 1e3, "m"};
  for (const double omega : {-19.0, 0.0, 10.0, 40.0, 200.0}) {
    const double current = 220 / (0.8 + 0.02 * omega);
    EXPECT_NEAR(m.torque(ShaftState<double>{0, 0, omega, 0, 1}), 0.02 * current * current, 1e-12 * m.stall_torque());
  }
  EXPECT_NEAR(m.torque(ShaftState<double>{0, 0, m.base_speed(), 0, 1}), m.stall_torque() / 4, 1e-12);
}

// Without a load the time to a speed ω is J ((R + κ ω)³ − R³)/(3 κ² U²): the motor runs away then, and says so.
TEST(DcSeriesMotor, RunsAwayWithoutALoadAtTheTimeOfTheClosedForm) {
  const struct {
    const char* key;
    double speed, inertia;
  } cases[] = {{"", 1e4, 3e-6}, {"max_speed = \"300 rad/s\"\n", 300, 0.3}, {"rated_speed = \"50 rad/s\"\n", 250, 0.3}};
  for (const auto& [key, speed, inertia] : cases) {
    std::string own = motor;
    own.replace(own.find("0.3 kg"), 3, fmt::format("{}", inertia));
    const Result r = run(own + key + "[run]\nuntil = \"100 s\"\naccuracy = 1e-9\n");
    const double t = inertia * (std::pow(1 + 0.01 * speed, 3) - 1) / (3 * 1e-4 * 1e4);
    EXPECT_FALSE(r.complete);
    ASSERT_EQ(r.events.size(), 1u);
    EXPECT_EQ(r.events[0].component, "motor");
    EXPECT_EQ(r.events[0].what, "ran away: passed its max_speed");
    EXPECT_NEAR(r.events[0].t, t, 1e-9 * t);
    EXPECT_NE(r.diagnosis.find("series motor \"motor\" ran away"), std::string::npos) << r.diagnosis;
    EXPECT_GE(figure(r, "final_speed.motor"), speed);  // ends within the step after the event, a quarter turn at most
    EXPECT_LE(figure(r, "final_speed.motor"), 1.01 * speed);
  }
}

// With a load that grows it settles, M(ω) = b ω, and nothing is said.
TEST(DcSeriesMotor, SettlesUnderALoad) {
  const Result r = run(motor +
                       "[fan]\nkind = \"load\"\non = \"motor\"\ndamping = \"0.1 N*m*s/rad\"\n[run]\nuntil = \"60 "
                       "s\"\naccuracy = 1e-9\n");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double omega = figure(r, "final_speed.motor");
  EXPECT_NEAR(100 / std::pow(1 + 0.01 * omega, 2), 0.1 * omega, 1e-8 * 0.1 * omega);
}

// A weight that overhauls it drives it backwards to half of −R/κ: the run ends in words before the current's pole.
TEST(DcSeriesMotor, DrivenBackwardsEndsInWordsBeforeThePole) {
  const Result r =
      run(motor +
          "[weight]\nkind = \"load\"\non = \"motor\"\ntorque = \"2000 N*m\"\nacts = \"always\"\n[run]\nuntil = "
          "\"10 s\"\naccuracy = 1e-9\n");
  EXPECT_FALSE(r.complete);
  EXPECT_NE(r.diagnosis.find("driven backwards"), std::string::npos) << r.diagnosis;
  EXPECT_NEAR(figure(r, "final_speed.motor"), -50, 1e-7);
  // ∫ J dω/(M − 2000) down to −50 rad/s, by Simpson's rule.
  const int n = 2000;
  double t = 0;
  for (int i = 0; i <= n; ++i) {
    const double omega = -50.0 * i / n, weight = i == 0 || i == n ? 1 : i % 2 ? 4 : 2;
    t += weight * 0.3 / (2000 - 100 / std::pow(1 + 0.01 * omega, 2)) * 50 / n / 3;
  }
  EXPECT_NE(r.diagnosis.find(fmt::format("t = {:.6g}", t).substr(0, 10)), std::string::npos) << r.diagnosis << t;
}

}  // namespace
}  // namespace kurbel::dc_motor_test
