// dc_circuits_test.cpp — DC motors with their circuits: closed forms, Dubey's braking, switching, energy, runaway.
#include "drivetrain/motors/dc_circuits.h"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <random>

#include "engine/matrices/linear_algebra.h"
#include "tests/published/published.h"
#include "tests/support/elements.h"
#include "tests/support/validation.h"

namespace kurbel::dc_circuits_test {
namespace {

using test::Against;
using test::figure;
using test::run;
using test::Validation;

// U = 220 V, R = 0.5 Ω, k = 1.8 N·m/A, J = 2 kg·m²
std::string shunt(double inductance, const std::string& more = "", const std::string& rest = "") {
  return fmt::format(R"(
line = ["motor"]
[motor]
kind = "dc shunt motor"
voltage = "220 V"
resistance = "0.5 Ohm"
constant = "1.8 N*m/A"
inductance = "{} H"
inertia = "2 kg*m2"
{}
{})",
                     inductance, more, rest);
}

// From rest against a constant load: J ω̈ + … gives λ² + (R/L) λ + k²/(J L) = 0; ω = ω∞ + Σ c e^{λt} with
// ω(0) = 0, J ω̇(0) = −M_L. Overdamped and oscillating.
TEST(DcShuntCircuit, StartFollowsTheClosedForm) {
  for (const double inductance : {0.002, 0.05, 0.5}) {
    const double load = 60, r = 0.5, k = 1.8, inertia = 2, w_inf = (220 - r * load / k) / k;
    const std::complex<double> half = r / inductance / 2,
                               root = std::sqrt(half * half - k * k / (inertia * inductance));
    const std::complex<double> a = -half + root, b = -half - root;
    // c_a + c_b = −ω∞, a c_a + b c_b = −M_L/J
    const std::complex<double> ca = (-load / inertia + b * w_inf) / (a - b), cb = -w_inf - ca;
    const Result result = run(shunt(inductance, "",
                                    "[weight]\nkind = \"load\"\non = \"motor\"\ntorque = \"60 N*m\"\nacts = "
                                    "\"always\"\n[run]\nuntil = \"2 s\"\naccuracy = 1e-10\nsamples = 201\n"));
    ASSERT_TRUE(result.complete) << result.diagnosis;
    const auto speed = test::series(result, "speed.motor"), current = test::series(result, "current.motor");
    for (std::size_t row = 0; row < speed.size(); ++row) {
      const double t = result.trajectory->time()[row];
      const std::complex<double> ea = ca * std::exp(a * t), eb = cb * std::exp(b * t);
      EXPECT_NEAR(speed[row], w_inf + (ea + eb).real(), 1e-8) << inductance << " H at " << t << " s";
      EXPECT_NEAR(current[row], (load + inertia * (a * ea + b * eb).real()) / k, 1e-7);
    }
    EXPECT_LT(std::abs(result.energy.relative), 1e-9);
  }
}

// Dubey, Fundamentals of Electrical Drives, example 5.9 (tests/cases/mo02_closed_forms.toml): a motor at 1050 rpm is
// braked over 0.538 Ω beside its own 0.08 Ω (the case's eigenvalues belong to the sum of both) while its load goes on.
const std::string dubey_5_9 = R"(
line = ["motor", "load"]
[motor]
kind = "dc shunt motor"
voltage = "220 V"
resistance = "0.08 Ohm"
braking_resistance = "0.538 Ohm"
constant = "1.9671550966 N*m/A"
inductance = "0.12 H"
initial_current = "0 A"
inertia = "8 kg*m2"
[load]
kind = "load"
torque = "51.637821286 N*m"
[sequence]
steps = [{ at = "0 s", set = "motor", to = 0 }]
[run]
start = { speed = "109.955742876 rad/s" }
until = "4 s"
accuracy = 1e-10
)";

