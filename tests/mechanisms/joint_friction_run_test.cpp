// joint_friction_run_test.cpp — joint friction as an effect of runs: its law, its loss, its hold, and no trace when
// off.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/events/equations.h"
#include "tests/mechanisms/slider_crank_statics.h"
#include "tests/support/jacobians.h"
#include "tests/support/scenes.h"

namespace kurbel::joint_friction_run_test {
namespace {

std::string crank(const std::string& effects, const std::string& run, const std::string& more = "") {
  return fmt::format(R"(
line = ["wheel", "crank"]
[wheel]
kind = "flywheel"
inertia = "0.4 kg*m2"
[crank]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
offset = "15 mm"
crank_inertia = "0.15 kg*m2"
rod_mass = "2 kg"
rod_com = "122.5 mm"
rod_inertia = "0.02 kg*m2"
slider_mass = "3 kg"
gravity = "9.81 m/s2"
main_bearing = {{ radius = "40 mm", friction = 0.05, static_friction = 0.1, stribeck_speed = "0.3 m/s" }}
crank_pin = {{ radius = "30 mm", friction = 0.05 }}
slider_pin = {{ radius = "15 mm", friction = 0.08 }}
guide = {{ friction = 0.1, length = "60 mm", width = "80 mm" }}
{}
[effects]
{}
[run]
{}
)",
                     more, effects, run);
}

// ε of the equations is the root of the scalar equation in ε, at any state and for an explicit Jacobian.
TEST(JointFrictionEffect, AccelerationIsThatOfTheImplicitEquation) {
  const Scene scene = test::scene_from(crank("joint_friction = true", "until = \"1 s\""));
  Equations equations(compile(scene, scene.effects), false);
  SliderCrankData d;
  d.radius = 0.1, d.rod_length = 0.35, d.offset = 0.015, d.crank_inertia = 0.15, d.rod_mass = 2, d.rod_com = 0.1225;
  d.rod_inertia = 0.02, d.slider_mass = 3, d.gravity = 9.81;
  SliderCrankJoints j;
  j.main_bearing = {0.04, {0.05, 0.1, 0.3, 0}};
  j.crank_pin = {0.03, {0.05, 0.05, 0, 0}};
  j.slider_pin = {0.015, {0.08, 0.08, 0, 0}};
  j.guide.friction = {0.1, 0.1, 0, 0};
  j.guide.length = 0.06;
  j.guide.width = 0.08;
  const SliderCrankStatics statics(d, j);
  for (int k = 0; k < 50; ++k) {
    const double phi = 0.13 + 0.25 * k, omega = (k % 2 ? 1 : -1) * (2.0 + k);
    const std::vector<double> y = equations.modes_from_scratch(0, phi, omega);
    const double alpha = equations.snapshot(0, y).alpha[0];
    const double expected = statics.acceleration({.phi = phi, .omega = omega}, 0, 0.4);
    EXPECT_NEAR(alpha, expected, 1e-9 * (std::abs(expected) + omega * omega)) << k;
  }
}

TEST(JointFrictionEffect, JacobianEqualsDifferences) {
  const Scene scene = test::scene_from(crank("joint_friction = true", "until = \"1 s\""));
  Equations equations(compile(scene, scene.effects), false);
  for (const double phi : {0.4, 1.0, 2.2, 4.0, 5.5}) {
    const std::vector<double> y = equations.modes_from_scratch(0, phi, 20);
    const test::Slopes slopes = test::slopes_of(equations, 0, y, std::vector<double>(y.size(), 1e-5));
    for (std::size_t row = 0; row < y.size(); ++row)
      for (std::size_t column = 0; column < y.size(); ++column) {
        const double slope = slopes.difference_at(row, column);
        EXPECT_NEAR(slopes.exact_at(row, column), slope, 1e-5 * (1 + std::abs(slope))) << phi;
      }
  }
}

TEST(JointFrictionEffect, LossOfARunIsTheEnergyThatIsMissing) {
  const Result r = test::run(
      crank("joint_friction = true", "start = { speed = \"30 rad/s\" }\nuntil = \"1 s\"\naccuracy = 1e-6"), false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_LT(r.energy.relative, 1e-6);
  const double lost = -r.energy.by_account.at("crank.joints");
  EXPECT_GT(lost, 5);
  EXPECT_NEAR(lost, -r.energy.by_line.at("harmful"), 1e-9 * lost);
  EXPECT_NEAR(r.energy.kinetic_start - r.energy.kinetic_end + r.energy.by_line.at("weight"), lost, 1e-4 * lost);
}

// Two of a kind, each with half of the wheel, move as one: on one shaft, and on two behind a spring that is never twisted.
TEST(JointFrictionEffect, TwoOfAKindMoveAsOne) {
  const auto machine = [](const std::string& line, const std::string& effects, const std::string& more) {
    const std::string of = crank(effects, "start = { speed = \"30 rad/s\" }\nuntil = \"0.6 s\"\naccuracy = 1e-9", "");
    const std::size_t begin = of.find("[crank]"), end = of.find("[effects]");
    std::string other = of.substr(begin, end - begin);
    other.replace(0, 7, "[other]");
    std::string text = of;
    text.insert(end, (line.find("other") < line.size() ? other : "") + more);
    return test::run(text.replace(text.find("line = "), text.find("[wheel]") - text.find("line = "), line + "\n"),
                     false);
  };
  const double one =
      test::figure(machine("line = [\"wheel\", \"crank\"]", "joint_friction = true", ""), "final_speed.wheel");
  EXPECT_LT(one, 29);
  const std::string second = "[second]\nkind = \"flywheel\"\ninertia = \"0.4 kg*m2\"\n";
  const Result stiff = machine("line = [\"wheel\", \"crank\", \"second\", \"other\"]", "joint_friction = true", second);
  EXPECT_NEAR(test::figure(stiff, "final_speed.wheel"), one, 1e-7 * one);
  const Result apart = machine("line = [\"wheel\", \"crank\", \"coupling\", \"second\", \"other\"]",
                               "joint_friction = true\nelasticity = true",
                               second + "[coupling]\nkind = \"coupling\"\nstiffness = \"20 kN*m/rad\"\n");
  EXPECT_NEAR(test::figure(apart, "final_speed.wheel"), one, 1e-7 * one);
}

TEST(JointFrictionEffect, RunDownEndsHeldByStaticFriction) {
  const Result r = test::run(
      crank("joint_friction = true", "start = { speed = \"5 rad/s\" }\nuntil = \"60 s\"\naccuracy = 1e-5"), false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  bool held = false;
  for (const Event& e : r.events) held = held || e.what == "comes to rest and is held";
  EXPECT_TRUE(held);
  EXPECT_EQ(test::figure(r, "final_speed.wheel"), 0);
}

TEST(JointFrictionEffect, SwitchedOffLeavesNoTrace) {
  const std::string run = "start = { speed = \"30 rad/s\" }\nuntil = \"0.5 s\"";
  const Result off = test::run(crank("joint_friction = false", run), false);
  std::string text = crank("", run);
  for (const char* joint : {"main_bearing", "crank_pin", "slider_pin", "guide"}) {
    const std::size_t at = text.find(std::string(joint) + " = ");
    text.erase(at, text.find('\n', at) - at);
  }
  const Result without = test::run(text, false);
  EXPECT_EQ(test::figure(off, "final_speed.wheel"), test::figure(without, "final_speed.wheel"));
  EXPECT_EQ(off.energy.by_account.size(), without.energy.by_account.size());
  EXPECT_EQ(off.statistics.stepper.steps, without.statistics.stepper.steps);
  EXPECT_EQ(off.statistics.stepper.flow_calls, without.statistics.stepper.flow_calls);
}

TEST(JointFrictionEffect, IsRefusedWhereNoJointHasFriction) {
  const Scene scene = test::scene_from(
      "line = [\"w\"]\n[w]\nkind = \"flywheel\"\ninertia = \"1 kg*m2\"\n"
      "[effects]\njoint_friction = true\n");
  EXPECT_THROW(compile(scene, scene.effects), SceneError);
}

}  // namespace
}  // namespace kurbel::joint_friction_run_test
