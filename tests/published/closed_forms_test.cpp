// closed_forms_test.cpp — starts and run-downs in closed form (tests/cases/mo02_closed_forms.toml).
#include <fmt/format.h>

#include "tests/published/published.h"
#include "tests/support/validation.h"

namespace kurbel::closed_forms_test {
namespace {

using test::Against;
using test::figure;
using test::run;
using test::Validation;

// --- run-down: J = 2 kg·m² from 100 rad/s ---

struct RunDown {
  const char* name;
  double viscous, quadratic, time, angle;
};
class RunDownOfAFlywheel : public ::testing::TestWithParam<RunDown> {};

TEST_P(RunDownOfAFlywheel, StopsAtTheTimeAndAngleOfTheClosedForm) {
  const Validation is(Against::closed_form,
                      "Run-down of a flywheel from 100 rad/s by dry, viscous and fan resistance (case mo02)");
  const RunDown& given = GetParam();
  const Result r = run(fmt::format(R"(
line = ["wheel"]
[wheel]
kind = "load"
torque = "5 N*m"
damping = "{} N*m*s/rad"
quadratic = "{} N*m*s2/rad2"
inertia = "2 kg*m2"
[run]
start = {{ speed = "100 rad/s" }}
until = "60 s"
accuracy = 1e-10
)",
                                   given.viscous, given.quadratic));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_EQ(r.events.size(), 1u);
  EXPECT_EQ(r.events[0].what, "comes to rest and is held");
  is.close(fmt::format("{}: time to standstill", given.name), "s", r.events[0].t, given.time, 1e-10);
  is.near(fmt::format("{}: angle turned", given.name), "rad", 1, r.find("final_angle.wheel"), given.angle,
          1e-11 * given.angle);
  EXPECT_EQ(figure(r, "final_speed.wheel"), 0);
  EXPECT_NEAR(r.energy.by_line.at("useful"), -0.5 * 2 * 100 * 100, 1e-5);  // all of ½ J ω₀²
}

INSTANTIATE_TEST_SUITE_P(
    Against, RunDownOfAFlywheel,
    ::testing::Values(RunDown{"DryFriction", 0, 0, 40.0, 2000.0},                           // t = J ω₀/M
                      RunDown{"DryAndViscous", 0.05, 0, 27.725887222398, 1227.4112777602},  // t = J/b ln(1 + b ω₀/M)
                      RunDown{"DryAndFan", 0, 0.002, 22.142974355882, 804.7189562171}),  // t = J/√(M k) atan(ω₀ √(k/M))
    [](const auto& info) { return info.param.name; });

// --- starts ---

// Armature at 100 V, k = 0.6366 V·s, R = 0.05 Ω against 30 N·m: ω = ω∞ (1 − e^{−t/τ}), τ = J R/k².
TEST(MotorStart, ShuntMotorApproachesItsSpeedExponentially) {
  const Validation is(Against::closed_form, "Start of a DC shunt motor under load: ω = ω∞ (1 − e^{−t/τ}) (case mo02)");
  const double tau = 0.03701101650408509, w_inf = 153.37853102908, w_at_tau = 96.953722746406;
  const Result r = run(fmt::format(R"(
line = ["motor", "hoist"]
[motor]
kind = "dc shunt motor"
voltage = "100 V"
resistance = "0.05 Ohm"
constant = "0.6366197723675814 N*m/A"
inertia = "0.3 kg*m2"
[hoist]
kind = "load"
torque = "30 N*m"
acts = "always"
[run]
until = "{} s"
samples = 101
accuracy = 1e-10
)",
                                   10 * tau));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto omega = test::series(r, "speed.motor");
  is.near("speed after one time constant", "rad/s", omega[10], w_at_tau, 1e-8);
  for (std::size_t row = 0; row < omega.size(); ++row)
    EXPECT_NEAR(omega[row], w_inf * (1 - std::exp(-r.trajectory->time()[row] / tau)), 1e-8);
}

