// geared_mechanism_test.cpp — a mechanism whose crank is geared to the link: its Jacobian, its joints' friction, and
// the work that this takes, forwards and against the link.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/mechanisms/slider_crank_statics.h"
#include "tests/support/elements.h"

namespace kurbel::geared_mechanism_test {
namespace {

struct Gear {
  const char* text;
  double ratio;  // ω of the wheel over ω of the crank
};
const Gear slower = {"gear = { kind = \"gearbox\", stages = [{ teeth = [20, 50] }] }", 2.5};
const Gear reversing = {
    "gear = { kind = \"planetary gear\", sun = 24, ring = 72, in = \"sun\", out = \"ring\", fixed = \"carrier\" }", -3};

// A crank that moves nothing else, so that it is the link and the other one's shaft counts by the gear.
constexpr double wheel = 0.06;  // its inertia [kg·m²]

std::string geared_crank(const Gear& gear, const std::string& crank, const std::string& end) {
  return fmt::format(R"(
line = ["wheel", "gear", "crank"]
wheel = {{ kind = "slider-crank", radius = "50 mm", rod = "300 mm", crank_inertia = "{} kg*m2" }}
{}
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
phase = "0.4 rad"
{}
{}
)",
                     wheel, gear.text, crank, end);
}

const std::string rough = R"(
main_bearing = { radius = "40 mm", friction = 0.05 }
crank_pin = { radius = "30 mm", friction = 0.04 }
slider_pin = { radius = "15 mm", friction = 0.08 }
guide = { friction = 0.1, length = "60 mm", width = "80 mm" }
)";

// The slope of what accelerates it counts by −½ I″ ω² − I′ ε of the crank's own motion, twice through the gear.
TEST(GearedMechanism, JacobianIsExactWhileItAccelerates) {
  const std::string medium = "load = { kind = \"medium\", viscous = \"90 N*s/m\", quadratic = \"70 N*s2/m2\" }";
  for (const Gear& gear : {slower, reversing})
    for (const double speed : {7.0, -31.0})
      for (const double angle : {0.3, 2.0, 5.1}) {
        SCOPED_TRACE(fmt::format("i = {}, {} rad, {} rad/s", gear.ratio, angle, speed));
        test::expect_exact_jacobian(geared_crank(gear, medium, "[run]\nuntil = \"1 s\""), angle, {}, {speed});
      }
}

// ε of the crank by the closed form of its joints' forces, with the wheel's inertia i² J on its shaft.
TEST(GearedMechanism, JointFrictionActsThroughTheGear) {
  SliderCrankData d;
  d.radius = 0.1, d.rod_length = 0.35, d.offset = 0.015, d.crank_inertia = 0.15, d.rod_mass = 2, d.rod_com = 0.1225;
  d.rod_inertia = 0.02, d.slider_mass = 3, d.gravity = 9.81;
  SliderCrankJoints j;
  j.main_bearing = {0.04, {0.05, 0.05, 0, 0}};
  j.crank_pin = {0.03, {0.04, 0.04, 0, 0}};
  j.slider_pin = {0.015, {0.08, 0.08, 0, 0}};
  j.guide.friction = {0.1, 0.1, 0, 0};
  j.guide.length = 0.06, j.guide.width = 0.08;
  const SliderCrankStatics statics(d, j);
  for (const Gear& gear : {slower, reversing}) {
    const Scene scene =
        test::scene_from(geared_crank(gear, rough, "[effects]\njoint_friction = true\n[run]\nuntil = \"1 s\""));
    Equations equations(compile(scene, scene.effects), false);
    const Model& m = equations.model();
    const int link = m.reduction_node, crank = m.network.ports.at("crank").in, on = m.network.ports.at("wheel").in;
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    const double to_crank = m.node_ratio[at(crank)] / m.node_ratio[at(link)];
    EXPECT_NEAR(m.node_ratio[at(on)] / m.node_ratio[at(crank)], gear.ratio, 1e-14);
    for (int k = 0; k < 12; ++k) {
      const double phi = 0.4 + 0.5 * k, omega = (k % 2 ? 1 : -1) * (2.0 + k);
      const std::vector<double> y = equations.modes_from_scratch(0, (phi - 0.4) / to_crank, omega / to_crank);
      const double alpha = m.gain_of_node[at(crank)] * equations.snapshot(0, y).alpha[m.shaft_of_node[at(crank)]];
      const double expected = statics.acceleration({.phi = phi, .omega = omega}, 0, wheel * gear.ratio * gear.ratio);
      EXPECT_NEAR(alpha, expected, 1e-9 * (std::abs(expected) + omega * omega)) << gear.ratio << ", " << k;
    }
  }
}

// Here the friction's own slope by ε joins the inertia; it is found by differences.
TEST(GearedMechanism, JacobianIsExactWithJointFriction) {
  for (const Gear& gear : {slower, reversing})
    for (const double angle : {0.3, 2.0, 5.1}) {
      SCOPED_TRACE(fmt::format("i = {}, {} rad", gear.ratio, angle));
      const Scene scene =
          test::scene_from(geared_crank(gear, rough, "[effects]\njoint_friction = true\n[run]\nuntil = \"1 s\""));
      Equations equations(compile(scene, scene.effects), false);
      test::expect_exact_jacobian(equations, equations.modes_from_scratch(0, angle, -31), 1e-5);
    }
}

TEST(GearedMechanism, LossInItsJointsIsTheEnergyThatIsMissing) {
  for (const Gear& gear : {slower, reversing}) {
    const Result r = test::run(geared_crank(gear, rough,
                                            "[effects]\njoint_friction = true\n[run]\nstart = { speed = \"60 rad/s\" "
                                            "}\nuntil = \"0.3 s\"\naccuracy = 1e-7"),
                               false);
    ASSERT_TRUE(r.complete) << r.diagnosis;
    const double lost = -r.energy.by_account.at("crank.joints");
    EXPECT_GT(lost, 2);
    EXPECT_NEAR(r.energy.kinetic_start - r.energy.kinetic_end + r.energy.by_line.at("weight"), lost, 1e-4 * lost);
  }
}

}  // namespace
}  // namespace kurbel::geared_mechanism_test
