// modes_at_rest_test.cpp — small vibrations about a position of rest against closed forms: pendulums, cranks that rock, a pendulum on a
// spring; and a rest that is none.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "studies/modes/modes.h"
#include "tests/published/published.h"

namespace kurbel::modes_at_rest_test {
namespace {

using std::numbers::pi;
constexpr double g = 9.80665;

// tests/cases/mb05_adams_pendulum.toml as the crank of a four-bar without other masses; at φ = 0 the crank hangs.
std::string pendulum(double from, const std::string& more = "") {
  return fmt::format(R"(
line = ["pendulum"]
[pendulum]
kind = "four-bar"
crank = "3 m"
coupler = "10 m"
rocker = "7.5 m"
ground = "15 m"
crank_mass = "1 kg"
crank_com = "2 m"
crank_inertia = "4.1 kg*m2"
gravity = "9.80665 m/s2"
ground_angle = "-90 deg"
{}
[run]
start = {{ angle = "{} deg", speed = "0 rpm" }}
until = "3 s"
)",
                     more, from);
}

ModesStudy modes_of(const std::string& scene, const ModesOptions& options = {}) {
  const Scene read = test::scene_from(scene);
  return find_modes(read, read.effects, options);
}

// ω² = m g l/J, from the rest itself and from where it oscillates without end.
TEST(ModesAtRest, PendulumOscillatesBySqrtOfMglOverJ) {
  const double omega = std::sqrt(1 * g * 2 / 4.1);
  for (const double from : {0.0, 90.0, -40.0}) {
    const ModesStudy m = modes_of(pendulum(from));
    ASSERT_EQ(m.modes.size(), 1u) << from;
    EXPECT_NEAR(m.modes[0].magnitude(), omega, 1e-9 * omega) << from;
    EXPECT_NEAR(m.modes[0].ratio, 0, 1e-12);
    ASSERT_TRUE(m.rests_at);
    EXPECT_NEAR(*m.rests_at, 0, 1e-9);
    EXPECT_NE(findings_of(m).claims.size(), 0u);
  }
}

// At φ = 0 the rocker's ratio is that of the triangle with AD = ground − crank: what damps it damps the crank by ψ′².
// A torque that oscillates with time shakes it there, and needs no place beyond its arc.
TEST(ModesAtRest, PendulumMayBeShakenOverTime) {
  const std::string shaken = test::with(
      pendulum(20), "line = [\"pendulum\"]",
      "line = [\"exciter\", \"pendulum\"]\nexciter = { kind = \"torque source\", amplitude = \"0.5 N*m\", frequency "
      "= \"0.2 Hz\", inertia = \"0.3 kg*m2\" }");
  const ModesStudy m = modes_of(shaken);
  ASSERT_EQ(m.modes.size(), 1u);
  const double omega = std::sqrt(1 * g * 2 / 4.4);
  EXPECT_NEAR(m.modes[0].magnitude(), omega, 1e-8 * omega);
  EXPECT_FALSE(m.excitations.by_frequency.empty());
}

TEST(ModesAtRest, DampingOfTheRockerDampsByItsRatioSquared) {
  const double s = 12, foot = (s * s + 100 - 7.5 * 7.5) / (2 * s);
  const double beta = std::acos(foot / 10), psi = std::atan2(std::sqrt(100 - foot * foot), foot - s);
  const double ratio = 3 * std::sin(-beta) / (7.5 * std::sin(psi - beta));
  const double c = 4, omega = std::sqrt(2 * g / 4.1), zeta = c * ratio * ratio / (2 * 4.1 * omega);
  const ModesStudy m = modes_of(pendulum(20, "load = { kind = \"medium\", viscous = \"4 N*m*s/rad\" }"));
  ASSERT_EQ(m.modes.size(), 1u);
  EXPECT_NEAR(m.modes[0].magnitude(), omega, 1e-7 * omega);
  EXPECT_NEAR(m.modes[0].ratio, zeta, 1e-7 * zeta);
  EXPECT_NEAR(m.modes[0].omega, omega, 1e-7 * omega);  // undamped
  EXPECT_EQ(natural_modes(m), 1u);
}

// r = 0.2, l = 0.12 along the vertical: x″ = −r − r²/l and β′ = −r/l at φ = 0, so that
//     K = g (m_c c + m_s (r + r²/l)),   I = I_c + I_rod r²/l²
TEST(ModesAtRest, SliderOfARockingCrankDependsOnItsAccelerationRatio) {
  const double k = g * (5 * 0.08 + 0.3 * (0.2 + 0.04 / 0.12)), inertia = 0.06 + 0.002 * 0.04 / 0.0144;
  const ModesStudy m = modes_of(R"(
line = ["swing"]
[swing]
kind = "slider-crank"
radius = "200 mm"
rod = "120 mm"
crank_mass = "5 kg"
crank_com = "80 mm"
crank_inertia = "0.06 kg*m2"
rod_inertia = "0.002 kg*m2"
rod_mass = "1e-9 kg"
slider_mass = "0.3 kg"
gravity = "9.80665 m/s2"
stroke_angle = "-90 deg"
[run]
start = { angle = "10 deg" }
)");
  ASSERT_EQ(m.modes.size(), 1u);
  EXPECT_NEAR(m.modes[0].magnitude(), std::sqrt(k / inertia), 1e-7 * m.modes[0].magnitude());
}

// A wheel of J₁ on a spring k to a pendulum of J₂ that hangs: det(K − ω² M) = 0, a square equation in ω².
TEST(ModesAtRest, PendulumOnASpringHasTheTwoFrequenciesOfItsDeterminant) {
  const double j1 = 1, j2 = 0.1, k = 50, w = 5 * g * 0.08;
  const ModesStudy m = modes_of(R"(
line = ["pendulum", "spring", "wheel"]
[wheel]
kind = "inertia"
inertia = "1 kg*m2"
[spring]
kind = "coupling"
stiffness = "50 N*m/rad"
damping = "0.1 N*m*s/rad"
[pendulum]
kind = "slider-crank"
radius = "100 mm"
rod = "400 mm"
crank_mass = "5 kg"
crank_com = "80 mm"
crank_inertia = "0.1 kg*m2"
gravity = "9.80665 m/s2"
stroke_angle = "-90 deg"
[run]
start = { angle = "0 deg" }
[effects]
elasticity = true
)");
  const double a = j1 * j2, b = j1 * (k + w) + j2 * k, c = k * w, root = std::sqrt(b * b - 4 * a * c);
  ASSERT_EQ(m.modes.size(), 2u);
  const double slow = std::sqrt((b - root) / (2 * a)), fast = std::sqrt((b + root) / (2 * a));
  EXPECT_EQ(natural_modes(m), 2u);
  EXPECT_NEAR(m.modes[0].omega, slow, 1e-7 * slow);  // undamped, weights among the springs
  EXPECT_NEAR(m.modes[1].omega, fast, 1e-7 * fast);
  EXPECT_NEAR(m.modes[0].magnitude(), slow, 1e-4 * slow);  // ζ of 1e-2 moves |λ| by its square
  EXPECT_NEAR(m.modes[1].magnitude(), fast, 1e-3 * fast);
}

// A table that sticks and slips: friction holds it where its cycle begins, so that nothing can vibrate about that
// motion. Its natural frequency is that of the spring all the same.
TEST(ModesAtRest, WhatFrictionHoldsHasItsNaturalFrequencies) {
  const Scene scene = test::scene_file("scenes/stick_slip.toml");
  const ModesStudy m = find_modes(scene, scene.effects, {});
  ASSERT_EQ(m.modes.size(), 1u);
  EXPECT_NEAR(m.modes[0].omega, std::sqrt(900.0 / 12), 1e-9 * m.modes[0].omega);
  ASSERT_FALSE(m.notes.empty());
  EXPECT_NE(m.notes.back().find("held by friction"), std::string::npos) << m.notes.back();
  EXPECT_FALSE(findings_of(m).claims.empty());
}

// Nothing is held by friction where there is none.
TEST(ModesAtRest, WithoutAFreeShaftThereAreNone) {
  const std::string text = pendulum(0);
  const Scene scene = test::scene_from(
      "line = [\"drive\", \"pendulum\"]\ndrive = { kind = \"prescribed speed\", speed = "
      "\"12 rpm\" }\n" +
      text.substr(text.find("[pendulum]")));
  try {
    find_modes(scene, scene.effects, {});
    ADD_FAILURE();
  } catch (const std::invalid_argument& why) {
    EXPECT_NE(std::string(why.what()).find("every speed is prescribed"), std::string::npos) << why.what();
  }
}

// Upside down it falls: λ = +√(m g l/J), reported, and no frequency is made of it.
TEST(ModesAtRest, RestUpsideDownIsStatedToGrow) {
  const ModesStudy m = modes_of(pendulum(0), [] {
    ModesOptions held;
    held.angle = 140 * pi / 180;
    return held;
  }());
  EXPECT_TRUE(m.modes.empty());
  bool reported = false;
  for (const std::string& note : m.notes) reported = reported || note.find("grows by itself") != std::string::npos;
  EXPECT_TRUE(reported);
}

// Without weights nothing brings it back: where it stands it does not oscillate; pushed it comes to the end of its arc.
TEST(ModesAtRest, WithoutWeightsThereIsNothingToOscillateBy) {
  std::string light = pendulum(10);
  light.erase(light.find("gravity"), light.find("ground_angle") - light.find("gravity"));
  EXPECT_TRUE(modes_of(light).modes.empty());
  light.replace(light.find("0 rpm"), 5, "9 rpm");
  try {
    modes_of(light);
    ADD_FAILURE() << "it has no rest";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("small vibrations about a position of rest"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace kurbel::modes_at_rest_test
