// motions_not_balances_test.cpp — what is said of a machine is what it does: families keep their member, losses by the load
// count everywhere, edges are examined on both sides, a search that fails is no physics, round-off is no verdict.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "engine/numerics/index.h"
#include "engine/orbit/orbit.h"
#include "studies/forces/forces_findings.h"
#include "studies/modes/modes.h"
#include "studies/run/run_findings.h"
#include "studies/size/size.h"
#include "studies/steady/steady.h"
#include "tests/support/conclusions.h"
#include "tests/support/scenes.h"
#include "tests/support/waiting.h"

namespace kurbel::test::motions_not_balances_test {
namespace {

constexpr double pi = std::numbers::pi, rpm = pi / 30;

Scene report(const std::string& name) { return scene_file("tests/cases/reports/" + name + ".toml"); }

const Figure& figure_of(const SteadyCycle& cycle, const std::string& name) {
  static const Figure none{};
  const Figure* f = cycle.find(name);
  EXPECT_NE(f, nullptr) << name;
  return f ? *f : none;
}
// Within its stated error, which is no larger than `most` of the value.
void expect_stated(const Figure& f, double right, double most) {
  ASSERT_TRUE(f.error) << f.name;
  EXPECT_NEAR(f.value, right, *f.error + 1e-12 * std::abs(right)) << f.name;
  EXPECT_LE(*f.error, most * std::abs(right)) << f.name;
}

std::string refused(const std::function<void()>& ask) {
  try {
    ask();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// --- 4: what is conserved is as at the start ---

TEST(Family, TwoFlywheelsKeepTheirMomentum) {
  const Scene scene = report("steady_of_a_family");
  const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
  ASSERT_TRUE(study.complete) << study.diagnosis;
  EXPECT_TRUE(study.cycles[0].neutral);
  expect_stated(figure_of(study.cycles[0], "mean_speed." + study.link), 10 / 2.1, 1e-6);
}

// Any inertias, damping and speeds at the start: Σ J ω stays, and it is what all turn with in the end.
TEST(Family, RandomPairsKeepTheirMomentum) {
  std::mt19937 random(41);
  for (int k = 0; k < 24; ++k) {
    const double a = uniform(random, 0.2, 3), b = uniform(random, 0.2, 3), out = uniform(random, 0.02, 0.3);
    const double w = uniform(random, 3, 30), stiffness = std::pow(10, uniform(random, 1.5, 4));
    const double damping = std::sqrt(stiffness) * uniform(random, 0.02, 0.6);
    const std::string text = fmt::format(R"(
line = ["a", "clutch", "shaft", "b"]
a = {{ kind = "flywheel", inertia = "{} kg*m2" }}
clutch = {{ kind = "clutch", torque = "50 N*m", inertia_out = "{} kg*m2" }}
shaft = {{ kind = "coupling", stiffness = "{} N*m/rad", damping = "{} N*m*s/rad" }}
b = {{ kind = "flywheel", inertia = "{} kg*m2" }}
effects = {{ elasticity = true }}
run = {{ start = {{ a = {{ speed = "{} rad/s" }} }}, until = "4 s" }}
)",
                                         a, out, stiffness, damping, b, w);
    const Scene scene = scene_from(text);
    const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
    ASSERT_TRUE(study.complete) << text << study.diagnosis;
    expect_stated(figure_of(study.cycles[0], "mean_speed." + study.link), a * w / (a + out + b), 1e-5);
  }
}

// Behind a differential whose outputs are free two quantities are kept: with T of a on the case each output gets i T/2, so that
// J_a ω_a + 2 J_l ω_l/i and J_l ω_l − J_r ω_r stay.
TEST(Family, AFreeDifferentialKeepsBothOfItsMomenta) {
  std::mt19937 random(44);
  for (int k = 0; k < 24; ++k) {
    const double a = uniform(random, 0.2, 3), l = uniform(random, 0.2, 3), r = uniform(random, 0.2, 3), i = 1 + k % 3;
    const double wa = uniform(random, 3, 30), wl = uniform(random, 0, 5), wr = uniform(random, -5, 5);
    const double stiffness = std::pow(10, uniform(random, 1, 4)),
                 damping = std::sqrt(stiffness) * uniform(random, 0.1, 6);
    const std::string text = fmt::format(R"(
line = ["a", "shaft", "axle", "left"]
a = {{ kind = "flywheel", inertia = "{} kg*m2" }}
shaft = {{ kind = "coupling", stiffness = "{} N*m/rad", damping = "{} N*m*s/rad" }}
axle = {{ kind = "differential", ratio = {} }}
left = {{ kind = "flywheel", inertia = "{} kg*m2" }}
right = {{ kind = "flywheel", inertia = "{} kg*m2" }}
effects = {{ elasticity = true }}
run = {{ start = {{ a = {{ speed = "{} rad/s" }}, left = {{ speed = "{} rad/s" }}, right = {{ speed = "{} rad/s" }} }}, until = "4 s" }}
[[branch]]
from = "axle.second"
line = ["right"]
)",
                                         a, stiffness, damping, i, l, r, wa, wl, wr);
    const Scene scene = scene_from(text);
    const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
    ASSERT_TRUE(study.complete) << text << study.diagnosis;
    // ω_a = i (ω_l + ω_r)/2 in the end.
    const double sum = a * wa + 2 * l * wl / i, difference = l * wl - r * wr;
    const double left = (sum + a * i * difference / (2 * r)) / (a * i / 2 * (1 + l / r) + 2 * l / i);
    expect_stated(figure_of(study.cycles[0], "mean_speed." + study.link), (sum - 2 * l * left / i) / a, 1e-5);
  }
}

// A free crank keeps its energy, which is no linear function of the state: T at the section is T at the start.
TEST(Family, AFreeCrankKeepsTheEnergyOfItsStart) {
  const auto model = compile(scene_file("scenes/free_slider_crank.toml"), Effects{});
  const Orbit orbit = find_orbit(model, {});
  ASSERT_TRUE(orbit.repeats()) << orbit.words;
  Equations equations(model, false);
  const std::vector<double> start = equations.start(0);
  const double before = equations.kinetic_energy(0, start);
  const std::vector<double> now = orbit.map->place(equations, orbit.point.z);
  EXPECT_NEAR(equations.kinetic_energy(orbit.state.t, now), before, 1e-7 * before);
}

// --- 5: losses by the load are in every number ---

// The mill's cycle by hand: ½ J ω² = ½ J ω₀² + (1/η) ∫(500 N·m − M) dφ.
double mean_speed_of_the_mill() {
  const double j = 10, w0 = 300 * rpm, eta = 0.8;
  constexpr int n = 20000;
  double time = 0;
  for (int i = 0; i < n; ++i) {
    const double phi = 2 * pi * (i + 0.5) / n, half = phi < pi ? phi : phi - pi;
    const double gain = (phi < pi ? 1 : -1) * (100 * half - 100 * half * half / pi) / eta;
    time += 5 * (2 * pi / n) / std::sqrt(w0 * w0 + 2 * gain / j);
  }
  return 10 * pi / time;
}

TEST(LossesByTheLoad, BalanceTheMill) {
  const Scene scene = report("steady_with_gear_losses");
  const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
  ASSERT_TRUE(study.complete) << study.diagnosis;
  const Figure& mean = figure_of(study.cycles[0], "mean_speed." + study.link);
  EXPECT_NEAR(mean.value, mean_speed_of_the_mill(), 1e-6 * mean.value);
  EXPECT_NEAR(mean.value, 300 * rpm, 2e-4 * mean.value);
}

// M_s (1 − ω/ω₀) = T/(i η): 500 rpm, not 600; with no inertia but the motor's the way there is 1 − e^(−t/τ), τ = J ω₀/M_s.
TEST(LossesByTheLoad, SetOperatingPointAndStart) {
  const Scene scene = scene_from(R"(
line = ["motor", "gear", "load"]
motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "1000 rpm", inertia = "0.09 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 100] }], efficiency = 0.8 }
load = { kind = "load", torque = "120 N*m" }
run = { start = { speed = "400 rpm" } }
)");
  const SteadyStudy study = steady(scene, {scene.effects}, {});
  ASSERT_TRUE(study.complete) << study.diagnosis;
  ASSERT_TRUE(study.diagram);
  const OperatingPoint* point = study.diagram->working_point();
  ASSERT_TRUE(point);
  EXPECT_FALSE(study.diagram->estimate);
  EXPECT_NEAR(point->speed.value, 500 * rpm, *point->speed.error + 1e-9);
  EXPECT_LT(*point->speed.error, 1e-6);
  EXPECT_NEAR(figure_of(study.cycles[0], "mean_speed." + study.link).value, 500 * rpm, 1e-8);
  ASSERT_TRUE(study.start && study.start->reached);
  EXPECT_NEAR(study.start->time.value, 0.09 * 1000 * rpm / 60 * std::log(20), *study.start->time.error + 1e-9);
}

// Static torques are no motion of a motor with states of its own: what they say is an estimate, which has no error.
TEST(LossesByTheLoad, PointsOfAMachineWithInternalStatesHaveNoError) {
  const Scene scene = scene_file("tests/agreement/two_axis_motor.toml");
  const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
  ASSERT_TRUE(study.complete && study.diagram) << study.diagnosis;
  const OperatingPoint* point = study.diagram->working_point();
  ASSERT_TRUE(point);
  EXPECT_TRUE(study.diagram->estimate);
  EXPECT_FALSE(point->speed.error || point->torque.error || study.diagram->margin(*point).error);
}

// --- 6: edges ---

TEST(Edges, OfAPressAtGivenSpeedAreLookedAtOnBothSides) {
  const Forces f = find_forces(report("press_forces_edge"), {});
  ASSERT_TRUE(f.prescribed && f.simulated);
  EXPECT_NEAR(std::abs(f.simulated->torque.value), 275.089e3, 1);
  EXPECT_LT(*f.simulated->torque.error, 1);
  const std::string conclusion = findings_of(f).conclusion();
  EXPECT_TRUE(has(conclusion, "the balancing torque peaks at 275.1 kN")) << conclusion;
}

// Presses of any size, either way round and at any speed: a machine at given speed needs what the first problem says.
TEST(Edges, OfRandomPressesLeaveNoErrorOfTheirSize) {
  std::mt19937 random(42);
  for (int k = 0; k < 24; ++k) {
    const double radius = uniform(random, 20, 150), speed = uniform(random, 5, 300) * (k % 2 ? -1 : 1);
    const std::string text =
        fmt::format(R"(
line = ["drive", "press"]
drive = {{ kind = "prescribed speed", speed = "{} rpm" }}
press = {{ kind = "slider-crank", radius = "{} mm", rod = "{} mm", load = {{ kind = "press", nominal_force = "{} kN", nominal_travel = "{} mm" }} }}
run = {{ start = {{ speed = "{} rpm", angle = "{} deg" }}, until = "{} s" }}
)",
                    speed, radius, radius * uniform(random, 2, 12), uniform(random, 50, 8000),
                    radius * uniform(random, 0.02, 0.3), speed, uniform(random, 0, 360), 140 / std::abs(speed));
    const Forces f = find_forces(scene_from(text), {});
    ASSERT_TRUE(f.prescribed && f.simulated) << text;
    const double right = std::abs(f.prescribed->torque.value);
    EXPECT_NEAR(std::abs(f.simulated->torque.value), right, 1e-6 * right) << text;
    EXPECT_LT(*f.simulated->torque.error, 1e-6 * right) << text;
  }
}

// What an error hides is not nothing.
TEST(Edges, WhatIsNotReportedFromZeroIsNotCalledNothing) {
  Peak p{{300, 400}};
  p.scale = 1000;
  EXPECT_FALSE(is_nothing(p));
  EXPECT_TRUE(has(in_words(p, "N*m"), "less than 700 N·m"));
  p = {{1e-10, 1e-9}};
  p.scale = 1000;
  EXPECT_TRUE(is_nothing(p));
}

// --- 7: a search that fails ---

// δ = 0.9 A/(I ω_mid²), A = E/η.
double delta_of_the_punch(double inertia) {
  return 0.9 * 10.5e3 * 36 * pi / 180 / 0.76 / (inertia * std::pow(216 * rpm, 2));
}

TEST(FailedSearches, OfTheLossyPunchFindItsCycle) {
  const Scene scene = report("lossy_geared_punch");
  const SteadyStudy study = steady(scene, {scene.effects}, {.mid_speed = 216 * rpm, .start_search = false});
  ASSERT_TRUE(study.complete) << study.diagnosis;
  const SteadyCycle& c = study.cycles[0];
  EXPECT_NEAR(delta_of_the_punch(38.17), 0.400, 1e-3);
  EXPECT_NEAR(figure_of(c, "delta." + study.link).value, delta_of_the_punch(38.17), 1e-6);
  EXPECT_NEAR(c.added_torque, 10.5e3 * 36 * pi / 180 / 0.76 / (18 * pi) - 153.508, 1e-5);
}

// Too little inertia to come through the stroke at 20 rpm: no cycle is found, and the words are those of a search.
TEST(FailedSearches, AreNotReportedAsMotions) {
  const Scene scene = report("lossy_geared_punch");
  const SteadyStudy study = steady(scene, {scene.effects}, {.mid_speed = 20 * rpm, .start_search = false});
  EXPECT_FALSE(study.complete);
  EXPECT_TRUE(has(study.diagnosis, "search")) << study.diagnosis;
  EXPECT_FALSE(has(study.conclusion, "is stopped within the cycle and driven backwards,")) << study.conclusion;
}

TEST(LossesByTheLoad, AreInTheFlywheelOfThePunchAndInItsMotor) {
  SizeOptions options;
  options.delta = 0.4, options.mid_speed = 216 * rpm;
  const Sizing s = size_flywheel(report("lossy_geared_punch"), options);
  const double right = 38.17 * delta_of_the_punch(38.17) / 0.4;
  EXPECT_NEAR(s.methods.front().flywheel.value, right, 1e-4 * right);
  ASSERT_TRUE(s.punch);
  EXPECT_NEAR(s.punch->power(), 10.5e3 * 36 * pi / 180 / 0.76 / (9 / (216 / 60.0)), 1);
}

// The motor gives the stroke's energy over the time between strokes, which the middle of a wide range of speeds is not.
TEST(LossesByTheLoad, TheTimeBetweenStrokesIsThatOfTheMotion) {
  const Scene scene = test::scene_file("scenes/crank_press.toml");
  SizeOptions options;
  options.delta = 0.05, options.basis = CycleBasis::steady;
  const Sizing s = size_flywheel(scene, options);
  ASSERT_TRUE(s.punch);
  const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
  const double period = figure_of(study.cycles[0], "period").value;
  EXPECT_NEAR(s.punch->cycle_time, period, 1e-5 * period);
}

// --- 8: round-off ---

TEST(RoundOff, OfAConservativeMachineIsNoVerdict) {
  const Scene scene = report("conservative_four_bar");
  const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
  EXPECT_TRUE(study.complete) << study.diagnosis;
  EXPECT_FALSE(has(study.conclusion, "slows down") || has(study.conclusion, "accelerates")) << study.conclusion;
  // Between 94.87° and 364.87°, where its energy is that of the start.
  ASSERT_EQ(study.cycles.at(0).kind, Orbit::Kind::vibrating) << study.conclusion;
  EXPECT_NEAR(figure_of(study.cycles[0], "vibration_amplitude.bar").value, 0.75 * pi, 1e-4);
}

TEST(RoundOff, OfRandomConservativeMachinesIsNoVerdict) {
  std::mt19937 random(43);
  for (int k = 0; k < 16; ++k) {
    const double mass = uniform(random, 1, 60), com = uniform(random, 0.1, 2);
    const std::string text = fmt::format(R"(
line = ["bar"]
bar = {{ kind = "slider-crank", radius = "{0} m", rod = "{1} m", offset = "{2} m", crank_mass = "{3} kg", crank_com = "{4} m", crank_inertia = "{5} kg*m2", rod_mass = "{3} kg", rod_com = "{4} m", rod_inertia = "{5} kg*m2", slider_mass = "{6} kg", gravity = "9.81 m/s2", stroke_angle = "{7} deg" }}
run = {{ start = {{ angle = "{8} deg", speed = "3 rad/s" }}, until = "10 s" }}
)",
                                         uniform(random, 0.5, 2), uniform(random, 3, 9), uniform(random, -0.4, 0.4),
                                         mass, com, mass * com * com + uniform(random, 1, 300), uniform(random, 1, 90),
                                         uniform(random, 0, 360), uniform(random, 0, 360));
    const Scene scene = scene_from(text);
    SteadyStudy study;
    const std::string why = refused([&] { study = steady(scene, {scene.effects}, {.start_search = false}); });
    EXPECT_TRUE(has(why, "family") || (study.complete && study.cycles.at(0).kind == Orbit::Kind::vibrating))
        << text << why << study.conclusion;
    EXPECT_FALSE(has(why, "slows down") || has(why, "accelerates")) << text << why;
  }
}