// Constant torque against a fan: ω = ω∞ tanh(t √(M k)/J).
TEST(MotorStart, FanApproachesItsSpeedAsAHyperbolicTangent) {
  const Validation is(Against::closed_form, "Start of a fan by a constant torque: ω = ω∞ tanh(t √(M k)/J) (case mo02)");
  const double w_inf = 35.35533905932738, t_95 = 2.5905292832732227;
  const Result r = run(fmt::format(R"(
line = ["source", "fan"]
[source]
kind = "torque source"
torque = "50 N*m"
[fan]
kind = "load"
quadratic = "0.04 N*m*s2/rad2"
inertia = "2 kg*m2"
[run]
until = "{} s"
samples = 101
accuracy = 1e-10
)",
                                   2 * t_95));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto omega = test::series(r, "speed.fan");
  is.near("speed where 95 % are due", "rad/s", omega[50], 0.95 * w_inf, 1e-8);
  for (std::size_t row = 0; row < omega.size(); ++row)
    EXPECT_NEAR(omega[row], w_inf * std::tanh(r.trajectory->time()[row] * std::sqrt(50 * 0.04) / 2), 1e-8);
}

// A DC series motor, M = κ U²/(R + κ ω)², without a load: ω = ((R³ + 3 κ² U² t/J)^⅓ − R)/κ.
TEST(MotorStart, SeriesMotorFollowsItsClosedForm) {
  const Validation is(Against::closed_form,
                      "Start of a DC series motor without load: ω = ((R³ + 3 κ² U² t/J)^⅓ − R)/κ (case mo02)");
  const double c = 0.006366197723675813, resistance = 1.06, voltage = 100, j = 0.3;
  const Result r = run(R"(
line = ["motor"]
[motor]
kind = "dc series motor"
voltage = "100 V"
resistance = "1.06 Ohm"
constant = "0.006366197723675813 N*m/A2"
inertia = "0.3 kg*m2"
[run]
until = "5 s"
samples = 11
accuracy = 1e-10
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto omega = test::series(r, "speed.motor");
  const struct {
    std::size_t row;
    double omega;
  } expected[] = {{1, 65.38985776}, {2, 106.39567097}, {4, 163.78626679}, {10, 269.97566298}};
  for (const auto& e : expected) {
    const double t = 0.5 * static_cast<double>(e.row);
    const double closed = (std::cbrt(std::pow(resistance, 3) + 3 * c * c * voltage * voltage * t / j) - resistance) / c;
    EXPECT_NEAR(closed, e.omega, 1e-8);
    is.close(fmt::format("speed at {} s", t), "rad/s", omega[e.row], closed, 1e-9);
  }
}

// The same motor by table (the characteristic "given graphically"): a smooth curve through 201 points.
TEST(MotorStart, SeriesMotorByTableFollowsItsLaw) {
  const double c = 0.006366197723675813, resistance = 1.06, voltage = 100;
  std::string points;
  for (int i = 0; i <= 200; ++i) {
    const double w = 1.5 * i;
    points += fmt::format("{}[{}, {}]", i ? ", " : "", w, c * voltage * voltage / std::pow(resistance + c * w, 2));
  }
  const Result r = run(fmt::format(R"(
line = ["motor"]
[motor]
kind = "motor"
torque = {{ over = "speed", unit = ["rad/s", "N*m"], interpolation = "smooth", points = [{}] }}
inertia = "0.3 kg*m2"
[run]
until = "5 s"
samples = 11
accuracy = 1e-8
)",
                                   points));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto omega = test::series(r, "speed.motor");
  const struct {
    std::size_t row;
    double omega;
  } expected[] = {{1, 65.38985776}, {2, 106.39567097}, {4, 163.78626679}, {10, 269.97566298}};
  for (const auto& e : expected) EXPECT_NEAR(omega[e.row], e.omega, 2e-5);
}

