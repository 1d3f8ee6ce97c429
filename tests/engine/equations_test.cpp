// equations_test.cpp — the equations of compiled scenes: Jacobians, merging, d'Alembert torques, starts, standstill.
#include "engine/events/equations.h"

#include <cmath>
#include <random>

#include "studies/run/compare.h"
#include "tests/support/jacobians.h"
#include "tests/support/scenes.h"

namespace kurbel::equations_test {
namespace {

using test::figure;
using test::run;
using test::scene_from;

// Every element type in one machine: motor by Kloss, geared, elastic, loads of all laws, two slider-cranks.
const char* const everything = R"(
line = ["motor", "c1", "gearbox", "shaft", "fan", "crank1", "c2", "crank2"]
[motor]
kind = "induction motor"
rated_power = "5 kW"
rated_speed = "1440 rpm"
synchronous_speed = "1500 rpm"
breakdown_ratio = 2.5
resistance_ratio = 0.8
inertia = "0.03 kg*m2"
[c1]
kind = "coupling"
stiffness = "2 kN*m/rad"
damping = "1 N*m*s/rad"
inertia_in = "0.002 kg*m2"
inertia_out = "0.003 kg*m2"
[gearbox]
kind = "gearbox"
stages = [{ teeth = [17, 53], inertia = ["0.001 kg*m2", "0.02 kg*m2"] }, { teeth = [19, 41] }]
[shaft]
kind = "shaft"
length = "0.6 m"
diameter = "50 mm"
segments = 3
damping_ratio = 0.01
[fan]
kind = "load"
torque = "3 N*m"
damping = "0.1 N*m*s/rad"
quadratic = "0.02 N*m*s2/rad2"
inertia = "0.4 kg*m2"
[drag]
kind = "bearing drag"
damping = "0.05 N*m*s/rad"
on = "fan"
[pulse]
kind = "torque source"
on = "fan"
table = { over = "angle", unit = ["deg", "N*m"], points = [[0, 0], [90, 4], [180, -1], [270, 2]], interpolation = "smooth" }
[brush]
kind = "load"
on = "motor"
table = { over = "speed", unit = ["rad/s", "N*m"], points = [[-200, -1], [0, 0], [100, 0.4], [200, 2]] }
[crank1]
kind = "slider-crank"
radius = "40 mm"
rod = "130 mm"
offset = "6 mm"
crank_mass = "3 kg"
crank_com = "8 mm"
crank_inertia = "0.01 kg*m2"
rod_mass = "1 kg"
rod_inertia = "0.002 kg*m2"
slider_mass = "2 kg"
gravity = "9.81 m/s2"
stroke_angle = "70 deg"
load = [{ kind = "medium", viscous = "40 N*s/m", quadratic = "15 N*s2/m2" }, { kind = "opposing", force = "60 N" }, { kind = "constant", force = "-25 N" }]
[c2]
kind = "coupling"
stiffness = "30 kN*m/rad"
loss_factor = 0.05
[crank2]
kind = "slider-crank"
radius = "40 mm"
rod = "130 mm"
crank_inertia = "0.01 kg*m2"
rod_mass = "1 kg"
rod_inertia = "0.002 kg*m2"
slider_mass = "2 kg"
phase = "180 deg"
load = [{ kind = "table", force = { over = "angle", unit = ["deg", "N"], points = [[0, 800], [40, 300], [360, 20], [680, 200]] } },
        { kind = "table", force = { over = "travel", unit = ["mm", "N"], points = [[0, 90], [40, 30], [80, 10]], return_points = [[0, 20], [80, 5]] } }]
[effects]
elasticity = true
[run]
start = { speed = "70 rad/s", angle = "20 deg" }
until = "0.4 s"
)";

// A state somewhere on the way, with the modes that belong to it.
std::vector<double> moved_state(Equations& equations) {
  std::vector<double> y = equations.start(0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> some(-1, 1);
  const ErrorControl control = equations.error_control(1);
  for (std::size_t i = equations.model().angle_count(); i < equations.model().state_count(); ++i)
    y[i] += 0.02 * control.scale[i] * some(random);
  return y;
}

class JacobianOf : public ::testing::TestWithParam<const char*> {};

// ∂f/∂y from dual numbers against central differences, every entry, relative to the largest of its row.
TEST_P(JacobianOf, EqualsDifferences) {
  const Scene scene =
      std::string(GetParam()).find('\n') == std::string::npos ? test::scene_file(GetParam()) : scene_from(GetParam());
  Equations equations(compile(scene, scene.effects), false);
  const std::vector<double> y = moved_state(equations);
  test::expect_exact(test::slopes_of(equations, 0.1, y, 1e-6), equations, 2e-7);
}

INSTANTIATE_TEST_SUITE_P(Scenes, JacobianOf,
                         ::testing::Values("scenes/crank_press.toml", "scenes/driven_slider_crank.toml",
                                           "scenes/four_bar_rocker.toml", "scenes/knuckle_press.toml",
                                           "scenes/shaper.toml", "scenes/six_inertia_chain.toml", everything));

TEST(Compile, RigidMachineHasOneCoordinateWithInertiasBySquareOfRatio) {
  const Scene scene = scene_from(everything);
  const auto model = compile(scene, Effects{});
  ASSERT_EQ(model->free_shafts, 1u);
  ASSERT_EQ(model->elastic.size(), 0u);
  // All on crank1; motor side turns i = 53/17 · 41/19 times as fast.
  const double i = 53.0 / 17 * 41 / 19, i2 = 41.0 / 19;
  const double polar = M_PI / 32 * std::pow(0.05, 4);
  const double expected = (0.03 + 0.002 + 0.003 + 0.001) * i * i + 0.02 * i2 * i2 + 7850 * polar * 0.6 + 0.4;
  EXPECT_NEAR(model->shafts[0].inertia, expected, 1e-12 * expected);
  EXPECT_EQ(model->node_label(model->shafts[0].reference), "crank1");
}

TEST(Compile, SwitchedOffElasticityLeavesNoTrace) {
  // The coupling's stiffness may stay in the file; states, Jacobian entries and results are those of a scene without
  // it.
  const std::string rest =
      "[a]\nkind = \"inertia\"\ninertia = \"1 kg*m2\"\n[b]\nkind = \"load\"\nquadratic = \"0.1 N*m*s2/rad2\"\ninertia "
      "= \"2 kg*m2\"\n"
      "[drive]\nkind = \"torque source\"\ntorque = \"5 N*m\"\non = \"a\"\n[run]\nuntil = \"1 s\"\n";
  const Scene with = scene_from("line = [\"a\", \"c\", \"b\"]\n" + rest +
                                "[c]\nkind = \"coupling\"\nstiffness = \"1 kN*m/rad\"\ndamping_ratio = 0.1\n");
  const Scene without = scene_from("line = [\"a\", \"b\"]\n" + rest);
  const auto off = compile(with, with.effects), absent = compile(without, without.effects);
  EXPECT_EQ(off->state_count(), absent->state_count());
  EXPECT_EQ(off->jacobian.pattern.row.size(), absent->jacobian.pattern.row.size());
  EXPECT_EQ(off->pools.size(), absent->pools.size());
  const Result a = run(with), b = run(without);
  EXPECT_EQ(figure(a, "final_speed.b"), figure(b, "final_speed.b"));
  EXPECT_EQ(a.statistics.stepper.flow_calls, b.statistics.stepper.flow_calls);
}

// Free two-mass machine, torque M on J1: a rigid coupling transmits M J2/(J1 + J2).
TEST(MergedCoupling, TransmitsTorqueByDAlembert) {
  const Result r = run(R"(
line = ["a", "c", "b"]
[a]
kind = "inertia"
inertia = "1 kg*m2"
[c]
kind = "coupling"
stiffness = "1 kN*m/rad"
inertia_in = "0.25 kg*m2"
inertia_out = "0.75 kg*m2"
[b]
kind = "inertia"
inertia = "2 kg*m2"
[drive]
kind = "torque source"
torque = "8 N*m"
on = "a"
)");
  EXPECT_NEAR(figure(r, "peak_torque.c"), 8 * 2.75 / 4, 1e-12);
  EXPECT_NEAR(figure(r, "rms_torque.c"), 8 * 2.75 / 4, 1e-9);
  EXPECT_NEAR(figure(r, "final_speed.b"), 8.0 / 4 * 1, 1e-9);
}

const char* const two_masses = R"(
line = ["a", "c", "b"]
[a]
kind = "inertia"
inertia = "1 kg*m2"
[c]
kind = "coupling"
stiffness = "1 kN*m/rad"
[b]
kind = "inertia"
inertia = "3 kg*m2"
[drive]
kind = "torque source"
torque = "8 N*m"
on = "a"
[effects]
elasticity = true
[run]
until = "2 s"
accuracy = 1e-8
)";

// theory 5.13: from rest the peak is twice M J2/(J1 + J2); started in equilibrium nothing rings.
TEST(TwoMasses, StepFromRestRingsToTwiceTheRigidTorque) {
  const Result r = run(two_masses);
  EXPECT_NEAR(figure(r, "peak_spring_torque.c"), 2 * 6.0, 1e-7);
  EXPECT_NEAR(r.find("peak_spring_torque.c")->at.value(), M_PI / std::sqrt(1e3 * (1 + 1.0 / 3)), 1e-7);
}
TEST(TwoMasses, StartInEquilibriumDoesNotRing) {
  const Result r = run(std::string(two_masses) + "start = \"equilibrium\"\n");
  EXPECT_NEAR(figure(r, "peak_torque.c"), 6.0, 1e-9);
  EXPECT_NEAR(figure(r, "rms_torque.c"), 6.0, 1e-8);
}

// J ω̇ = −M_dry holds until rest; a torque below the limit then moves nothing, above it the rest of the ramp
// accelerates.
TEST(Standstill, HeldUntilTheTorqueExceedsTheLimit) {
  const Result r = run(R"(
line = ["rotor"]
[rotor]
kind = "inertia"
inertia = "2 kg*m2"
[brake]
kind = "load"
torque = "5 N*m"
on = "rotor"
[drive]
kind = "torque source"
on = "rotor"
table = { over = "time", unit = ["s", "N*m"], points = [[0, 0], [1, 10]] }
[run]
until = "1 s"
accuracy = 1e-9
)");
  // Moves from t = 0.5 s on; ω(1) = ∫(10 t − 5)/2 dt from 0.5 to 1.
  EXPECT_NEAR(figure(r, "final_speed.rotor"), 0.625, 1e-9);
  EXPECT_NEAR(figure(r, "final_angle.rotor"), 10.0 / 12 * 0.125, 1e-9);
  ASSERT_FALSE(r.events.empty());
  EXPECT_NEAR(r.events.front().t, 0.5, 1e-9);
  EXPECT_EQ(r.events.front().what, "moves forwards");
  EXPECT_LE(r.energy.relative, 1e-9);
}

// Dry friction reverses with the motion: M sin(ω t) above the limit moves the rotor to and fro, and energy balances.
TEST(Standstill, FrictionReversesWithTheMotion) {
  const Result r = run(R"(
line = ["rotor"]
[rotor]
kind = "inertia"
inertia = "0.5 kg*m2"
[brake]
kind = "load"
torque = "2 N*m"
on = "rotor"
[drive]
kind = "torque source"
amplitude = "9 N*m"
frequency = "3 Hz"
on = "rotor"
[run]
until = "5 s"
accuracy = 1e-7
)");
  EXPECT_LE(r.energy.relative, 1e-7);
  EXPECT_GT(r.events.size(), 20u);
}

// ∫M dt = J Δω, to the last digits because the switching times are grid points.
TEST(Window, SourceActsExactlyBetweenItsTimes) {
  const Result r = run(R"(
line = ["rotor"]
[rotor]
kind = "inertia"
inertia = "2 kg*m2"
[drive]
kind = "torque source"
torque = "7 N*m"
start = "0.1234567 s"
stop = "0.7654321 s"
on = "rotor"
)");
  EXPECT_NEAR(figure(r, "final_speed.rotor"), 7 * (0.7654321 - 0.1234567) / 2, 1e-13);
  ASSERT_EQ(r.events.size(), 2u);
  EXPECT_EQ(r.events[0].what, "on");
  EXPECT_EQ(r.events[1].t, 0.7654321);
}

// The reaction of a prescribed speed does the work: ∫M ω dt = ½ J ω² + drag b ∫ω² dt.
TEST(PrescribedSpeed, ItsReactionDoesTheWork) {
  const Result r = run(R"(
line = ["drive", "c", "rotor"]
[drive]
kind = "prescribed speed"
speed = "10 rad/s"
ramp = "0.5 s"
[c]
kind = "coupling"
stiffness = "1 kN*m/rad"
[rotor]
kind = "load"
damping = "0.3 N*m*s/rad"
inertia = "2 kg*m2"
[run]
until = "1 s"
accuracy = 1e-8
)");
  const double drag = 0.3 * (100.0 / 3 * 0.5 + 100 * 0.5);
  EXPECT_NEAR(figure(r, "work.useful"), -drag, 1e-7);
  EXPECT_NEAR(figure(r, "work.driving"), drag + 0.5 * 2 * 100, 1e-6);
  EXPECT_NEAR(figure(r, "peak_torque.c"), 2 * 20 + 3, 1e-6);  // at the end of the ramp
}

// Work of a torque over the angle in one turn is the integral of its table: two periods of 90·4/2 + 30·4 + 60·4/2
// degrees.
TEST(TableOverAngle, DoesTheWorkOfItsArea) {
  const Result r = run(R"(
line = ["rotor"]
[rotor]
kind = "inertia"
inertia = "50 kg*m2"
[drive]
kind = "torque source"
on = "rotor"
table = { over = "angle", unit = ["deg", "N*m"], points = [[0, 0], [90, 4], [120, 4], [180, 0]], period = "180 deg" }
[run]
start = { speed = "6 rad/s" }
until = "10 s"
accuracy = 1e-9
)");
  // Energy integral: ½ J (ω² − ω₀²) = turns · area + the part of the last period, checked over whole periods by the
  // mean.
  const double area = (90 * 4 / 2.0 + 30 * 4 + 60 * 4 / 2.0) * M_PI / 180;
  const double angle = figure(r, "final_angle.rotor"), turned = std::fmod(angle, M_PI),
               periods = std::floor(angle / M_PI);
  const double deg = turned * 180 / M_PI;
  const double part = deg < 90    ? deg * deg * 4 / 90 / 2
                      : deg < 120 ? 180 + (deg - 90) * 4
                                  : 300 + (deg - 120) * 4 - (deg - 120) * (deg - 120) * 4 / 60 / 2;
  EXPECT_NEAR(figure(r, "work.driving"), periods * area + part * M_PI / 180, 1e-7);
  EXPECT_LE(r.energy.relative, 1e-9);
}

TEST(Everything, BalancesItsEnergyAndKeepsItsAngles) {
  const Result r = run(everything);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_LE(r.energy.relative, 1e-5);
  EXPECT_LE(r.energy.reduction_residual, 1e-12);
  EXPECT_TRUE(r.accuracy_confirmed) << r.measured_accuracy;
}

}  // namespace
}  // namespace kurbel::equations_test