// --- motions that are no rotation ---

// The link's rest is what the run says: 21.1972132 s. Until the motor goes off the machine keeps the motion of the scene
// without a sequence.
TEST(MotorSwitchedOff, RestsWhenTheRunSays) {
  const Scene scene = report("motor_switched_off");
  const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
  EXPECT_TRUE(study.complete) << study.diagnosis;
  EXPECT_TRUE(has(study.conclusion, "comes to rest at 21.2 s")) << study.conclusion;
  EXPECT_TRUE(has(study.conclusion, "before step 1")) << study.conclusion;
  Scene running = scene;
  running.sequence = {};
  const SteadyStudy alone = steady(running, {scene.effects}, {.start_search = false});
  const Figure &mean = figure_of(study.cycles.at(0), "mean_speed.press"),
               &same = figure_of(alone.cycles.at(0), "mean_speed.press");
  EXPECT_NEAR(mean.value, same.value, *mean.error + *same.error);
}

// A rigid machine that its losses hold, too: the wedge at 2.0608 s. The last step that still turned ends before that.
TEST(MotorSwitchedOff, RestsWhenItsLossesHoldIt) {
  const Scene scene = test::scene_file("scenes/wedge_lift.toml");
  const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
  const Result run = test::run(scene, false);
  ASSERT_TRUE(run.periods.standstill);
  EXPECT_TRUE(has(study.conclusion, fmt::format("comes to rest at {:.4g} s", *run.periods.standstill)))
      << study.conclusion << ' ' << *run.periods.standstill;
}