// Dubey, Fundamentals of Electrical Drives, ex. 2.2: reversal. M = −100 − 0.1 N [N·m, rpm] against 0.05 N; J = 10
// kg·m². N = −100/0.15 + (N₀ + 100/0.15) e^{−t/T}; to 95 % of the final speed with N₀ = 666.67 rpm.
TEST(MotorStart, ReversalOfALinearMotorTakesTheTimeOfTheClosedForm) {
  const Validation is(Against::published,
                      "Dubey: Fundamentals of Electrical Drives, ex. 2.2 (reversal; the book prints 25.51 s, its own "
                      "data give 25.753 s)");
  const Result r = run(R"(
line = ["motor", "load"]
[motor]
kind = "motor"
torque = { over = "speed", unit = ["rpm", "N*m"], points = [[-1000, 0], [1000, -200]] }
inertia = "10 kg*m2"
[load]
kind = "load"
damping = "0.47746482927568600731 N*m*s/rad"    # 0.05 N·m/rpm
[run]
start = { speed = "666.66666666666667 rpm" }
until = "25.75323687 s"
accuracy = 1e-10
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  is.near("speed after 25.753 s, one characteristic", "rpm", figure(r, "final_speed.motor") * 60 / test::two_pi,
          -0.95 * 666.66666666666667, 1e-6);
}

// The same drive as two motors with windows of time: M = 100 − 0.1 N for 600 s, M = −100 − 0.1 N from then on. The
// steady speed is 666.67 rpm, and −95 % of it is reached 25.753 s after the reversal. (The book prints 25.51 s.)
TEST(MotorStart, ReversalByTwoCharacteristicsTakesTheTimeOfTheClosedForm) {
  const Validation is(Against::published,
                      "Dubey: Fundamentals of Electrical Drives, ex. 2.2 (reversal; the book prints 25.51 s, its own "
                      "data give 25.753 s)");
  const Result r = run(R"(
line = ["motor", "load"]
[motor]
kind = "motor"
torque = { over = "speed", unit = ["rpm", "N*m"], points = [[-1000, 200], [1000, 0]] }
stop = "600 s"
inertia = "10 kg*m2"
[reversed]
kind = "motor"
on = "motor"
torque = { over = "speed", unit = ["rpm", "N*m"], points = [[-1000, 0], [1000, -200]] }
start = "600 s"
inertia = "0 kg*m2"
[load]
kind = "load"
damping = "0.47746482927568600731 N*m*s/rad"    # 0.05 N·m/rpm
[run]
until = "625.75323687 s"
accuracy = 1e-10
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto omega = test::series(r, "speed.motor");
  is.near("steady speed before the reversal", "rpm", *std::max_element(omega.begin(), omega.end()) * 60 / test::two_pi,
          666.66666666666667, 1e-6);
  is.near("speed after 25.753 s, two characteristics", "rpm", figure(r, "final_speed.motor") * 60 / test::two_pi,
          -0.95 * 666.66666666666667, 1e-5);
}

// Dubey ex. 2.3: a flywheel of J = 1947.188 kg·m² lets the motor (500 N·m at 5 % droop from 500 rpm) rise from 200 to
// just 700 N·m during 10 s of 1000 N·m: M = M_h + (M_0 − M_h) e^{−t k/J}, k = 500 N·m/(25 rpm). (The book prints
// 1937.2.)
TEST(MotorStart, FlywheelKeepsAMotorWithDroopAtItsPermittedTorque) {
  const Validation is(Against::published,
                      "Dubey: Fundamentals of Electrical Drives, ex. 2.3 (flywheel; the book prints 1937.2 kg·m², its "
                      "own data give 1947.188)");
  const Result r = run(R"(
line = ["motor", "mill"]
[motor]
kind = "dc shunt motor"
stall_torque = "10 kN*m"
no_load_speed = "500 rpm"
inertia = "1947.188373 kg*m2"
[mill]
kind = "load"
torque = "1000 N*m"
[run]
start = { speed = "490 rpm" }    # 200 N·m
until = "10 s"
accuracy = 1e-10
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  is.close("torque of the motor after 10 s", "N·m",
           10e3 * (1 - figure(r, "final_speed.motor") * 60 / test::two_pi / 500), 700, 1e-7);
}

// --- gears ---

// Khurmi & Gupta, Theory of Machines, ex. 3.14: T = 100 N·m on I_A = 2 through G = 4 to I_B = 32: α_B = 6.25, α_A = 25.
TEST(GearedAcceleration, OfBothShaftsMatchesKhurmi) {
  const Validation is(Against::published, "Khurmi, Gupta: Theory of Machines, ch. 3 (kinetics of motion), ex. 14");
  const Result r = run(R"(
line = ["a", "gear", "b"]
[a]
kind = "torque source"
torque = "100 N*m"
inertia = "2 kg*m2"
[gear]
kind = "gearbox"
stages = [{ teeth = [20, 80] }]
[b]
kind = "inertia"
inertia = "32 kg*m2"
[run]
until = "2 s"
accuracy = 1e-10
)");
  is.near("speed of the driven shaft after 2 s", "rad/s", 1, r.find("final_speed.b"), 6.25 * 2, 1e-11);
  is.near("speed of the driving shaft after 2 s", "rad/s", 1, r.find("final_speed.a"), 25.0 * 2, 1e-11);
  is.near("angle of the driven shaft after 2 s", "rad", 1, r.find("final_angle.b"), 0.5 * 6.25 * 4, 1e-11);
}

// Torque through a pair of gears of ratio z₂/z₁ onto an inertia, from rest: its acceleration [rad/s²].
double geared_acceleration(int z1, int z2, double torque, double ia, double ib, double load) {
  const Result r = run(fmt::format(R"(
line = ["a", "gear", "b"]
a = {{ kind = "torque source", torque = "{} N*m", inertia = "{} kg*m2" }}
gear = {{ kind = "gearbox", stages = [{{ teeth = [{}, {}] }}] }}
b = {{ kind = "load", torque = "{} N*m", acts = "always", inertia = "{} kg*m2" }}
[run]
until = "1 s"
accuracy = 1e-12
)",
                                   torque, ia, z1, z2, load, ib));
  EXPECT_TRUE(r.complete) << r.diagnosis;
  return figure(r, "final_speed.b");
}

// The abscissa where the parabola through three points has its vertex.
double vertex(double x, double h, double below, double at, double above) {
  return x - h * (above - below) / (2 * (above - 2 * at + below));
}

// Ex. 3.14: G = √(I_B/I_A) = 4 accelerates the load most.
TEST(GearedAcceleration, IsGreatestAtKhurmisRatioOfFour) {
  const Validation is(Against::published, "Khurmi, Gupta: Theory of Machines, ch. 3 (kinetics of motion), ex. 14");
  const auto alpha = [](int z2) { return geared_acceleration(1000, z2, 100, 2, 32, 0); };
  is.close("acceleration at the ratio of 4", "rad/s²", alpha(4000), 6.25, 1e-7);
  is.near("ratio of the greatest acceleration", "", vertex(4, 0.02, alpha(3980), alpha(4000), alpha(4020)), 4, 1e-4);
}

// Ex. 3.17: with a load the best ratio is 13.0617 (the book's 13.235 is wrong).
TEST(GearedAcceleration, IsGreatestAtTheRatioOfTheClosedForm) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 3 (kinetics of motion), ex. 17 (the book prints 13.235; "
                      "its own formula gives 13.0617)");
  const auto alpha = [](int z2) { return geared_acceleration(1000, z2, 0.95 * 30, 0.95 * 0.6, 45, 100); };
  is.near("ratio of the greatest acceleration", "", vertex(13.06, 0.05, alpha(13010), alpha(13060), alpha(13110)),
          13.06172168, 2e-4);
}

// Ex. 3.13: 75 kg on a drum of r = 0.3 m with I_A = 100 drive I_B = 5 at six times the drum's speed:
// a = g m r²/(m r² + I_A + G² I_B); with η = 0.9 of the gears I_B counts 1/η times.
TEST(GearedAcceleration, OfAFallingMassMatchesKhurmi) {
  const Validation is(Against::published, "Khurmi, Gupta: Theory of Machines, ch. 3 (kinetics of motion), ex. 13");
  const auto acceleration = [](double efficiency) {
    const Result r = run(fmt::format(R"(
line = ["drum", "gear", "b"]
drum = {{ kind = "torque source", torque = "220.725 N*m", inertia = "106.75 kg*m2" }}    # m g r; I_A + m r²
gear = {{ kind = "gearbox", stages = [{{ teeth = [120, 20] }}] }}
b = {{ kind = "inertia", inertia = "{} kg*m2" }}
[run]
until = "1 s"
accuracy = 1e-10
)",
                                     5 / efficiency));
    return figure(r, "final_speed.drum") * 0.3;
  };
  is.near("acceleration of the mass, gears without loss", "m/s²", acceleration(1), 0.230924150, 1e-7 * 0.23);
  is.near("acceleration of the mass, efficiency 0.9", "m/s²", acceleration(0.9), 0.215867970, 1e-7 * 0.21);
}