TEST(DcShuntCircuit, DynamicBrakingIsThatOfDubey) {
  const Validation is(Against::published, "Dubey: Fundamentals of Electrical Drives, ex. 5.9 (dynamic braking)");
  const Eigen::VectorXcd lambda = eigenvalues(test::state_matrix(dubey_5_9));
  std::vector<double> found;
  for (const auto& l : lambda)
    if (std::abs(l) > 1e-9) found.push_back(l.real());
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), 2u);
  is.near("faster eigenvalue", "1/s", found[0], -4.1873549114, 1e-9);
  is.near("slower eigenvalue", "1/s", found[1], -0.9626450886, 1e-9);
  const Result r = run(dubey_5_9);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const Figure* peak = r.find("peak_current.motor");
  ASSERT_NE(peak, nullptr);
  is.near("greatest braking current", "A", 1, peak, -272.2293976, 1e-7);
  // With i = M_L/K + A e^{at} + B e^{bt}; the case's 0.4418569 s was read off samples.
  const double a = found[1], b = found[0], rest = 51.637821286 / 1.9671550966,
               slope = -1.9671550966 * 109.955742876 / 0.12;
  const double amplitude_a = (slope + rest * b) / (a - b), amplitude_b = -rest - amplitude_a;
  EXPECT_NEAR(*peak->at, std::log(-amplitude_b * b / (amplitude_a * a)) / (a - b), 1e-9);
  EXPECT_NEAR(*peak->at, 0.4418569, 3e-6);
  ASSERT_EQ(r.events.size(), 1u);
  EXPECT_EQ(r.events[0].what, "comes to rest and is held");
  EXPECT_NEAR(r.events[0].t, 3.0236216126, 1e-9);
}

