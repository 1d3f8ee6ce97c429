// small_motions_test.cpp — what modes says of machines at their steady motion, against matrices and formulas by hand: what slips
// is a damper, circuits are states, prescribed speeds and universal joints excite, gears of three shafts keep both motions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/linear/coordinates.h"
#include "engine/matrices/linear_algebra.h"
#include "studies/modes/modes.h"
#include "tests/support/eigen_solutions.h"
#include "tests/support/scenes.h"

namespace kurbel::small_motions_test {
namespace {

constexpr double pi = std::numbers::pi;

ModesStudy modes_of(const std::string& text, const ModesOptions& options = {}) {
  const Scene scene = test::scene_from(text);
  return find_modes(scene, scene.effects, options);
}

// Every eigenvalue of the matrix is one of the study's.
void expect_eigenvalues(const ModesStudy& study, const Eigen::MatrixXd& matrix, double within) {
  const Eigen::VectorXcd expected = eigenvalues(matrix);
  for (const std::complex<double> lambda : expected) {
    if (lambda.imag() < 0) continue;
    double nearest = HUGE_VAL;
    for (const DampedMode& mode : study.damped) nearest = std::min(nearest, std::abs(mode.lambda - lambda));
    EXPECT_LT(nearest, within * std::max(1.0, std::abs(lambda))) << lambda;
  }
}

// Motor J₁ with slope b, spring k, c, drum J₂ with damping d₂, ring J₃ behind a film d: states θ, ω₁, ω₂, ω₃. The tuned
// damper quenches; a loose one and a tight one do not, and lie at different frequencies.
TEST(SmallMotions, ViscousDamperIsADamperAndNoLock) {
  double frequency[3];
  const double dampings[] = {0.001, 2.2, 150};
  for (int i = 0; i < 3; ++i) {
    const double d = dampings[i];
    const ModesStudy m = modes_of(fmt::format(R"(
line = ["motor", "coupling", "drum", "damper"]
motor = {{ kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", inertia = "0.5 kg*m2" }}
coupling = {{ kind = "coupling", stiffness = "6 kN*m/rad", damping = "1.5 N*m*s/rad" }}
drum = {{ kind = "load", inertia = "0.3 kg*m2", damping = "1.25 N*m*s/rad" }}
damper = {{ kind = "viscous damper", ring_inertia = "0.15 kg*m2", damping = "{} N*m*s/rad" }}
effects = {{ elasticity = true }}
run = {{ start = "rest", until = "20 s" }}
)",
                                              d));
    const double b = 60.0 / 40, k = 6000, c = 1.5;
    Eigen::MatrixXd a(4, 4);
    a << 0, 1, -1, 0,                                      //
        -k / 0.5, -(b + c) / 0.5, c / 0.5, 0,              //
        k / 0.3, c / 0.3, -(c + 1.25 + d) / 0.3, d / 0.3,  //
        0, 0, d / 0.15, -d / 0.15;
    expect_eigenvalues(m, a, 1e-9);
    frequency[i] = m.modes.front().lambda.imag() / (2 * pi);
    for (const Mode& mode : m.modes) EXPECT_LT(mode.error, 1e-8 * std::max(1.0, mode.omega));
  }
  EXPECT_GT(frequency[0], 1.1 * frequency[2]);  // the ring takes part or does not
}

// L di/dt = U − R i − k ω₁, J₁ ω̇₁ = k i − τ: current and inertia oscillate together, and what the static line would
// damp by k²/R is something else.
TEST(SmallMotions, ArmatureCurrentIsAStateOfTheLinearSystem) {
  const ModesStudy m = modes_of(R"(
line = ["motor", "coupling", "fan"]
motor = { kind = "dc shunt motor", voltage = "220 V", resistance = "0.8 Ohm", constant = "2.1 N*m/A", inductance = "60 mH", inertia = "0.4 kg*m2" }
coupling = { kind = "coupling", stiffness = "900 N*m/rad", damping = "0.7 N*m*s/rad" }
fan = { kind = "load", inertia = "0.6 kg*m2", damping = "1.1 N*m*s/rad" }
effects = { elasticity = true, transients = true }
run = { start = "rest", until = "20 s" }
)");
  Eigen::MatrixXd a(4, 4);  // θ, ω₁, ω₂, i
  const double k = 900, c = 0.7;
  a << 0, 1, -1, 0,                            //
      -k / 0.4, -c / 0.4, c / 0.4, 2.1 / 0.4,  //
      k / 0.6, c / 0.6, -(c + 1.1) / 0.6, 0,   //
      0, -2.1 / 0.06, 0, -0.8 / 0.06;
  expect_eigenvalues(m, a, 1e-9);
  ASSERT_EQ(m.modes.size(), 2u);
  EXPECT_EQ(std::count_if(m.modes.begin(), m.modes.end(), [](const Mode& x) { return x.of_internal_states; }), 1);
}

// The base of a spring whose speed oscillates by A: τ = s X/(1 − s/(J ω²)), X = A/(iω), s = k + iωc.
TEST(SmallMotions, RippleOfAPrescribedSpeedExcitesTheDrive) {
  const ModesStudy m = modes_of(R"(
line = ["drive", "c", "disc"]
drive = { kind = "prescribed speed", speed = "30 rad/s", amplitude = "0.6 rad/s", frequency = "9 Hz" }
c = { kind = "coupling", stiffness = "500 N*m/rad", damping = "0.8 N*m*s/rad" }
disc = { kind = "load", inertia = "0.2 kg*m2", damping = "0.05 N*m*s/rad" }
effects = { elasticity = true }
run = { start = { speed = "30 rad/s" }, until = "2 s" }
)");
  const double w = 2 * pi * 9;
  const std::complex<double> s(500, 0.8 * w), x = 0.6 / std::complex<double>(0, w),
                                              inert = std::complex<double>(-0.2 * w * w, 0.05 * w);  // τ = inert · φ
  const double expected = std::abs(s * x / (1.0 + s / inert));
  EXPECT_NEAR(m.here.joints.at(0).peak, expected, 1e-7 * expected);
  ASSERT_TRUE(m.cycle.has_value());
  EXPECT_NEAR(m.cycle->joints.at(0).peak, expected, 1e-4 * expected);
  for (const std::string& note : m.notes) EXPECT_EQ(note.find("steady motion"), std::string::npos) << note;
}

// A universal joint turns its far end unevenly, by tan²(β/2) in the second order. The linear drive is exact in first order
// of that: what is left grows with its square.
TEST(SmallMotions, UniversalJointExcitesTheSecondOrder) {
  double off[2];
  const int angles[] = {3, 12};
  for (int i = 0; i < 2; ++i) {
    const ModesStudy m = modes_of(fmt::format(R"(
line = ["motor", "joint", "fan"]
motor = {{ kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", inertia = "0.5 kg*m2" }}
joint = {{ kind = "universal joint", stiffness = "3 kN*m/rad", angle = "{} deg", damping_ratio = 0.03 }}
fan = {{ kind = "load", inertia = "0.3 kg*m2", damping = "0.5 N*m*s/rad" }}
effects = {{ elasticity = true }}
run = {{ start = "rest", until = "20 s" }}
)",
                                              angles[i]));
    ASSERT_TRUE(m.cycle.has_value());
    const JointResponse &linear = m.here.joints.at(0), &really = m.cycle->joints.at(0);
    EXPECT_EQ(linear.dominant, 2u);
    // Base motion of a two-mass drive: τ = s X/(1 − s/(J_red ω²)), X = tan²(β/2), s = k + iωc.
    const double w = 2 * m.drive.at.speed, x = std::pow(std::tan(angles[i] * pi / 360), 2), reduced = 0.5 * 0.3 / 0.8;
    EXPECT_NEAR(really.dominant_amplitude, std::abs(3000 * x / (1 - 3000 / (reduced * w * w))), 0.06 * really.peak);
    off[i] = std::abs(linear.peak / really.peak - 1);
  }
  EXPECT_LT(off[0], 0.005);
  EXPECT_GT(off[1] / off[0], 12);  // 16 and what is of higher order
  EXPECT_LT(off[1] / off[0], 26);
}

// An epicyclic gear whose three shafts are free keeps two motions. Against the eigenvalues of Zᵀ M Z, Zᵀ K Z with
// z_s ω_s + z_r ω_r = (z_s + z_r) ω_c by hand: coordinates sun and ring.
TEST(SmallMotions, PlanetaryGearWithThreeFreeShaftsHasTheModesOfBothItsMotions) {
  const ModesStudy m = modes_of(R"(
line = ["motor", "coupling", "gear", "drum"]
motor = { kind = "dc shunt motor", stall_torque = "40 N*m", no_load_speed = "150 rad/s", inertia = "0.05 kg*m2" }
coupling = { kind = "coupling", stiffness = "400 N*m/rad" }
gear = { kind = "planetary gear", sun = 24, ring = 72, sun_inertia = "0.003 kg*m2", ring_inertia = "0.2 kg*m2", carrier_inertia = "0.1 kg*m2" }
drum = { kind = "load", inertia = "1 kg*m2", damping = "2.5 N*m*s/rad" }
ring_shaft = { kind = "coupling", stiffness = "800 N*m/rad" }
film = { kind = "bearing drag", damping = "4 N*m*s/rad", inertia = "0.3 kg*m2" }
effects = { elasticity = true }
run = { start = "rest", until = "10 s" }
[[branch]]
from = "gear.ring"
line = ["ring_shaft", "film"]
)");
  // q = [motor, sun, ring, film]; carrier (with the drum) = (sun + 3 ring)/4.
  Eigen::Matrix4d mass = Eigen::Matrix4d::Zero(), stiffness = Eigen::Matrix4d::Zero();
  Eigen::Vector4d carrier(0, 0.25, 0.75, 0), first(1, -1, 0, 0), second(0, 0, 1, -1);
  mass.diagonal() << 0.05, 0.003, 0.2, 0.3;
  mass += 1.1 * carrier * carrier.transpose();
  stiffness = 400 * first * first.transpose() + 800 * second * second.transpose();
  const Eigen::VectorXd squares = test::solution_of_pair(stiffness, mass).values;
  EXPECT_EQ(m.undamped.rigid, 2);
  ASSERT_EQ(m.modes.size(), 2u);
  EXPECT_NEAR(m.modes[0].omega, std::sqrt(squares[2]), 1e-9 * m.modes[0].omega);
  EXPECT_NEAR(m.modes[1].omega, std::sqrt(squares[3]), 1e-9 * m.modes[1].omega);
}

// The same torque on two inertias: the mode lies where it does whatever the stuck clutch stands between, and a slipping one
// parts them.
TEST(SmallMotions, ClutchThatSlipsInTheSteadyMotionPartsTheDrive) {
  const auto scene = [](const char* torque) {
    return fmt::format(R"(
line = ["motor", "clutch", "disc", "coupling", "brake"]
motor = {{ kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", inertia = "0.5 kg*m2" }}
clutch = {{ kind = "clutch", torque = "{}" }}
disc = {{ kind = "inertia", inertia = "0.2 kg*m2" }}
coupling = {{ kind = "coupling", stiffness = "2 kN*m/rad", damping = "0.5 N*m*s/rad" }}
brake = {{ kind = "load", inertia = "0.3 kg*m2", damping = "0.8 N*m*s/rad" }}
effects = {{ elasticity = true }}
run = {{ start = "rest", until = "20 s" }}
)",
                       torque);
  };
  const ModesStudy holds = modes_of(scene("100 N*m")), slips = modes_of(scene("8 N*m"));
  const auto two = [](double a, double b) { return std::sqrt(2000 * (1 / a + 1 / b)); };
  EXPECT_NEAR(holds.modes.at(0).omega, two(0.7, 0.3), 1e-9 * two(0.7, 0.3));
  EXPECT_NEAR(slips.modes.at(0).omega, two(0.2, 0.3), 1e-9 * two(0.2, 0.3));
}

// q̇ of shafts that a gear ties: nearest by kinetic energy, and exact for speeds that obey it.
// A pin that orbits in its gap: its mean place touches nothing, so that the linear drive is not the machine's.
TEST(SmallMotions, WhereTheLinearResponseMissesTheAmplitudeItSaysSo) {
  const Scene scene = test::scene_file("tests/agreement/vibrations/worn_pin_shaft.toml");
  const ModesStudy study = find_modes(scene, scene.effects, {});
  ASSERT_TRUE(study.cycle);
  EXPECT_LT(study.here.joints[0].peak, 0.01 * study.cycle->joints[0].peak);
  EXPECT_TRUE(std::any_of(study.notes.begin(), study.notes.end(), [](const std::string& note) {
    return note.find("do not hold") != std::string::npos && note.find("clearance") != std::string::npos;
  }));
}

TEST(Coordinates, MotionsWithoutTwistLeaveEveryTwistAtRest) {
  SparseMatrix t(3, 5);
  t.insert(0, 0) = 1, t.insert(0, 1) = -2;
  t.insert(1, 1) = 0.5, t.insert(1, 2) = -1;
  t.insert(2, 3) = 1;
  const Eigen::MatrixXd free = motions_without_twist(t);
  ASSERT_EQ(free.cols(), 2);  // the first three together, the fifth alone; the fourth is held
  EXPECT_LT((t * free).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_DOUBLE_EQ(free(0, 0), 1);
  EXPECT_DOUBLE_EQ(free(1, 0), 0.5);
  EXPECT_DOUBLE_EQ(free(2, 0), 0.25);
  EXPECT_DOUBLE_EQ(free(4, 1), 1);
}

}  // namespace
}  // namespace kurbel::small_motions_test