// Off at 20 s, J ω̇ = −c ω − M, J = 2 kg·m², c = 2 N·m·s/rad: ω = (ω₀ + M/c) e^(−ct/J) − M/c. Where M is no more than
// round-off of the loads, or less than c ω at 0.1 % of the rated speed, it holds what by then is slow: at rest is what turns
// slower than that. Where M is more, the machine rests when it ends the motion.
TEST(SwitchedOff, RestsWhenItIsSlowOrHeld) {
  constexpr double least = 0.2;  // c ω at 0.1 % [N·m]
  for (const double friction : {0.0, 1e-8, 0.5 * least, 0.95 * least, 1.05 * least, 1.0, 20.0}) {
    const Scene scene = scene_from(fmt::format(R"(line = ["motor", "rotor"]
motor = {{ kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2", stop = "20 s" }}
rotor = {{ kind = "load", torque = "{} N*m", damping = "2 N*m*s/rad", inertia = "1 kg*m2" }}
run = {{ until = "80 s", method = "auto" }}
)",
                                               friction));
    const double still = 1e-3 * compile(scene, scene.effects)->speed_scale, speed = (100 - friction) / 3,
                 rest = 20 + std::log((speed + friction / 2) / ((friction > least ? 0 : still) + friction / 2));
    const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
    const char* words =
        friction > least ? "comes to rest at {:.4g} s" : "below 0.1 % of its rated speed from {:.4g} s on";
    EXPECT_TRUE(has(study.conclusion, fmt::format(fmt::runtime(words), rest))) << study.conclusion << ' ' << rest;
    const Result run = test::run(scene, false);
    ASSERT_TRUE(run.periods.standstill);
    EXPECT_NEAR(*run.periods.standstill, rest, 1e-6) << friction;
  }
}
// The gear's bearings hold it before the rotor, J = 2.01 kg·m², is slow, shortly before that, and between then and its rest.
TEST(SwitchedOff, RestsWhenItsOwnShaftIsHeld) {
  for (const double bearing : {6.0, 4.0, 3.742}) {
    const Scene scene = scene_from(fmt::format(R"(line = ["motor", "gear", "clutch", "rotor", "press"]
motor = {{ kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2", stop = "30 s" }}
gear = {{ kind = "gearbox", stages = [{{ teeth = [20, 20] }}], bearing_torque = "{} N*m", efficiency = 0.9 }}
clutch = {{ kind = "clutch", torque = "500 N*m" }}
rotor = {{ kind = "load", torque = "0.15 N*m", damping = "1 N*m*s/rad", inertia = "2 kg*m2" }}
press = {{ kind = "slider-crank", radius = "1 mm", rod = "4 mm", slider_mass = "0.1 kg", crank_inertia = "0.01 kg*m2" }}
sequence = {{ steps = [{{ at = "0 s", set = "clutch" }}, {{ at = "30 s", set = "clutch", to = 0 }}] }}
run = {{ until = "80 s" }}
)",
                                               bearing));
    const double speed = (90 - bearing - 0.15) / 1.9, rest = 30 + 2.01 * std::log((speed + 0.15) / 0.15);
    EXPECT_NEAR(test::run(scene, false).periods.standstill.value_or(0), rest, 1e-5) << bearing;
    const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
    EXPECT_TRUE(has(study.conclusion, fmt::format("comes to rest at {:.4g} s", rest))) << study.conclusion;
  }
}

// A vibration about zero is a steady motion: |φ| = M/√((k − Jω²)² + (cω)²), of which the speed is ω times as much.
TEST(OscillationsAboutZero, AreASteadyMotion) {
  const Scene scene = report("swings_about_zero");
  const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
  EXPECT_TRUE(study.complete) << study.diagnosis;
  const double w = 2 * pi * 13, amplitude = 100 / std::hypot(1e4 - w * w, 40 * w);
  const SteadyCycle& cycle = study.cycles.at(0);
  EXPECT_EQ(cycle.kind, Orbit::Kind::vibrating) << cycle.orbit;
  EXPECT_NEAR(figure_of(cycle, "cycle_max_speed.disc").value, w * amplitude, 1e-8);
  EXPECT_NEAR(figure_of(cycle, "vibration_amplitude.disc").value, amplitude, 1e-10);
  EXPECT_NEAR(figure_of(cycle, "vibration_frequency").value, 13, 1e-12);
  // Its orders: the first alone, with the phase of M sin ωt, which a whole cycle of the excitation gives.
  for (const auto& [name, exact] :
       {std::pair{"angle_order.1.disc", amplitude}, {"speed_order.1.disc", w * amplitude}}) {
    const Figure& order = figure_of(cycle, name);
    ASSERT_TRUE(order.error);
    EXPECT_NEAR(order.value, exact, std::max(*order.error, 1e-9 * exact));
    EXPECT_LT(*order.error, 1e-6 * exact);
  }
  const double behind = std::atan2(40 * w, 1e4 - w * w) + pi / 2;
  const Figure& phase = figure_of(cycle, "angle_order_phase.1.disc");
  EXPECT_NEAR(std::cos(phase.value * pi / 180 - behind), 1, 1e-10) << phase.value;
  EXPECT_EQ(cycle.find("angle_order.2.disc"), nullptr);
}

// Without damping nothing requires a period: the disc vibrates at ω = √(k/J) with the amplitude ω₀/ω of its start.
TEST(OscillationsAboutZero, ByThemselvesKeepTheEnergyOfTheirStart) {
  std::mt19937 random(7);
  for (int k = 0; k < 3; ++k) {
    const double stiffness = uniform(random, 2e3, 5e4), inertia = uniform(random, 0.2, 5),
                 speed = uniform(random, 0.5, 3);
    const Scene scene = scene_from(fmt::format(R"(
line = ["disc", "shaft", "wall"]
disc = {{ kind = "flywheel", inertia = "{} kg*m2" }}
shaft = {{ kind = "coupling", stiffness = "{} N*m/rad" }}
wall = {{ kind = "prescribed speed", speed = "0 rad/s" }}
effects = {{ elasticity = true }}
run = {{ start = {{ on = "disc", speed = "{} rad/s" }}, until = "4 s" }}
)",
                                               inertia, stiffness, speed));
    const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
    ASSERT_TRUE(study.complete) << study.diagnosis;
    const SteadyCycle& cycle = study.cycles.at(0);
    const double w = std::sqrt(stiffness / inertia);
    const Figure &frequency = figure_of(cycle, "vibration_frequency"),
                 &way = figure_of(cycle, "vibration_amplitude.disc");
    EXPECT_NEAR(frequency.value, w / (2 * pi), 1e-8 * w);
    EXPECT_NEAR(way.value, speed / w, 1e-6 * speed / w);
    EXPECT_NEAR(way.value, speed / w, *way.error);
    const Figure& order = figure_of(cycle, "angle_order.1.disc");
    EXPECT_NEAR(order.value, speed / w, *order.error + *way.error);
  }
}

// Open by command all the time, it carries nothing and cannot let go.
TEST(OpenClutch, LetsNothingGo) {
  const Result result = run(report("open_clutch"));
  EXPECT_FALSE(has(findings_of(result).conclusion(), "\"clutch\" slips")) << findings_of(result).conclusion();
}

// --- that wait ---

// Order 1 of the fan meets the mode at 1198 rpm.
TEST(CrossingBelowBreakdown, IsListed) {
  waits_for_part(9, [] {
    const Scene scene = report("crossing_below_breakdown");
    ModesOptions options;
    options.slowest = 1000 * rpm, options.fastest = 1500 * rpm;
    const ModesStudy study = find_modes(scene, scene.effects, options);
    EXPECT_TRUE(std::any_of(study.critical.begin(), study.critical.end(), [](const CriticalSpeed& c) {
      return c.order == 1 && std::abs(c.speed - 1198 * rpm) < 1 * rpm;
    }));
  });
}

}  // namespace
}  // namespace kurbel::test::motions_not_balances_test
