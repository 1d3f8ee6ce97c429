// rigid_machine_test.cpp — the machine as functions of angle and speed, against closed forms and its own run.
#include "engine/rigid/rigid_machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/mechanisms/slider_crank_geometry.h"
#include "tests/support/scenes.h"

namespace kurbel::rigid_machine_test {
namespace {

using std::numbers::pi;

// r = 0.1 m, l = 0.35 m, crank along the stroke at 0: x = r cos φ + √(l² − r² sin² φ), x′ = −r sin φ (1 + r cos φ/√…)
double travel_ratio(double phi) {
  const double r = 0.1, l = 0.35;
  return -r * std::sin(phi) * (1 + r * std::cos(phi) / std::sqrt(l * l - std::pow(r * std::sin(phi), 2)));
}

// M = 60 (1 − ω/40) − 2000 |x′| while the slider moves towards the crank with x < l, that is cos φ < r/(2l), φ < π.
TEST(RigidMachine, TorqueOfTheDrivenSliderCrankMatchesItsClosedForm) {
  RigidMachine machine(test::scene_file("scenes/driven_slider_crank.toml"));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0, 2 * pi), speed(1, 50);
  const double edge = std::acos(1.0 / 7);
  for (int i = 0; i < 200; ++i) {
    const double phi = angle(random), omega = speed(random);
    machine.set_modes(phi, omega);
    const RigidMachine::At at = machine.at(phi, omega, true);
    const double drive = 60 * (1 - omega / 40), load = phi > edge && phi < pi ? 2000 * travel_ratio(phi) : 0;
    EXPECT_NEAR(at.torque, drive + load, 1e-9) << phi;
    ASSERT_EQ(at.share.size(), machine.model().accounts.size());
    double sum = 0, driving = 0;
    for (std::size_t k = 0; k < at.share.size(); ++k) {
      sum += at.share[k];
      if (machine.model().accounts[k].kind == Account::driving) driving += at.share[k];
    }
    EXPECT_NEAR(sum, at.torque, 1e-10);
    EXPECT_NEAR(driving, drive, 1e-10);
  }
}

// The law changes at cos φ = r/(2l) and at both dead centres; backwards the slider approaches on the other half-turn.
TEST(RigidMachine, LoadEdgesLieWhereTheSliderPassesTheRodLength) {
  RigidMachine machine(test::scene_file("scenes/driven_slider_crank.toml"));
  const double edge = std::acos(1.0 / 7);
  const std::vector<double> forwards = machine.edges(1), backwards = machine.edges(-1);
  ASSERT_EQ(forwards.size(), 3U);
  EXPECT_NEAR(forwards[0], 0, 1e-13);
  EXPECT_NEAR(forwards[1], edge, 1e-13);
  EXPECT_NEAR(forwards[2], pi, 1e-13);
  ASSERT_EQ(backwards.size(), 3U);
  EXPECT_NEAR(backwards[0], 0, 1e-13);
  EXPECT_NEAR(backwards[1], pi, 1e-13);
  EXPECT_NEAR(backwards[2], 2 * pi - edge, 1e-13);
}

// At an edge the piece ahead holds: load on just after cos φ = 1/7 forwards, off backwards there.
TEST(RigidMachine, AtAnEdgeTheLawAheadHoldsInEitherDirection) {
  RigidMachine machine(test::scene_file("scenes/driven_slider_crank.toml"));
  const double edge = std::acos(1.0 / 7);
  machine.set_modes(edge, 10);
  EXPECT_NEAR(machine.at(edge, 10).torque, 45 + 2000 * travel_ratio(edge), 1e-9);
  machine.set_modes(pi, 10);
  EXPECT_NEAR(machine.at(pi, 10).torque, 45, 1e-9);
  machine.set_modes(2 * pi - edge, -10);  // backwards the crank nears the folded end on this side
  EXPECT_NEAR(machine.at(2 * pi - edge, -10).torque, 75 + 2000 * travel_ratio(2 * pi - edge), 1e-9);
  machine.set_modes(edge, -10);
  EXPECT_NEAR(machine.at(edge, -10).torque, 75, 1e-9);
}

// I_r ε + ½ I_r′ ω² = M: the acceleration of the simulated machine, for random angles and speeds of either sign.
TEST(RigidMachine, AccelerationFollowsFromInertiaSlopeAndTorqueAsInTheEquationsOfMotion) {
  for (const char* file : {"crank_press", "piston_pump", "compressor", "single_cylinder_engine", "four_cylinder_engine",
                           "driven_slider_crank", "free_slider_crank"}) {
    const Scene scene = test::scene_file(fmt::format("scenes/{}.toml", file));
    RigidMachine machine(scene);
    Equations equations(compile(scene, Effects{}), false);
    const Model& m = machine.model();
    std::mt19937 random(2);
    std::uniform_real_distribution<double> angle(0, 4 * pi), speed(-1, 1);
    std::vector<double> slope(equations.size());
    for (int i = 0; i < 50; ++i) {
      const double phi = angle(random), omega = m.speed_scale * speed(random);
      const std::vector<double> y = equations.modes_from_scratch(0, phi, omega);
      equations.flow(0, y, slope);
      machine.set_modes(phi, omega);
      const RigidMachine::At at = machine.at(phi, omega);
      const double alpha = (at.torque - 0.5 * at.slope * omega * omega) / at.inertia;
      const double scale = (m.torque_scale + std::abs(at.torque)) / at.inertia;
      EXPECT_NEAR(slope[equations.speed_index(0)], alpha, 1e-12 * scale) << file << " " << phi << " " << omega;
    }
  }
}

// I_r of all links from the loop equations, with gears between motor and crank and two cylinders out of phase.
TEST(RigidMachine, ReducedInertiaOfTwoCylindersBehindAGearMatchesTheLoopEquations) {
  const std::string crank = R"(
kind = "slider-crank"
radius = "0.1 m"
rod = "0.35 m"
crank_inertia = "0.05 kg*m2"
rod_mass = "2 kg"
rod_com = "0.1225 m"
rod_inertia = "0.02 kg*m2"
slider_mass = "3 kg"
gravity = "9.80665 m/s2"
)";
  const Scene scene = test::scene_from(R"(
line = ["motor", "gears", "first", "second"]
[motor]
kind = "dc shunt motor"
stall_torque = "10 N*m"
no_load_speed = "120 rad/s"
inertia = "0.03 kg*m2"
[gears]
kind = "gearbox"
stages = [{ teeth = [20, 60], inertia = ["0.001 kg*m2", "0.02 kg*m2"] }]
[first])" + crank + "[second]" + crank +
                                       R"(phase = "90 deg"
[run]
start = { speed = "20 rad/s", on = "first" }
until = "1 s"
)");
  RigidMachine machine(scene);
  EXPECT_NEAR(machine.constant_inertia(), (0.03 + 0.001) * 9 + 0.02, 1e-14);
  EXPECT_EQ(machine.cycle(), 2 * pi);
  SliderCrankData d;
  d.radius = 0.1, d.rod_length = 0.35, d.crank_inertia = 0.05, d.rod_mass = 2, d.rod_com = 0.1225;
  d.rod_inertia = 0.02, d.slider_mass = 3, d.gravity = 9.80665;
  const SliderCrankGeometry geometry(d);
  for (int i = 0; i < 72; ++i) {
    const double phi = 2 * pi * i / 72;
    const auto one = geometry.inertia(phi), two = geometry.inertia(phi + pi / 2);
    const RigidMachine::Inertia em = machine.mechanism_inertia(phi);
    EXPECT_NEAR(em.value, one.value + two.value, 1e-12 * em.value);
    EXPECT_NEAR(em.slope, one.slope + two.slope, 1e-12);
    machine.set_modes(phi, 20);
    const RigidMachine::At at = machine.at(phi, 20, true);
    EXPECT_NEAR(at.inertia, machine.constant_inertia() + em.value, 1e-12);
    // Motor at 60 rad/s: 5 N·m, times three on the crank; weights by their virtual work.
    const double weight = geometry.gravity_torque(phi).value + geometry.gravity_torque(phi + pi / 2).value;
    EXPECT_NEAR(at.torque, 15 + weight, 1e-10);
    EXPECT_NEAR(at.share[0], 15, 1e-12);
  }
}