// Dubey ex. 2.1: J₀ = 0.2 at 1420 rpm drives J₁ = 10 with 10 N·m at a tenth of the speed (η = 0.9) and hoists 1000 kg
// at 1.5 m/s (η = 0.85): J = 0.40175 kg·m², M = 117.530 N·m: M = ω₁ M₁/(ω η₁) + m g v/(ω η₂).
TEST(GearedAcceleration, ReducesAGearedLoadAndAHoistedMassLikeDubey) {
  const Validation is(Against::published,
                      "Dubey: Fundamentals of Electrical Drives, ex. 2.1 (equivalent inertia and torque)");
  const double radius = 1.5 / (0.1 * 1420 * test::two_pi / 60);  // of a drum that turns ten times slower, too
  const Result r = run(fmt::format(R"(
line = ["motor", "gear", "load"]
motor = {{ kind = "torque source", torque = "157.7055809741 N*m", inertia = "0.2 kg*m2" }}
gear = {{ kind = "gearbox", stages = [{{ teeth = [20, 200] }}] }}
load = {{ kind = "load", torque = "{0:.17g} N*m", inertia = "10 kg*m2" }}
drum = {{ kind = "load", torque = "{1:.17g} N*m", acts = "always", inertia = "{2:.17g} kg*m2" }}
hoist = {{ kind = "gearbox", stages = [{{ teeth = [20, 200] }}] }}
[[branch]]
from = "motor"
line = ["hoist", "drum"]
[run]
until = "1 s"
accuracy = 1e-10
)",
                                   10 / 0.9, 1000 * 9.81 * radius / 0.85, 1000 * radius * radius));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  // 40.1753321 N·m above what the loads take: 100 rad/s².
  is.near("speed of the motor after 1 s, 40.175 N·m above the loads", "rad/s", 1, r.find("final_speed.motor"), 100,
          1e-7 * 100);
}

