// universal_joint_test.cpp — Hooke's joint: kinematics of the textbook, and the torque that it takes to follow them.
#include "drivetrain/couplings/universal_joint.h"

#include <fmt/format.h>

#include <cmath>

#include "tests/published/published.h"
#include "tests/support/elements.h"
#include "tests/support/validation.h"

namespace kurbel::universal_joint_test {
namespace {

// φ₁ in 0 … 90° where the driven shaft slows most: g‴ = 0, with q = (2 − sin² β)/(2 sin² β),
// cos 2φ₁ = √(q² + 2) − q.
double steepest(const HookeJoint& joint) {
  const double s2 = std::pow(std::sin(joint.angle), 2);
  if (s2 == 0) return std::numbers::pi / 4;
  const double q = (2 - s2) / (2 * s2);
  return 0.5 * std::acos(2 / (std::sqrt(q * q + 2) + q));
}
// (ω_max − ω_min)/ω₁ = tan β sin β; the β of a given fluctuation F: cos β = √(1 + F²/4) − F/2.
double fluctuation(const HookeJoint& joint) { return std::tan(joint.angle) * std::sin(joint.angle); }
double angle_for_fluctuation(double f) { return std::acos(std::sqrt(1 + 0.25 * f * f) - 0.5 * f); }
// φ₁ in 0 … 90° where both shafts turn equally fast: cos² φ₁ = 1/(1 + cos β).
double unity(const HookeJoint& joint) { return std::acos(std::sqrt(1 / (1 + std::cos(joint.angle)))); }

using test::Against;
using test::digits;
using test::figure;
using test::run;
using test::Validation;

constexpr double degree = M_PI / 180;

// --- tests/cases/el07_hooke.toml: Theory of Machines (the textbook's notebooks, chapter 9), its tolerance 1e-7 ---

TEST(HookeJoint, FollowsTheTextbook) {
  const Validation is(Against::published, "Khurmi, Gupta: Theory of Machines, ch. 9 (Hooke's joint; case el07)");
  const double omega = 1500 * 2 * M_PI / 60;
  const HookeJoint ex2{20 * degree};
  const double slowing = steepest(ex2), acceleration = -ex2.ratio_slope(slowing) * omega * omega;
  is.near("ex. 2: angle of the greatest acceleration", "°", slowing / degree, 41.45868,
          2e-5);  // the case is off by 1.5 in its last digit
  is.near("ex. 2: greatest acceleration", "rad/s²", acceleration, 3083.40203, 1e-7 * 3083);
  is.near("ex. 2: torque of the inertia", "N·m", 0.12 * acceleration, 370.00824, 1e-7 * 370);
  is.near("ex. 3: angle of equal speeds, 18°", "°", unity(HookeJoint{18 * degree}) / degree, 44.281274216, 1e-7 * 44);
  is.near("ex. 4: angle of the shafts for 12 % fluctuation", "°", angle_for_fluctuation(0.12) / degree, 19.644201760,
          1e-7 * 19);
  is.near("ex. 5: angle of the shafts for ± 50 of 1200 rpm", "°", angle_for_fluctuation(100.0 / 1200) / degree,
          16.422907928, 1e-7 * 16);
  const HookeJoint ex7{20 * degree};  // two joints that add up
  is.near("ex. 7: greatest speed of the driven shaft", "rpm", 500 * std::pow(ex7.greatest_ratio(), 2), 566.237165716,
          1e-7 * 566);
  is.near("ex. 7: least speed of the driven shaft", "rpm", 500 * std::pow(ex7.least_ratio(), 2), 441.511110775,
          1e-7 * 441);
}
TEST(HookeJoint, AdvanceSlopeAndExtremesBelongTogether) {
  for (const double beta : {0.0, 5.0, 20.0, 45.0, 75.0}) {
    const HookeJoint joint{beta * degree};
    EXPECT_NEAR(fluctuation(joint), joint.greatest_ratio() - joint.least_ratio(), 1e-14);
    EXPECT_NEAR(joint.ratio(unity(joint)), 1, 1e-14);
    for (double phi = -7; phi < 7; phi += 0.37) {
      // tan φ₂ = tan φ₁/cos β
      const double out = phi + joint.advance(phi);
      EXPECT_NEAR(std::sin(out) * std::cos(phi) * std::cos(beta * degree), std::cos(out) * std::sin(phi), 1e-14);
      const double h = 1e-5;
      EXPECT_NEAR((joint.advance(phi + h) - joint.advance(phi - h)) / (2 * h), joint.ratio(phi) - 1, 1e-7);
      EXPECT_NEAR((joint.ratio(phi + h) - joint.ratio(phi - h)) / (2 * h), joint.ratio_slope(phi), 1e-7);
      EXPECT_LE(std::abs(joint.ratio_slope(phi)), -joint.ratio_slope(steepest(joint)) + 1e-12);
      EXPECT_LE(std::abs(std::tan(joint.advance(phi))),
                0.5 * (1 / std::sqrt(std::cos(beta * degree)) - std::sqrt(std::cos(beta * degree))) + 1e-12);
    }
  }
}

std::string shafts(const std::string& drive, const std::string& joint, double inertia, const std::string& settings) {
  return fmt::format(R"(
line = ["drive", "joint", "rotor"]
[drive]
{}
[joint]
kind = "universal joint"
angle = "20 deg"
{}
[rotor]
kind = "inertia"
inertia = "{} kg*m2"
[effects]
elasticity = true
[run]
{}
)",
                     drive, joint, digits(inertia), settings);
}

// Stiff shaft, driven at 1500 rpm from its unloaded motion on: the torque is I g″ ω², greatest 370.008 N·m.
TEST(UniversalJoint, TakesTheTorqueThatAcceleratesTheDrivenShaft) {
  const Result r = run(
      shafts("kind = \"prescribed speed\"\nspeed = \"1500 rpm\"", "stiffness = \"1e10 N*m/rad\"\ndamping_ratio = 0.2",
             0.12, "until = \"80 ms\"\naccuracy = 1e-8\nstart = { speed = \"1500 rpm\" }"),
      false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_NEAR(std::abs(figure(r, "peak_spring_torque.joint")), 370.00824, 1e-3);  // ring of the start
  const HookeJoint joint{20 * degree};
  const double omega = 1500 * 2 * M_PI / 60;
  EXPECT_NEAR(figure(r, "final_speed.rotor"), omega * joint.ratio(omega * 0.08), 1e-5 * omega);
}
// Both shafts free: ½ J₁ ω₁² + ½ J₂ g′² ω₁² stays, and the energy balance closes with the shaft's spring and damper.
TEST(UniversalJoint, PowerBalances) {
  for (const std::string damping : {"", "\ndamping = \"3 N*m*s/rad\""}) {
    const Result r =
        run(shafts("kind = \"inertia\"\ninertia = \"0.3 kg*m2\"",
                   "stiffness = \"3 kN*m/rad\"\nphase = \"25 deg\"" + damping, 0.12,
                   "until = \"1 s\"\naccuracy = 1e-9\nstart = { speed = \"60 rad/s\", angle = \"50 deg\" }"),
            false);
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_LE(r.energy.relative, 1e-9) << damping;
    if (!damping.empty()) {
      EXPECT_LT(r.energy.by_account.at("joint"), -1e-3);
    }
  }
}
// Rigid limit, from ω₁ at φ₁ = 0: J₁ ω₁² + J₂ (g′ ω₁)² is the same wherever it stands.
TEST(UniversalJoint, StiffJointKeepsTheEnergyOfTheVariableRatio) {
  const double j1 = 0.3, j2 = 0.12;
  const HookeJoint joint{20 * degree};
  const Result r =
      run(shafts("kind = \"inertia\"\ninertia = \"0.3 kg*m2\"", "stiffness = \"1e8 N*m/rad\"\ndamping_ratio = 0.1", j2,
                 "until = \"0.05 s\"\naccuracy = 1e-9\nstart = { speed = \"60 rad/s\" }"),
          false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double energy = (j1 + j2 * std::pow(joint.ratio(0.0), 2)) * 3600;
  const double g = joint.ratio(figure(r, "final_angle.drive"));
  EXPECT_NEAR(figure(r, "final_speed.drive"), std::sqrt(energy / (j1 + j2 * g * g)), 60 * 1e-6);
}
// Two joints of the same angle, forks in one plane (the second turned by 90°), run even again.
TEST(UniversalJoint, TwoJointsCancelTheirRipple) {
  const std::string text = R"(
line = ["drive", "first", "middle", "second", "rotor"]
[drive]
kind = "prescribed speed"
speed = "50 rad/s"
[first]
kind = "universal joint"
angle = "25 deg"
stiffness = "1e7 N*m/rad"
damping_ratio = 0.2
[middle]
kind = "inertia"
inertia = "0.01 kg*m2"
[second]
kind = "universal joint"
angle = "25 deg"
phase = "90 deg"
stiffness = "1e7 N*m/rad"
damping_ratio = 0.2
[rotor]
kind = "inertia"
inertia = "0.1 kg*m2"
[effects]
elasticity = true
[run]
until = "0.15 s"
samples = 301
accuracy = 1e-8
start = { speed = "50 rad/s" }
)";
  const Result r = run(text, false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  for (const double w : test::series(r, "speed.rotor")) EXPECT_NEAR(w, 50, 1e-3);
  double most = 0;
  for (const double w : test::series(r, "speed.middle")) most = std::max(most, w);
  EXPECT_NEAR(most, 50 / std::cos(25 * degree), 1e-2);
}
// A start at any angle finds the unloaded twist and speeds: no ring.
TEST(UniversalJoint, StartsUnloadedAtAnyAngle) {
  for (const double angle : {0.0, 30.0, 77.0, 140.0}) {
    const Scene scene =
        test::scene_from(shafts("kind = \"inertia\"\ninertia = \"0.3 kg*m2\"", "stiffness = \"1e5 N*m/rad\"", 0.12,
                                fmt::format("start = {{ speed = \"60 rad/s\", angle = \"{} deg\" }}", angle)));
    Equations equations(compile(scene, scene.effects), false);
    const std::vector<double> y = equations.start(0);
    const Snapshot& s = equations.snapshot(0, y);
    EXPECT_NEAR(s.joint_torque[0], 0, 1e-7) << angle;
    EXPECT_NEAR(y[equations.speed_index(1)], 60 * HookeJoint{20 * degree}.ratio(angle * degree), 1e-11);
  }
}
TEST(UniversalJoint, JacobianEqualsDifferences) {
  for (const double angle : {0.2, 1.1, -2.3})
    test::expect_exact_jacobian(shafts("kind = \"inertia\"\ninertia = \"0.3 kg*m2\"",
                                       "stiffness = \"3 kN*m/rad\"\ndamping = \"5 N*m*s/rad\"", 0.12, ""),
                                angle, {0.01}, {60, 57});
}

}  // namespace
}  // namespace kurbel::universal_joint_test