// A top-driven press: force over the last millimetres, its rise, break-through and drop, all before the lower end.
TEST(RigidMachine, PressProfileHasItsEdgesAtTheGivenTravels) {
  RigidMachine machine(test::scene_file("scenes/crank_press.toml"));
  SliderCrankData d;
  d.radius = 0.05, d.rod_length = 0.42;
  const double end = d.radius + d.rod_length;
  const auto angle_before_end = [&](double distance) {  // r cos φ + √(l² − r² sin² φ) = x, law of cosines
    const double x = end - distance;
    return 2 * pi - std::acos((x * x + d.radius * d.radius - d.rod_length * d.rod_length) / (2 * x * d.radius));
  };
  const std::vector<double> edges = machine.edges(1);
  std::vector<double> expected = {
      0, pi, angle_before_end(6e-3), angle_before_end(5.5e-3), angle_before_end(3e-3), angle_before_end(2.8e-3)};
  ASSERT_EQ(edges.size(), expected.size());
  for (std::size_t i = 0; i < edges.size(); ++i) EXPECT_NEAR(edges[i], expected[i], 1e-12) << i;
  // Between full force and break-through the force is the nominal one: M = −F x′.
  const double phi = angle_before_end(4e-3);
  const double r = d.radius, l = d.rod_length;
  const double ratio = -r * std::sin(phi) * (1 + r * std::cos(phi) / std::sqrt(l * l - std::pow(r * std::sin(phi), 2)));
  machine.set_modes(phi, 6);
  const RigidMachine::At at = machine.at(phi, 6, true);
  double useful = 0;
  for (std::size_t k = 0; k < at.share.size(); ++k)
    if (machine.model().accounts[k].kind == Account::useful) useful += at.share[k];
  EXPECT_NEAR(useful, -630e3 * ratio, 1e-9 * 630e3 * std::abs(ratio));
}