// Switched off the current ceases at once and the machine runs on; switched on again it begins with none.
TEST(DcShuntCircuit, OpensWithoutCurrentAndClosesWithNone) {
  const Result r = run(shunt(0.05, "start = \"0.1 s\"\nstop = \"1.5 s\"",
                             "[sequence]\nsteps = [{ at = \"0.5 s\", set = \"motor\", to = 0 }, { at = \"1 s\", set = "
                             "\"motor\" }]\n[run]\nuntil = \"2 s\"\nsamples = 2001\naccuracy = 1e-9\n"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto speed = test::series(r, "speed.motor"), current = test::series(r, "current.motor"),
             torque = test::series(r, "torque.motor");
  for (std::size_t row = 0; row < speed.size(); ++row) {
    const double t = r.trajectory->time()[row];
    if (t < 0.1 || (t > 0.5 && t < 1) || t > 1.5) {
      EXPECT_EQ(current[row], 0) << t;
      EXPECT_EQ(torque[row], 0) << t;
      if (t > 0.5 && t < 1) {
        EXPECT_EQ(speed[row], speed[501]);
      }
    } else if ((t > 0.11 && t < 0.2) || (t > 1.01 && t < 1.05)) {
      EXPECT_GT(current[row], 0.1) << t;
    }
  }
  std::vector<std::string> said;
  for (const Event& e : r.events) said.push_back(fmt::format("{:g} {} {}", e.t, e.what, e.from));
  EXPECT_EQ(said, (std::vector<std::string>{"0.1 on off", "0.5 is set off on", "1 is set on off", "1.5 off on"}));
}

// At the start: current of the static line for a machine that turns, none for one at rest, or as given.
TEST(DcShuntCircuit, BeginsWithTheCurrentOfItsStaticLine) {
  const auto first = [](const std::string& more, const std::string& speed) {
    const Result r = run(shunt(0.05, more, "[run]\nstart = { speed = \"" + speed + "\" }\nuntil = \"1 ms\"\n"), false);
    return test::series(r, "current.motor").front();
  };
  EXPECT_EQ(first("", "0 rad/s"), 0);
  EXPECT_NEAR(first("", "100 rad/s"), (220 - 1.8 * 100) / 0.5, 1e-12);
  EXPECT_EQ(first("initial_current = \"7 A\"", "100 rad/s"), 7);
  EXPECT_EQ(first("start = \"1 s\"", "100 rad/s"), 0);  // not yet on
}

// U i = R i² + d(½ L i²)/dt + M ω, at any state, command and mode; likewise |c| U i of the series motor.
TEST(DcCircuits, ElectricalPowerIsHeatFieldAndShaft) {
  std::mt19937 random(7);
  const auto some = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  for (int i = 0; i < 300; ++i) {
    const double u = some(10, 500), r = some(0.01, 5), k = some(0.1, 5), l = some(1e-4, 1), current = some(-500, 500);
    const DcShuntCircuit shunt{{u, r, k, 0, {some(0.1, 2)}}, l, {}};
    ShaftState<double> x{0, 0, some(-200, 200), i % 2, 1, some(-1, 1), &current};
    double rate = 0;
    shunt.rates(x, &rate);
    const double resistance = r + shunt.line.brake.added(x.mode), power = x.command * u * current;
    EXPECT_NEAR(power, resistance * current * current + l * current * rate + shunt.torque(x) * x.rate,
                1e-11 * (std::abs(power) + resistance * current * current + std::abs(shunt.torque(x) * x.rate)));
    const DcSeriesCircuit series{{u, r, k / 100, 1e3, "m"}, l, {}};
    x.mode = x.command < 0 ? 1 : 0;
    series.rates(x, &rate);
    const double fed = std::abs(x.command) * u * current;
    EXPECT_NEAR(fed, r * current * current + l * current * rate + series.torque(x) * x.rate,
                1e-11 * (std::abs(fed) + r * current * current + std::abs(series.torque(x) * x.rate)));
  }
}

std::string series(const std::string& more = "", const std::string& rest = "") {
  return R"(
line = ["motor"]
[motor]
kind = "dc series motor"
voltage = "100 V"
resistance = "1.06 Ohm"
constant = "0.006366197723675813 N*m/A2"
inductance = "0.08 H"
inertia = "0.3 kg*m2"
)" + more +
         "\n" + rest;
}

// At a given speed the circuit is linear: i = U/(R + κ ω) (1 − e^{−(R + κ ω) t/L}); its end is the static law.
TEST(DcSeriesCircuit, CurrentAtConstantSpeedFollowsTheClosedForm) {
  for (const double omega : {-100.0, 0.0, 80.0, 300.0}) {
    const Result r = run(series("initial_current = \"0 A\"",
                                fmt::format("[drum]\nkind = \"prescribed speed\"\non = \"motor\"\nspeed = \"{} "
                                            "rad/s\"\n[run]\nuntil = \"4 s\"\nsamples = 201\naccuracy = 1e-10\n",
                                            omega)));
    ASSERT_TRUE(r.complete) << r.diagnosis;
    const double total = 1.06 + 0.006366197723675813 * omega;
    const auto current = test::series(r, "current.motor"), torque = test::series(r, "torque.motor");
    for (std::size_t row = 0; row < current.size(); ++row) {
      const double i = 100 / total * (1 - std::exp(-total * r.trajectory->time()[row] / 0.08));
      EXPECT_NEAR(current[row], i, 1e-7);
      EXPECT_NEAR(torque[row], 0.006366197723675813 * i * i, 1e-7);
    }
    const DcSeriesMotor line{100, 1.06, 0.006366197723675813, 1e4, "m"};
    if (omega > line.least_speed()) {
      EXPECT_NEAR(torque.back(), line.torque(ShaftState<double>{0, 0, omega, 0, 1}), 1e-6);
    }
  }
}

// The slower the machine against L/R, the nearer the static law: the run-up differs by a delay of order L/R.
TEST(DcSeriesCircuit, ApproachesTheStaticLawAsTheInductanceVanishes) {
  const auto speed = [](const std::string& inductance) {
    std::string text = series("", "[run]\nuntil = \"5 s\"\naccuracy = 1e-10\n");
    text = test::with(text, "inductance = \"0.08 H\"", inductance);
    return figure(run(text, false), "final_speed.motor");
  };
  const double fixed = speed("");
  EXPECT_NEAR(fixed, 269.97566298, 1e-7);  // tests/cases/mo02_closed_forms.toml, series_start
  const double far = speed("inductance = \"10 mH\"") - fixed, near = speed("inductance = \"1 mH\"") - fixed;
  EXPECT_LT(far, 0);
  EXPECT_NEAR(near / far, 0.1, 0.002);
}

TEST(DcSeriesCircuit, RunsAwayAndDrivenBackwardsExcitesItselfInWords) {
  const Result away = run(series("max_speed = \"200 rad/s\"", "[run]\nuntil = \"1000 s\"\n"));
  EXPECT_FALSE(away.complete);
  ASSERT_EQ(away.events.size(), 1u);
  EXPECT_EQ(away.events[0].what, "ran away: passed its max_speed");
  EXPECT_NE(away.diagnosis.find("series motor \"motor\" ran away"), std::string::npos) << away.diagnosis;
  // Beyond −R/κ = −166.5 rad/s the current grows as e^{(κ|ω| − R) t/L}.
  const Result back = run(series("",
                                 "[drum]\nkind = \"prescribed speed\"\non = \"motor\"\nspeed = \"-300 "
                                 "rad/s\"\n[run]\nuntil = \"10 s\"\n"));
  EXPECT_FALSE(back.complete);
  EXPECT_NE(back.diagnosis.find("excites itself"), std::string::npos) << back.diagnosis;
  const double growth = (0.006366197723675813 * 300 - 1.06) / 0.08, stall = 100 / 1.06;
  const double t = std::log(1 + 50 * stall * growth * 0.08 / 100) / growth;  // i = U/(L g) (e^{g t} − 1) = 50 U/R
  EXPECT_NE(back.diagnosis.find(fmt::format("t = {:.5g}", t)), std::string::npos) << back.diagnosis << t;
}

// A reversed armature reverses the torque, with the same current: the mirror image of the start forwards.
TEST(DcSeriesCircuit, ReversedItStartsBackwards) {
  for (const char* inductance : {"inductance = \"0.08 H\"", ""}) {
    const std::string text = test::with(
        series("", "[sequence]\nsteps = [{ at = \"0 s\", set = \"motor\", to = TO }]\n[run]\nuntil = \"3 s\"\n"),
        "inductance = \"0.08 H\"", inductance);
    const double forwards = figure(run(test::with(text, "TO", "1"), false), "final_speed.motor");
    const double backwards = figure(run(test::with(text, "TO", "-1"), false), "final_speed.motor");
    EXPECT_GT(forwards, 50);
    EXPECT_NEAR(backwards, -forwards, 1e-9 * forwards);
  }
}

TEST(DcCircuits, JacobianEqualsDifferencesInEveryMode) {
  for (const char* to : {"1", "0.4", "0", "-1"}) {
    const std::string sequence = fmt::format(
        "[sequence]\nsteps = [{{ at = \"0 s\", set = \"motor\", to = {} }}]\n[run]\nstart = {{ speed = "
        "\"60 rad/s\" }}\n",
        to);
    test::expect_exact_jacobian_near_start(shunt(0.05, "braking_resistance = \"2 Ohm\"", sequence), {3, -20});
    test::expect_exact_jacobian_near_start(shunt(0.05, "", sequence), {3, -20});
    test::expect_exact_jacobian_near_start(series("", sequence), {3, -20});
  }
}

TEST(DcCircuits, WithoutTransientsTheyAreTheirStaticLines) {
  const std::string end = "[run]\nuntil = \"1 s\"\n";
  for (const std::string more : {"", "braking_resistance = \"0.7 Ohm\""})
    test::expect_same_machine(shunt(0.05, more, "[effects]\ntransients = false\n" + end),
                              test::with(shunt(0.05, more, end), "inductance = \"0.05 H\"", ""));
  test::expect_same_machine(series("", "[effects]\ntransients = false\n" + end),
                            test::with(series("", end), "inductance = \"0.08 H\"", ""));
}

// Braking and plugging over a resistance, by a ramp that passes zero: the modes change there, once each way.
TEST(DcShuntCircuit, RampThroughZeroPassesItsModesAsEvents) {
  for (const char* inductance : {"inductance = \"0.05 H\"", ""}) {
    const Result r = run(test::with(
        shunt(0.05, "braking_resistance = \"0.7 Ohm\"",
              "[sequence]\nsteps = [{ at = \"1 s\", set = \"motor\", to = -1, over = \"1 s\" }, { at = \"2.5 s\", set "
              "= \"motor\", to = 1, over = \"0.5 s\" }]\n[run]\nuntil = \"4 s\"\n"),
        "inductance = \"0.05 H\"", inductance));
    ASSERT_TRUE(r.complete) << r.diagnosis;
    std::vector<std::pair<double, std::string>> modes;
    for (const Event& e : r.events)
      if (e.what.find("resistance") != std::string::npos) modes.emplace_back(e.t, e.what);
    ASSERT_EQ(modes.size(), 2u);
    EXPECT_NEAR(modes[0].first, 1.5, 1e-8);
    EXPECT_EQ(modes[0].second, "over its braking resistance");
    EXPECT_NEAR(modes[1].first, 2.75, 1e-8);
    EXPECT_EQ(modes[1].second, "without braking resistance");
  }
}

}  // namespace
}  // namespace kurbel::dc_circuits_test
