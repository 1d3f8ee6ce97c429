// geared_studies_test.cpp — what excites a drive from behind a gear, and what sizing and screening say, by formulas
// written out here.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "studies/advise/advise_screens.h"
#include "studies/response/excitation.h"
#include "studies/size/size.h"
#include "tests/support/scenes.h"

namespace kurbel::geared_studies_test {
namespace {

constexpr double pi = std::numbers::pi;

LinearDrive drive_of(const std::string& text, double speed) {
  const Scene scene = test::scene_from(text);
  return linearise(compile(scene, scene.effects), {.speed = speed});
}
double gain_of(const LinearDrive& d, const char* component) {
  return d.model->gain_of_node[static_cast<std::size_t>(d.model->network.ports.at(component).in)];
}
Eigen::Index coordinate_of(const LinearDrive& d, const char* component) {
  const auto node = static_cast<std::size_t>(d.model->network.ports.at(component).in);
  return std::find(d.shaft.begin(), d.shaft.end(), d.model->shaft_of_node[node]) - d.shaft.begin();  // nothing is tied
}

// --- excitations behind a gear ---

// Torques count on the shaft before the gear by 1/i; what turns i times slower has the orders r/i. A triangle from A to
// −A has the harmonics 8A/(π r)² of odd r.
TEST(GearedExcitation, TorquesAndOrdersAreThoseBeforeTheGear) {
  const LinearDrive d = drive_of(R"(
line = ["wheel", "shaft", "a", "gear", "b"]
wheel = { kind = "flywheel", inertia = "0.7 kg*m2" }
shaft = { kind = "coupling", stiffness = "900 N*m/rad" }
a = { kind = "inertia", inertia = "0.2 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 50] }, { teeth = [30, 36] }] }
b = { kind = "inertia", inertia = "3 kg*m2" }
wave = { kind = "torque source", on = "b", table = { over = "angle", unit = ["rad", "N*m"], points = [[0, 12], [3.141592653589793, -12], [6.283185307179586, 12]], period = "360 deg" } }
hum = { kind = "torque source", on = "b", amplitude = "6 N*m", frequency = "7 Hz", phase = "0.4 rad" }
effects = { elasticity = true }
run = { start = { speed = "30 rad/s" }, until = "1 s" }
)",
                                 30);
  ASSERT_NEAR(gain_of(d, "b"), 1.0 / 3, 1e-15);
  const Excitations x = find_excitations(d, 60, 4);
  EXPECT_NEAR(x.fundamental, 1.0 / 3, 1e-12);
  ASSERT_EQ(x.by_order.size(), 1u);
  EXPECT_EQ(x.by_order[0].index, coordinate_of(d, "b"));
  for (std::size_t r = 1; r <= x.harmonics; ++r) {
    const double expected = r % 2 ? 8 * 12 / std::pow(pi * static_cast<double>(r), 2) / 3 : 0;
    EXPECT_NEAR(std::abs(x.by_order[0].at(r, 41) - expected), 0, 1e-5) << r;
    EXPECT_NEAR(x.strength(r, 41), expected, 1e-5) << r;
  }
  ASSERT_EQ(x.by_frequency.size(), 1u);
  EXPECT_NEAR(x.by_frequency[0].omega, 14 * pi, 1e-12);
  EXPECT_NEAR(std::abs(x.by_frequency[0].amplitude - std::polar(2.0, 0.4 - pi / 2)), 0, 1e-12);  // of 6 N·m
  // Teeth that meet per turn of the link: the second stage's wheel turns 2.5 times slower.
  ASSERT_EQ(x.meshes.size(), 2u);
  EXPECT_NEAR(x.meshes[0].order, 20, 1e-12);
  EXPECT_NEAR(x.meshes[1].order, 30 / 2.5, 1e-12);
  // Sine sources have a mean that is not what they are at t = 0 (2 sin 0.4 N·m): none, as the triangle has.
  EXPECT_NEAR(d.mean_torque, 0, 1e-9);
}

// Two cranks with nothing but sliders: I(φ) = J + m x′²(φ), each by the square of its gear, both by that of their part
// in the mode.
TEST(GearedExcitation, VariationOfInertiaAddsTheMechanismsWithTheirPhases) {
  const double radius = 0.1, rod = 0.35, phase_one = 0.3, phase_two = 1.1;
  const LinearDrive d = drive_of(R"(
line = ["wheel", "shaft", "one", "gear", "two"]
[wheel]
kind = "flywheel"
inertia = "1.3 kg*m2"
[one]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
crank_inertia = "0.05 kg*m2"
slider_mass = "4 kg"
phase = "0.3 rad"
[shaft]
kind = "coupling"
stiffness = "900 N*m/rad"
[gear]
kind = "gearbox"
stages = [{ teeth = [20, 40] }]
[two]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
crank_inertia = "0.9 kg*m2"
slider_mass = "23 kg"
phase = "1.1 rad"
[effects]
elasticity = true
[run]
start = { speed = "20 rad/s" }
until = "1 s"
)",
                                 20);
  ASSERT_EQ(d.size(), 2);
  ASSERT_EQ(gain_of(d, "two"), 0.5);
  Eigen::VectorXd shape(2);
  shape[coordinate_of(d, "wheel")] = 0.8, shape[coordinate_of(d, "two")] = -0.45;
  const auto inertia = [&](double mass, double phi) {
    const double s = std::sin(phi), c = std::cos(phi);
    const double slope = -radius * s - radius * radius * s * c / std::sqrt(rod * rod - radius * radius * s * s);
    return mass * slope * slope;
  };
  const std::vector<double> found = inertia_variation(d, shape, 8);
  for (std::size_t r = 1; r <= 8; ++r) {
    Complex sum = 0;
    constexpr int n = 720;
    for (int k = 0; k < n; ++k) {
      const double phi = 4 * pi * k / n;  // two turns of the first, one of the second
      const double modal = 0.45 * 0.45 * (inertia(4, phi + phase_one) + inertia(23, phi / 2 + phase_two) / 4);
      sum += 2.0 / n * modal * std::polar(1.0, -2 * pi * static_cast<double>(r) * k / n);
    }
    EXPECT_NEAR(found[r], std::abs(sum), 1e-9) << r;
  }
}

// --- sizing ---

// The drive's torque over the angle stays what it is; the load that is missing is added to the scene's.
TEST(Size, WhatTheLoadLacksIsAddedToTheLoad) {
  SizeOptions options;
  options.delta = 0.04, options.mid_speed = 20, options.simulate = false;
  const Sizing s = size_flywheel(test::scene_from(R"(
line = ["engine", "wheel", "work"]
engine = { kind = "torque source", table = { over = "angle", unit = ["rad", "N*m"], points = [[0, 30], [3.141592653589793, -6], [6.283185307179586, 30]], period = "360 deg" }, inertia = "0.1 kg*m2" }
wheel = { kind = "flywheel", inertia = "2 kg*m2" }
work = { kind = "load", torque = "5 N*m" }
)"),
                                 options);
  ASSERT_TRUE(s.engine);
  EXPECT_NEAR(s.diagram.mean_torque(), 12, 1e-9);
  EXPECT_NEAR(s.diagram.work, 24 * pi, 1e-8);
  for (const double phi : {0.3, 1.0, 4.0}) {
    EXPECT_NEAR(s.diagram.drive_torque.value(phi), 12 + 18 * (1 - 2 * std::min(phi, 2 * pi - phi) / pi), 1e-9);
    EXPECT_NEAR(s.diagram.load_torque.value(phi), 12, 1e-9);
  }
}

// "the upper end of the range"
TEST(Size, CustomaryFluctuationIsTheLargestThatIsCustomary) {
  SizeOptions options;
  options.mid_speed = 20, options.simulate = false;
  for (const auto& [machine, delta] : {std::pair("press", 0.15), std::pair("machine tool", 0.05),
                                       std::pair("pump", 0.05), std::pair("crusher", 0.2)}) {
    options.machine = machine;
    const Sizing s = size_flywheel(test::scene_from(R"(
line = ["drive", "wheel", "pump"]
drive = { kind = "torque source", torque = "200 N*m" }
wheel = { kind = "flywheel", inertia = "2 kg*m2" }
pump = { kind = "slider-crank", radius = "100 mm", rod = "350 mm", crank_inertia = "0.1 kg*m2", load = { kind = "opposing", force = "500 N" } }
)"),
                                   options);
    EXPECT_EQ(s.delta, delta) << machine;
  }
}

// v = ½ D ω_max of the flywheel's own shaft, which turns 2.5 times as fast as the crank: ω_max = i ω_m (1 + ½ δ).
TEST(Size, RimSpeedIsThatOfTheFlywheelsShaft) {
  SizeOptions options;
  options.delta = 0.1, options.mid_speed = 8, options.simulate = false, options.diameter = 0.9;
  const Sizing s = size_flywheel(test::scene_from(R"(
line = ["drive", "wheel", "gear", "press"]
drive = { kind = "torque source", torque = "500 N*m" }
wheel = { kind = "flywheel", inertia = "2 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 50] }] }
press = { kind = "slider-crank", radius = "100 mm", rod = "350 mm", slider_mass = "5 kg", load = { kind = "press", nominal_force = "30 kN", nominal_travel = "30 mm" } }
)"),
                                 options);
  ASSERT_TRUE(s.dimensions) << s.dimensions_why;
  const double fastest = 2.5 * 8 * 1.05;
  EXPECT_NEAR(s.dimensions->rim_speed, 0.45 * fastest, 1e-9);
  EXPECT_NEAR(s.dimensions->energy, 0.5 * s.methods[0].flywheel.value * fastest * fastest, 1e-6 * s.dimensions->energy);
}

// --- screens ---

const Screen* screen_of(const std::vector<Screen>& screens, const std::string& name) {
  for (const Screen& s : screens)
    if (s.name == name) return &s;
  return nullptr;
}
Result run_with_elasticity(const Scene& scene) {
  return simulate(scene, scene.effects, "full", {.measure_error = false, .method = {}, .accuracy = {}, .until = {}});
}

// A free vibration of ±θ̂: ∫|τ dθ| is ½ k θ̂² in each quarter of a period. Nothing drives: it counts over the energy of
// the motion, which is that of the turning again after a whole period.
TEST(Screens, ActivityIsTheEnergyThatGoesThroughTheCoupling) {
  const double j1 = 0.3, j2 = 0.9, k = 2500, twist = 0.02, omega = std::sqrt(k * (1 / j1 + 1 / j2));
  const Scene scene = test::scene_from(fmt::format(R"(
line = ["a", "c", "b"]
a = {{ kind = "inertia", inertia = "0.3 kg*m2" }}
c = {{ kind = "coupling", stiffness = "2500 N*m/rad" }}
b = {{ kind = "inertia", inertia = "0.9 kg*m2" }}
effects = {{ elasticity = true }}
run = {{ start = {{ speed = "5 rad/s", c = {{ twist = "0.02 rad" }} }}, until = "{:.17g} s", samples = 401, accuracy = 1e-9 }}
)",
                                                   2 * pi / omega));
  const auto screens = screens_of(scene, {{"elasticity:c", "elasticity of c", "c"}}, run_with_elasticity(scene), 0.05);
  const Screen* activity = screen_of(screens.at(0), "activity");
  ASSERT_TRUE(activity);
  EXPECT_NEAR(activity->number, 4 * 0.5 * k * twist * twist / (0.5 * (j1 + j2) * 25), 1e-5);
}

// What elasticity adds to the greatest torque, mean included: |T̂ − T̂_stiff|/(T̄ + T̂_stiff).
TEST(Screens, AmplificationCountsOverTheWholeTorque) {
  const double j1 = 0.3, j2 = 0.9, k = 2500, c = 4, amplitude = 10, omega = 2 * pi * 6;
  const Scene scene = test::scene_from(R"(
line = ["a", "c", "b"]
a = { kind = "inertia", inertia = "0.3 kg*m2" }
c = { kind = "coupling", stiffness = "2500 N*m/rad", damping = "4 N*m*s/rad" }
b = { kind = "inertia", inertia = "0.9 kg*m2" }
shake = { kind = "torque source", on = "a", torque = "40 N*m", amplitude = "10 N*m", frequency = "6 Hz" }
pull = { kind = "load", on = "b", torque = "40 N*m", acts = "always" }
effects = { elasticity = true }
run = { start = { speed = "30 rad/s" }, until = "10 ms" }
)");
  const double reduced = j1 * j2 / (j1 + j2);
  const Complex spring(k, omega * c);
  const double swing = std::abs(spring * (amplitude / j1) / (spring / reduced - omega * omega)),
               still = amplitude * j2 / (j1 + j2), share = (swing - still) / (40 + still);
  const Result full = run_with_elasticity(scene);
  for (const double factor : {0.99, 1.01}) {
    const auto screens = screens_of(scene, {{"elasticity:c", "elasticity of c", "c"}}, full, factor * share);
    const Screen* found = screen_of(screens.at(0), "quasi-static amplification");
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->number, swing / still, 1e-3);
    EXPECT_EQ(found->needed, factor < 1) << share << found->verdict;
  }
}

