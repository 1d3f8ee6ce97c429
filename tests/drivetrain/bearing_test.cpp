// bearing_test.cpp — bearing friction: its curve in all three models, sticking, presliding, energy, off.
#include "drivetrain/friction/bearing.h"

#include <fmt/format.h>

#include <cmath>

#include "tests/published/published.h"
#include "tests/support/elements.h"

namespace kurbel::bearing_test {
namespace {

using test::figure;
using test::run;

constexpr double kinetic = 4, breakaway = 6, stribeck = 2, viscous = 0.05;

// M(ω) of Stribeck with n = 2 (Armstrong-Hélouvry et al. 1994).
double curve(double omega) {
  const double part = std::exp(-std::pow(omega / stribeck, 2));
  return -std::copysign(kinetic + (breakaway - kinetic) * part, omega) - viscous * omega;
}

std::string bearing(const std::string& model, const std::string& rest) {
  return R"(
line = ["shaft"]
[shaft]
kind = "flywheel"
inertia = "0.5 kg*m2"
[bearing]
kind = "bearing"
on = "shaft"
torque = "4 N*m"
static_torque = "6 N*m"
stribeck_speed = "2 rad/s"
damping = "0.05 N*m*s/rad"
)" + model +
         "\n" + rest;
}
const std::string exact = "model = \"exact\"", creeping = "model = \"regularised\"\ncreep_speed = \"1e-4 rad/s\"",
                  bristles =
                      "model = \"LuGre\"\nbristle_stiffness = \"1000 N*m/rad\"\nbristle_damping = \"5 "
                      "N*m*s/rad\"";

TEST(Bearing, AllModelsHaveTheCurveOfStribeckAtConstantSpeed) {
  for (const std::string& model : {exact, creeping, bristles})
    for (const double omega : {-20.0, -2.0, -0.3, 0.01, 0.5, 3.0, 40.0}) {
      const Result r = run(bearing(model, fmt::format("[drive]\nkind = \"prescribed speed\"\non = \"shaft\"\nspeed = "
                                                      "\"{} rad/s\"\n[run]\nuntil = \"20 s\"\nsamples = 11\n",
                                                      omega)),
                           false);
      ASSERT_TRUE(r.complete) << r.diagnosis;
      EXPECT_NEAR(test::series(r, "torque.bearing").back(), curve(omega), 1e-9 * breakaway) << model << omega;
    }
}

// J ω̇ = −(M_c + b ω) stops at t = J/b ln(1 + b ω₀/M_c), and then holds.
TEST(Bearing, CoastsToRestAtTheTimeOfTheClosedForm) {
  const Result r = run(R"(
line = ["shaft"]
[shaft]
kind = "flywheel"
inertia = "0.5 kg*m2"
[bearing]
kind = "bearing"
on = "shaft"
torque = "4 N*m"
static_torque = "9 N*m"
damping = "0.05 N*m*s/rad"
[run]
start = { speed = "30 rad/s" }
until = "10 s"
accuracy = 1e-10
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_EQ(r.events.size(), 1u);
  EXPECT_EQ(r.events[0].what, "comes to rest and is held");
  EXPECT_NEAR(r.events[0].t, 0.5 / 0.05 * std::log(1 + 0.05 * 30 / 4), 1e-9);
  EXPECT_EQ(figure(r, "final_speed.shaft"), 0);
  EXPECT_NEAR(r.energy.by_line.at("harmful"), -0.5 * 0.5 * 900, 1e-7);
}

// A torque that rises slowly breaks it away at M_s, not before, and then it slips on less.
TEST(Bearing, BreaksAwayAtTheStaticTorque) {
  const Result r = run(bearing(exact,
                               "[push]\nkind = \"torque source\"\non = \"shaft\"\ntorque = \"12 N*m\"\nramp = \"24 "
                               "s\"\n[run]\nuntil = \"13 s\"\naccuracy = 1e-9\n"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_EQ(r.events.size(), 1u);
  EXPECT_NEAR(r.events[0].t, 12, 1e-9);
  EXPECT_GT(figure(r, "final_speed.shaft"), 0);
}

// Held for 10⁴ s against a torque below M_s: nothing moves, and it costs a handful of steps.
TEST(Bearing, StaysStuckForTenThousandSecondsWithoutStepsWasted) {
  const Result r = run(bearing(exact,
                               "[push]\nkind = \"torque source\"\non = \"shaft\"\ntorque = \"5.9 N*m\"\n[run]\nuntil = "
                               "\"10000 s\"\n"),
                       false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_EQ(figure(r, "final_angle.shaft"), 0);
  EXPECT_EQ(figure(r, "final_speed.shaft"), 0);
  EXPECT_LT(r.statistics.stepper.steps, 60);
}

// Under half of its static torque the regularised bearing creeps with ω_c atanh(½), which the explanation says.
TEST(Bearing, RegularisedCreepsAsFastAsItSays) {
  std::string text = bearing(creeping,
                             "[push]\nkind = \"torque source\"\non = \"shaft\"\ntorque = \"3 N*m\"\n[run]\nuntil = \"1 "
                             "s\"\naccuracy = 1e-9\n");
  text = test::with(text, "damping = \"0.05 N*m*s/rad\"\n", "");
  const Result r = run(text, false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double creep = 1e-4 * std::atanh(0.5);
  EXPECT_NEAR(figure(r, "final_speed.shaft"), creep, 1e-6 * creep);
  EXPECT_NE(r.explanation.find("5.49e-05 rad/s"), std::string::npos) << r.explanation;
}

// Presliding at constant speed with M_s = M_c: dz/dφ = 1 − σ₀ z/M_c, so M = −M_c (1 − e^{−σ₀ φ/M_c}) (Dahl): it begins
// with the stiffness σ₀ and ends at M_c.
TEST(Bearing, BristlesBendWithTheirStiffnessBeforeTheySlip) {
  const Result r = run(R"(
line = ["shaft"]
[shaft]
kind = "prescribed speed"
speed = "0.01 rad/s"
[bearing]
kind = "bearing"
on = "shaft"
torque = "4 N*m"
model = "LuGre"
bristle_stiffness = "1000 N*m/rad"
[run]
until = "4 s"
samples = 401
accuracy = 1e-9
)",
                       false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto torque = test::series(r, "torque.bearing");
  const double steady = torque.front();  // begins as in steady sliding
  EXPECT_NEAR(steady, -4, 1e-12);
  const BristleBearing b{{4, 4, 1, 2, 0}, 1000, 0};
  // From straight bristles, by the same equations: Runge–Kutta of order 4 with 4000 steps.
  double z = 0;
  const double h = 1e-3, omega = 0.01;
  for (int i = 0; i < 4000; ++i) {
    const auto f = [&](double at) {
      double rate = 0;
      b.rates(ShaftState<double>{0, 0, omega, 0, 1, 1, &at}, &rate);
      return rate;
    };
    const double k1 = f(z), k2 = f(z + h / 2 * k1), k3 = f(z + h / 2 * k2), k4 = f(z + h * k3);
    z += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    const double phi = omega * (i + 1) * h;
    ASSERT_NEAR(1000 * z, 4 * (1 - std::exp(-1000 * phi / 4)), 1e-9);
  }
}

// A shaft at rest on bristles gives by T/σ₀ and rings with √(σ₀/J): presliding is elastic, nothing is held by force.
TEST(Bearing, BristlesRingLikeASpringBelowTheStaticTorque) {
  const Result r = run(bearing("model = \"LuGre\"\nbristle_stiffness = \"1000 N*m/rad\"\nbristle_damping = \"5 "
                               "N*m*s/rad\"",
                               "[push]\nkind = \"torque source\"\non = \"shaft\"\ntorque = \"1e-3 N*m\"\n[run]\nuntil "
                               "= \"0.3 s\"\nsamples = 301\naccuracy = 1e-9\n"),
                       false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  // J z̈ + (σ₁ + b) ż + σ₀ z = T; the bristles' slip is of second order, z ω σ₀/M_s ~ 1e-7.
  const double inertia = 0.5, sigma = 5.05, stiffness = 1000, push = 1e-3;
  const double decay = sigma / (2 * inertia), rate = std::sqrt(stiffness / inertia - decay * decay);
  const auto angle = test::series(r, "angle.shaft");
  for (std::size_t row = 0; row < angle.size(); ++row) {
    const double t = r.trajectory->time()[row];
    const double z =
        push / stiffness * (1 - std::exp(-decay * t) * (std::cos(rate * t) + decay / rate * std::sin(rate * t)));
    EXPECT_NEAR(angle[row], z, 1e-3 * push / stiffness) << t;
  }
}

// What a bearing takes is what the machine loses, to the last joule, bristles included.
TEST(Bearing, EnergyBalances) {
  for (const std::string& model : {exact, creeping, bristles}) {
    const Result r =
        run(bearing(model, "[run]\nstart = { speed = \"8 rad/s\" }\nuntil = \"3 s\"\naccuracy = 1e-9\n"), false);
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_LT(r.energy.relative, 1e-8) << model;
    EXPECT_NEAR(r.energy.kinetic_start, 16, 1e-12);
    EXPECT_NEAR(r.energy.by_line.at("harmful"), -r.energy.kinetic_start - r.energy.stored_start, 1e-4) << model;
  }
}

TEST(Bearing, JacobianEqualsDifferences) {
  for (const double omega : {-3.0, -0.2, 0.7, 25.0}) {
    const std::string start = fmt::format("[run]\nstart = {{ speed = \"{} rad/s\" }}\n", omega);
    test::expect_exact_jacobian_near_start(bearing(exact, start));
    test::expect_exact_jacobian_near_start(bearing(bristles, start), {0.1, 1e-3});
    test::expect_exact_jacobian_near_start(
        bearing("model = \"regularised\"\ncreep_speed = \"0.5 rad/s\"\nstribeck_exponent = 1", start));
  }
  test::expect_exact_jacobian_near_start(bearing(exact, ""));  // at rest
}

// Off it is not there at all: the same as a component that exerts nothing.
TEST(Bearing, OffItLeavesNoTrace) {
  const std::string push = "[push]\nkind = \"torque source\"\non = \"shaft\"\ntorque = \"1 N*m\"\n";
  const std::string end = "[run]\nuntil = \"2 s\"\nstart = { speed = \"3 rad/s\" }\n";
  const std::string without =
      "line = [\"shaft\"]\n[shaft]\nkind = \"flywheel\"\ninertia = \"0.5 kg*m2\"\n[bearing]\nkind = \"torque "
      "source\"\non = \"shaft\"\ntorque = \"0 N*m\"\n";
  for (const std::string& model : {exact, creeping, bristles})
    test::expect_same_machine(bearing(model, push + "[effects]\nbearing_friction = false\n" + end),
                              without + push + end);
}

}  // namespace
}  // namespace kurbel::bearing_test