// Ex. 3.17: motor I_A = 0.6, T_A = 30; load I_B = 45, T_B = 100; G = 9, η = 0.95. A steady efficiency lets η of torque
// and of inertia torque pass, so motor torque and rotor inertia count η times: I = 91.17, α = 1.716573, 60 rpm
// at 3.660307 s.
TEST(GearedAcceleration, TimeToSixtyRpmMatchesKhurmi) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 3 (kinetics of motion), ex. 17 (time to 60 rpm)");
  const Result r = run(R"(
line = ["motor", "gear", "machine"]
[motor]
kind = "torque source"
torque = "28.5 N*m"          # 0.95 · 30
inertia = "0.57 kg*m2"       # 0.95 · 0.6
[gear]
kind = "gearbox"
stages = [{ teeth = [20, 180] }]
[machine]
kind = "load"
torque = "100 N*m"
inertia = "45 kg*m2"
[run]
until = "3.660306738 s"
accuracy = 1e-10
)");
  is.near("speed of the machine after 3.660307 s", "rad/s", 1, r.find("final_speed.machine"), test::two_pi, 1e-8);
  is.near("acceleration of the machine", "rad/s²", figure(r, "final_speed.machine") / r.until, 1.716573434, 1e-8);
}

}  // namespace
}  // namespace kurbel::closed_forms_test