// Three plungers by table over travel with a branch for the return: each has two dead centres and a knot on either
// stroke; the knots that lie at the ends of travel are touched, not crossed, and are no edges of their own.
TEST(RigidMachine, KnotsAtTheEndsOfTravelAddNoEdges) {
  RigidMachine machine(test::scene_file("scenes/piston_pump.toml"));
  const std::vector<double> edges = machine.edges(1);
  ASSERT_EQ(edges.size(), 12U);
  for (int k = 0; k < 6; ++k) {
    EXPECT_LT(
        *std::min_element(edges.begin(), edges.end(),
                          [&](double a, double b) { return std::abs(a - k * pi / 3) < std::abs(b - k * pi / 3); }) -
            k * pi / 3,
        1e-12)
        << k;
  }
}

TEST(RigidMachine, CycleIsTwoTurnsForFourStrokes) {
  EXPECT_EQ(RigidMachine(test::scene_file("scenes/four_cylinder_engine.toml")).cycle(), 4 * pi);
  EXPECT_EQ(RigidMachine(test::scene_file("scenes/single_cylinder_engine.toml")).cycle(), 4 * pi);
  EXPECT_EQ(RigidMachine(test::scene_file("scenes/crank_press.toml")).cycle(), 2 * pi);
  EXPECT_EQ(RigidMachine(test::scene_file("scenes/six_inertia_chain.toml")).cycle(), 2 * pi);
}

TEST(RigidMachine, KnowsWhetherTimeOrSpeedMatters) {
  RigidMachine driven(test::scene_file("scenes/driven_slider_crank.toml"));
  EXPECT_TRUE(driven.uses_speed());
  EXPECT_FALSE(driven.uses_time());
  EXPECT_TRUE(driven.edges_are_of_angle());
  RigidMachine free(test::scene_file("scenes/free_slider_crank.toml"));
  EXPECT_FALSE(free.uses_speed());
  EXPECT_FALSE(free.uses_time());
  const auto with_source = [](const std::string& source) {
    return test::scene_from("line = [\"wheel\"]\n[wheel]\nkind = \"flywheel\"\ninertia = \"1 kg*m2\"\n" + source +
                            "[run]\nuntil = \"1 s\"\n");
  };
  const auto time = [&](const std::string& source) { return RigidMachine(with_source(source)).uses_time(); };
  EXPECT_FALSE(time("[s]\nkind = \"torque source\"\non = \"wheel\"\ntorque = \"5 N*m\"\n"));
  EXPECT_TRUE(time("[s]\nkind = \"torque source\"\non = \"wheel\"\ntorque = \"5 N*m\"\nstart = \"0.5 s\"\n"));
  EXPECT_TRUE(time("[s]\nkind = \"torque source\"\non = \"wheel\"\namplitude = \"5 N*m\"\nfrequency = \"3 Hz\"\n"));
  RigidMachine table(
      with_source("[s]\nkind = \"motor\"\non = \"wheel\"\ninertia = \"0.1 kg*m2\"\n"
                  "torque = { over = \"speed\", unit = [\"rad/s\", \"N*m\"], points = [[0, 5], [10, 3], "
                  "[20, 0]] }\n"));
  EXPECT_TRUE(table.uses_speed());
  EXPECT_FALSE(table.edges_are_of_angle());
}

TEST(RigidMachine, RefusesAMachineWhoseSpeedIsGiven) {
  const Scene scene = test::scene_from(R"(
line = ["drive", "wheel"]
[drive]
kind = "prescribed speed"
speed = "20 rad/s"
[wheel]
kind = "flywheel"
inertia = "1 kg*m2"
[run]
until = "1 s"
)");
  try {
    RigidMachine machine(scene);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("prescribed speed"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace kurbel::rigid_machine_test