// Twice a turn a rod that bends at ω_n vibrates by 1/(1 − (2ω/ω_n)²) as much as it sags; from ω_n = 2ω on, against it.
TEST(Screens, RodIsAmplifiedAsByItsSecondOrder) {
  const double per_length = 0.6 / 0.5, bending = 200e9 * 8e-3 * std::pow(10e-3, 3) / 12;
  const double own = std::pow(pi / 0.5, 2) * std::sqrt(bending / per_length);
  for (const double times : {1.6, 2.9, 30.0}) {
    const Scene scene = test::scene_from(fmt::format(R"(
line = ["crank"]
crank = {{ kind = "slider-crank", radius = "20 mm", rod = "500 mm", crank_inertia = "400 kg*m2", rod_mass = "0.6 kg", rod_inertia = "0.0125 kg*m2", rod_flexibility = {{ modulus = "200 GPa", height = "10 mm", width = "8 mm", modes = 1, stretching = false }} }}
run = {{ start = {{ speed = "{:.17g} rad/s" }}, until = "0.1 ms", accuracy = 1e-3 }}
)",
                                                     own / times));
    Effects effects = scene.effects;
    effects.flexible_rod = true;
    const Result full =
        simulate(scene, effects, "full", {.measure_error = false, .method = {}, .accuracy = {}, .until = {}});
    const double more = times > 2 ? 1 / (1 - 4 / (times * times)) - 1 : HUGE_VAL;
    for (const double within : {0.004, 0.005}) {
      const auto screens = screens_of(scene, {{"flexible_rod", "flexible rod"}}, full, within);
      ASSERT_EQ(screens.size(), 1u);
      ASSERT_EQ(screens[0].size(), 1u);
      EXPECT_NEAR(screens[0][0].number, times, 1e-6 * times);
      EXPECT_EQ(screens[0][0].needed, more > within) << times;
      const std::string words = times > 2 ? fmt::format("amplifies by {:.2g}", more) : "at or beyond resonance";
      EXPECT_NE(screens[0][0].verdict.find(words), std::string::npos) << screens[0][0].verdict;
    }
  }
}

}  // namespace
}  // namespace kurbel::geared_studies_test
