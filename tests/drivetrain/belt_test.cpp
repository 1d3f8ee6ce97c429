// belt_test.cpp — belts that slip: capacity by Euler and Eytelwein, the ideal ratio below it, the heat above it.
#include "drivetrain/friction/belt.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/linear/eigen_modes.h"
#include "tests/published/published.h"
#include "tests/support/elements.h"

namespace kurbel::belt_test {
namespace {

using test::digits;
using test::figure;
using test::run;

// Motor side 0.4, driven side 3 kg·m²; d₁ = 160 mm, d₂ = 400 mm, F₀ = 500 N, μ = 0.3, α = 160°.
constexpr double j1 = 0.4, j2 = 3, ratio = 2.5, radius = 0.08;
const double limit = radius * 2 * 500 * std::tanh(0.5 * 0.3 * 160 * M_PI / 180);

std::string belt_drive(const std::string& torque, const std::string& more = "", const std::string& effects = "true",
                       const std::string& settings = "until = \"0.5 s\"") {
  return fmt::format(R"(
line = ["motor", "belt", "drum"]
[motor]
kind = "torque source"
{}
inertia = "0.4 kg*m2"
[belt]
kind = "belt"
diameter_in = "160 mm"
diameter_out = "400 mm"
pretension = "500 N"
friction_coefficient = 0.3
wrap_angle = "160 deg"
{}
[drum]
kind = "inertia"
inertia = "3 kg*m2"
[effects]
elasticity = {}
[run]
accuracy = 1e-10
{}
)",
                     torque, more, effects, settings);
}
std::string constant(double torque) { return "torque = \"" + digits(torque) + " N*m\""; }

// T₁/T₂ = e^{μα} and T₁ + T₂ = 2 F₀, for any data.
TEST(Eytelwein, LimitHoldsBothOfItsConditions) {
  for (const double friction : {0.1, 0.3, 0.8, 2.0})
    for (const double wrap : {1.0, 2.8, 3.14, 5.0}) {
      const double difference = eytelwein_force(400, friction, wrap);
      const double tight = 400 + 0.5 * difference, slack = 400 - 0.5 * difference;
      EXPECT_NEAR(tight / slack, std::exp(friction * wrap), 1e-12 * std::exp(friction * wrap));
    }
  // Along the arc dT = μ T dα.
  double tension = 1;
  const int steps = 200000;
  for (int i = 0; i < steps; ++i) tension *= 1 + 0.3 * 2.5 / steps;
  EXPECT_NEAR(eytelwein_force(0.5 * (tension + 1), 0.3, 2.5), tension - 1, 1e-5);
}
TEST(Eytelwein, OpenBeltWrapsTheSmallPulleyLess) {
  EXPECT_NEAR(open_belt_wrap(0.2, 0.2, 1), M_PI, 1e-15);
  EXPECT_NEAR(open_belt_wrap(0.16, 0.4, 0.24), 2 * M_PI / 3, 1e-14);  // sin 30° on either side
}

TEST(RigidBelt, KeepsTheIdealRatioBelowItsLimit) {
  // The belt carries τ with ω₁ = i ω₂: τ = M J₂/i²/(J₁ + J₂/i²).
  const double reduced = j2 / ratio / ratio, torque = 0.999 * limit * (j1 + reduced) / reduced;
  const Result r = run(belt_drive(constant(torque)));
  EXPECT_NEAR(figure(r, "final_speed.motor"), torque / (j1 + reduced) * 0.5, 1e-9);
  EXPECT_NEAR(figure(r, "final_speed.motor"), ratio * figure(r, "final_speed.drum"), 1e-12);
  EXPECT_NEAR(figure(r, "peak_torque.belt"), 0.999 * limit, 1e-9);
  EXPECT_NEAR(r.energy.by_account.at("belt"), 0, 1e-12);
}
TEST(RigidBelt, SlipsAboveItsLimitAndHeatsByTorqueTimesSlip) {
  const double reduced = j2 / ratio / ratio, torque = 1.5 * limit * (j1 + reduced) / reduced;
  const Result r = run(belt_drive(constant(torque)));
  const double e1 = (torque - limit) / j1, e2 = ratio * limit / j2;
  EXPECT_NEAR(figure(r, "final_speed.motor"), 0.5 * e1, 1e-8);
  EXPECT_NEAR(figure(r, "final_speed.drum"), 0.5 * e2, 1e-8);
  EXPECT_NEAR(r.energy.by_account.at("belt"), -limit * 0.5 * (e1 - ratio * e2) * 0.25, 1e-8);
}
// The V-belt's wedge: μ/sin(γ/2).
TEST(RigidBelt, GrooveRaisesTheLimit) {
  const Result r = run(belt_drive(constant(1000), "groove_angle = \"36 deg\""));
  const double wedge = 0.3 / std::sin(18 * M_PI / 180);
  EXPECT_NEAR(figure(r, "peak_torque.belt"), radius * 1000 * std::tanh(0.5 * wedge * 160 * M_PI / 180), 1e-9);
}

const std::string elastic = "stiffness = \"300 N*m/rad\"";

TEST(ElasticBelt, BelowItsLimitItIsASpring) {
  // Two-mass peak, twice the rigid torque.
  const double reduced = j2 / ratio / ratio, torque = 0.49 * limit * (j1 + reduced) / reduced;
  const Result r = run(belt_drive(constant(torque), elastic));
  EXPECT_NEAR(figure(r, "peak_spring_torque.belt"), 2 * 0.49 * limit, 1e-6);
  EXPECT_TRUE(r.events.empty());
  EXPECT_NEAR(test::series(r, "slipped_angle.belt").back(), 0, 1e-15);
}
// Stretches until the limit, θ = (M′/k)(1 − cos ωt), then slips with uniform acceleration on either side.
TEST(ElasticBelt, SlipsFromItsLimitOn) {
  const double k = 300, reduced = j2 / ratio / ratio, torque = 3 * limit;
  const double carried = torque * reduced / (j1 + reduced), omega = std::sqrt(k * (1 / j1 + 1 / reduced));
  const double t = std::acos(1 - limit / carried) / omega, rate = carried / k * omega * std::sin(omega * t);
  const double common = torque / (j1 + reduced) * t;  // (J₁ ω₁ + J₂/i² · i ω₂)/(J₁ + J₂/i²) at that time
  const double w1 = common + reduced / (j1 + reduced) * rate, w2 = (common - j1 / (j1 + reduced) * rate) / ratio;
  const double rest = 0.5 - t, e1 = (torque - limit) / j1, e2 = ratio * limit / j2;
  const Result r = run(belt_drive(constant(torque), elastic));
  ASSERT_EQ(r.events.size(), 1u);
  EXPECT_EQ(r.events[0].what, "slips");
  EXPECT_NEAR(r.events[0].t, t, 1e-10);
  EXPECT_NEAR(figure(r, "final_speed.motor"), w1 + e1 * rest, 1e-8);
  EXPECT_NEAR(figure(r, "final_speed.drum"), w2 + e2 * rest, 1e-8);
  const double slipped = rate * rest + 0.5 * (e1 - ratio * e2) * rest * rest;
  EXPECT_NEAR(test::series(r, "slipped_angle.belt").back(), slipped, 1e-8);
  EXPECT_NEAR(r.energy.by_account.at("belt"), -limit * slipped, 1e-8);
}
// A pulse: slips, grips again with the angle slipped, and vibrates on. Damped and undamped, forwards and backwards.
TEST(ElasticBelt, GripsAgainAfterAPulse) {
  for (const std::string damping : {"", "\ndamping_ratio = 0.05"})
    for (const double sense : {1.0, -1.0}) {
      const std::string pulse = constant(sense * 4 * limit) + "\nstop = \"60 ms\"";
      const Result r = run(belt_drive(pulse, elastic + damping, "true", "until = \"2 s\""));
      ASSERT_TRUE(r.complete) << r.diagnosis;
      ASSERT_GE(r.events.size(), 3u);
      EXPECT_EQ(r.events[0].what, sense > 0 ? "slips" : "slips backwards");
      EXPECT_EQ(r.events[0].kind, EventKind::slip);
      EXPECT_EQ(r.events[0].value, sense);
      EXPECT_EQ(r.events.back().what, "grips");
      EXPECT_EQ(r.events.back().kind, EventKind::lock);
      EXPECT_GT(sense * test::series(r, "slipped_angle.belt").back(), 0.01);
      EXPECT_LE(std::abs(figure(r, "peak_torque.belt")), limit * (1 + 1e-9));
      EXPECT_LE(r.energy.relative, 1e-8);
      // Momentum: what the pulse gave is all in the two sides, referred to the motor's shaft.
      EXPECT_NEAR(j1 * figure(r, "final_speed.motor") + j2 / ratio * figure(r, "final_speed.drum"),
                  sense * 4 * limit * 0.06, 1e-8);
    }
}
TEST(ElasticBelt, StiffnessComesFromTheStrands) {
  // k = 2 EA r₁²/L, L = √(a² − ¼(d₂ − d₁)²).
  const std::string strands =
      test::with(belt_drive(constant(1), "axial_stiffness = \"20 kN\"\ncentre_distance = \"0.5 m\""),
                 "wrap_angle = \"160 deg\"\n", "");
  const Scene scene = test::scene_from(strands);
  const auto model = compile(scene, scene.effects);
  EXPECT_NEAR(model->network.joints[0].element->stiffness,
              2 * 20e3 * radius * radius / std::sqrt(0.25 - 0.25 * 0.24 * 0.24), 1e-9);
  EXPECT_NE(model->explain().find("elastic creep there"), std::string::npos);
}
TEST(ElasticBelt, WithoutElasticityIsTheRigidBeltToTheLastBit) {
  test::expect_same_machine(belt_drive(constant(1.1 * limit), elastic, "false"), belt_drive(constant(1.1 * limit)));
}
// Linearised it is its spring and damper: the slipped angle stands still and is no motion of the drive.
TEST(ElasticBelt, LinearisedItIsItsSpringAndDamper) {
  const Scene scene = test::scene_from(belt_drive(constant(1), elastic + "\ndamping = \"2 N*m*s/rad\""));
  const LinearDrive drive = linearise(compile(scene, scene.effects), {});
  const double sign[2] = {1, -ratio};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      EXPECT_NEAR(drive.stiffness.coeff(i, j), 300 * sign[i] * sign[j], 1e-9);
      EXPECT_NEAR(drive.damping.coeff(i, j), 2 * sign[i] * sign[j], 1e-11);
    }
}
TEST(ElasticBelt, JacobianEqualsDifferencesInEveryMode) {
  for (const std::string damping : {"", "\ndamping = \"2 N*m*s/rad\""})
    for (const double twist : {0.1, -0.1, 0.5, -0.5})
      for (const double rate : {0.7, 40.0, -40.0}) {
        const Scene scene = test::scene_from(belt_drive(constant(1), elastic + damping));
        Equations equations(compile(scene, scene.effects), false);
        test::expect_exact_jacobian(
            equations, equations.state_of(0, 0.2, std::vector<double>{twist}, std::vector<double>{50 + rate, 20}));
      }
}

}  // namespace
}  // namespace kurbel::belt_test
