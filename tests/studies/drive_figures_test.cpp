// drive_figures_test.cpp — what a run reports of motors' currents and starts, of flywheels, clutches and compressors:
// closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <set>
#include <string>

#include "drivetrain/induction/induction_circuit.h"
#include "tests/support/scenes.h"
#include "tests/support/validation.h"

namespace kurbel::drive_figures_test {
namespace {

using test::figure;
constexpr double pi = std::numbers::pi;

// Started without load a rotor's winding takes as much heat as the masses take kinetic energy: ½ J ω_s², whatever the
// curve.
TEST(MotorFigures, HeatOfAnUnloadedStartIsTheKineticEnergy) {
  const Result r = test::run(R"(
    line = ["motor", "wheel"]
    motor = { kind = "induction motor", rated_power = "15 kW", rated_speed = "1455 rpm", synchronous_speed = "1500 rpm", breakdown_ratio = 2.8, inertia = "0.1 kg*m2" }
    wheel = { kind = "flywheel", inertia = "1.9 kg*m2" }
    run = { start = "rest", until = "12 s", accuracy = 1e-9 }
  )");
  const test::Validation is(test::Against::closed_form, "Start of an induction motor without load: heat ½ J ω_s²");
  ASSERT_NE(r.find("start_heat.motor"), nullptr);
  is.near("heat of the start", "J", 1, r.find("start_heat.motor"), 0.5 * 2.0 * std::pow(50 * pi, 2), 1e-3);
}

// At rest against its currents: a circuit at steady slip has its phasors' currents, and the rotor's heat is s M ω_s t.
TEST(MotorFigures, CurrentsOfTheTwoAxisModelAtSteadySlipAreThoseOfItsPhasors) {
  const EquivalentCircuit circuit{.voltage = 400,
                                  .frequency = 50,
                                  .pole_pairs = 2,
                                  .stator_resistance = 0.5,
                                  .rotor_resistance = 0.4,
                                  .stator_leakage = 1.1,
                                  .rotor_leakage = 1.2,
                                  .magnetising = 35};
  const double slip = 0.03, omega = 50 * pi * (1 - slip);
  using Complex = std::complex<double>;
  const Complex rotor(0.4 / slip, 1.2), magnetising(0, 35),
      whole = Complex(0.5, 1.1) + rotor * magnetising / (rotor + magnetising);
  const double load =
      3 * std::norm(400 / std::sqrt(3.0) / whole * magnetising / (rotor + magnetising)) * 0.4 / (slip * 50 * pi);
  const Result r = test::run(R"(
    line = ["motor", "fan"]
    motor = { kind = "induction motor", voltage = "400 V", frequency = "50 Hz", pole_pairs = 2, stator_resistance = "0.5 Ohm", rotor_resistance = "0.4 Ohm", stator_reactance = "1.1 Ohm", rotor_reactance = "1.2 Ohm", magnetising_reactance = "35 Ohm", inertia = "0.1 kg*m2" }
    fan = { kind = "load", inertia = "1 kg*m2", quadratic = ")" +
                             fmt::format("{:.17g}", load / (omega * omega)) + R"( N*m*s2/rad2" }
    effects = { transients = true }
    run = { start = { speed = ")" +
                             fmt::format("{:.17g}", omega) + R"( rad/s" }, until = "2 s", accuracy = 1e-7 }
  )");
  EXPECT_NEAR(figure(r, "motor_rms_current.motor"), line_current(circuit, slip).current, 1e-3);
  EXPECT_NEAR(figure(r, "motor_slip_heat.motor"), slip * load * 50 * pi * 2, 1e-4 * slip * load * 50 * pi * 2);
  const double stator = 3 * 0.5 * std::pow(line_current(circuit, slip).current, 2) * 2;
  EXPECT_NEAR(figure(r, "motor_stator_heat.motor"), stator, 1e-4 * stator);
}

// What the mains give is what the shaft, both windings and the fields take.
TEST(MotorFigures, HeatOfATwoAxisStartIsTheKineticEnergyButForItsFields) {
  const Result r = test::run(R"(
    line = ["motor", "wheel"]
    motor = { kind = "induction motor", rated_power = "15 kW", rated_speed = "1455 rpm", synchronous_speed = "1500 rpm", breakdown_ratio = 2.8, resistance_ratio = 1, frequency = "50 Hz", inertia = "0.1 kg*m2" }
    wheel = { kind = "flywheel", inertia = "9.9 kg*m2" }
    effects = { transients = true }
    run = { start = "rest", until = "12 s" }
  )");
  const double kinetic = 0.5 * 10 * std::pow(50 * pi, 2);
  EXPECT_NEAR(figure(r, "motor_slip_heat.motor"), kinetic, 0.02 * kinetic);
}

// ω falls by (500 − 100) N·m · 0.1 s/4 kg·m² = 10 rad/s from 100 rad/s, and gives ½ · 4 · (100² − 90²) J.
TEST(Flywheel, FallsAndGivesWhatTheStrokeTakesBeyondTheDrive) {
  const Result r = test::run(R"(
    line = ["motor", "wheel"]
    motor = { kind = "torque source", torque = "100 N*m" }
    wheel = { kind = "flywheel", inertia = "4 kg*m2" }
    blow = { kind = "load", on = "wheel", torque = "500 N*m", acts = "against motion", start = "1 s", stop = "1.1 s" }
    run = { start = { speed = "75 rad/s" }, until = "2 s", accuracy = 1e-9 }
  )");
  EXPECT_NEAR(figure(r, "speed_drop.wheel"), 0.1, 1e-9);
  EXPECT_NEAR(figure(r, "energy_given.wheel"), 0.5 * 4 * (100 * 100 - 90 * 90), 1e-5);
  EXPECT_NEAR(*r.find("speed_drop.wheel")->at, 1.1, 1e-9);
}

// A prescribed shaft drives, too: a step of 500 N·m against 4 kg·m² on 400 N·m/rad vibrates about ω₀ = 100 rad/s by
// M/(J p) = 12.5 rad/s, p = √(k/J) = 10 rad/s: from 112.5 rad/s down to 87.5 rad/s.
TEST(Flywheel, FallsBehindAPrescribedShaft) {
  const Result r = test::run(R"(
    line = ["grid", "spring", "wheel"]
    grid = { kind = "prescribed speed", speed = "100 rad/s" }
    spring = { kind = "coupling", stiffness = "400 N*m/rad" }
    wheel = { kind = "flywheel", inertia = "4 kg*m2" }
    blow = { kind = "load", on = "wheel", torque = "500 N*m", acts = "against motion", start = "1 s" }
    effects = { elasticity = true }
    run = { start = { speed = "100 rad/s" }, until = "3 s", accuracy = 1e-9 }
  )");
  EXPECT_NEAR(figure(r, "speed_drop.wheel"), 25 / 112.5, 1e-7);
}

// Behind a clutch that is open at times it falls, too; what nothing drives runs down, and does not count.
TEST(Flywheel, RunDownIsNoFall) {
  const Result r = test::run(R"(
    line = ["motor", "wheel"]
    motor = { kind = "torque source", torque = "10 N*m", stop = "1 s" }
    wheel = { kind = "flywheel", inertia = "1 kg*m2" }
    drag = { kind = "load", on = "wheel", damping = "0.1 N*m*s/rad" }
    run = { start = { speed = "100 rad/s" }, until = "30 s" }
  )",
                             false);
  const Figure* drop = r.find("speed_drop.wheel");
  EXPECT_TRUE(!drop || drop->value < 1e-6);
}

// A run-up from rest behind soft and stiff couplings: what the wheel turns back by rounding in the first steps, all of the
// speed that it then has, is no fall.
TEST(Flywheel, RoundingAtTheStartIsNoFall) {
  const Result r = test::run(R"(
    line = ["motor", "c1", "j2", "c2", "j3", "c3", "j4", "c4", "wheel", "c5", "fan"]
    motor = { kind = "dc shunt motor", stall_torque = "255.745 N*m", no_load_speed = "110.36 rad/s", inertia = "0.0741 kg*m2" }
    c1 = { kind = "coupling", stiffness = "3.1297 kN*m/rad", damping = "2.374 N*m*s/rad" }
    j2 = { kind = "inertia", inertia = "0.023 kg*m2" }
    c2 = { kind = "coupling", stiffness = "165.7 kN*m/rad", damping = "6.919 N*m*s/rad" }
    j3 = { kind = "inertia", inertia = "0.0437 kg*m2" }
    c3 = { kind = "coupling", stiffness = "150 kN*m/rad", damping = "6.404 N*m*s/rad" }
    j4 = { kind = "inertia", inertia = "0.3328 kg*m2" }
    c4 = { kind = "coupling", stiffness = "8.853 kN*m/rad", damping = "5.034 N*m*s/rad" }
    wheel = { kind = "flywheel", inertia = "1.6736 kg*m2" }
    c5 = { kind = "coupling", stiffness = "37.7 kN*m/rad", damping = "11.61 N*m*s/rad" }
    fan = { kind = "load", quadratic = "0.01833 N*m*s2/rad2", inertia = "0.5595 kg*m2" }
    effects = { elasticity = true }
    run = { start = "rest", until = "1 s", accuracy = 1e-2, method = "verner6" }
  )",
                             false);
  EXPECT_FALSE(r.find("speed_drop.wheel"));
  EXPECT_FALSE(r.find("energy_given.wheel"));
}

// It must pass 60 N·m · 3/(1 + 3) = 45 N·m on: holding 90 N·m it has twice that.
TEST(Clutch, TorqueReserveIsWhatItHoldsOverWhatItPassesOn) {
  const Result r = test::run(R"(
    line = ["motor", "clutch", "wheel"]
    motor = { kind = "torque source", torque = "60 N*m", inertia = "1 kg*m2" }
    clutch = { kind = "clutch", torque = "80 N*m", static_torque = "90 N*m" }
    wheel = { kind = "flywheel", inertia = "3 kg*m2" }
    run = { start = "rest", until = "2 s" }
  )");
  EXPECT_NEAR(figure(r, "held_torque.clutch"), 45, 1e-6);
  EXPECT_NEAR(figure(r, "torque_reserve.clutch"), 2, 1e-7);
}

// Engaged between 40 rad/s and rest it slips under 80 N·m; held afterwards is what drives the wheel alone.
TEST(Clutch, TorqueReserveLeavesSlippingOut) {
  const Result r = test::run(R"(
    line = ["motor", "clutch", "wheel"]
    motor = { kind = "torque source", torque = "60 N*m", inertia = "1 kg*m2" }
    clutch = { kind = "clutch", torque = "80 N*m", static_torque = "90 N*m" }
    wheel = { kind = "flywheel", inertia = "3 kg*m2" }
    sequence = { steps = [{ after = "0 s", set = "clutch", to = 0 }, { after = "0.5 s", set = "clutch", to = 1, over = "0.2 s" }] }
    run = { start = { motor = { speed = "40 rad/s" }, wheel = { speed = "0 rad/s" } }, until = "6 s" }
  )");
  EXPECT_NEAR(std::abs(figure(r, "peak_torque.clutch")), 80, 1e-6);
  EXPECT_NEAR(figure(r, "torque_reserve.clutch"), 2, 1e-6);
}

// Gone on from a state that was kept, the RMS torque is that of what follows: of a constant load, the load.
TEST(Coupling, RmsTorqueOfARunThatGoesOnIsOfWhatFollows) {
  const Scene scene = test::scene_from(R"(
    line = ["motor", "coupling", "fan"]
    motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", inertia = "0.5 kg*m2" }
    coupling = { kind = "coupling", stiffness = "6 kN*m/rad", damping_ratio = 0.1 }
    fan = { kind = "load", torque = "10 N*m", inertia = "0.5 kg*m2" }
    run = { start = "rest", until = "30 s", accuracy = 1e-9 }
  )");
  SimulateOptions options;
  options.measure_error = false, options.keep_state = true;
  options.go_on_from = simulate(scene, Effects{.all_elastic = true}, "warm", options).checkpoint;
  options.until = 31;
  const Result later = simulate(scene, Effects{.all_elastic = true}, "on", options);
  for (const char* name : {"rms_torque.coupling", "rms_spring_torque.coupling"})
    EXPECT_NEAR(figure(later, name), 10, 1e-6) << name;
}

// Under its rated torque a motor draws its rated current; the crank weighs next to nothing and only gives the cycle.
TEST(MotorFigures, UnderTheRatedTorqueACycleDrawsTheRatedCurrent) {
  const Result r = test::run(R"(
    line = ["motor", "wheel", "press"]
    motor = { kind = "induction motor", rated_power = "15 kW", rated_speed = "1455 rpm", synchronous_speed = "1500 rpm", breakdown_ratio = 2.8, resistance_ratio = 1, frequency = "50 Hz", inertia = "0.1 kg*m2" }
    wheel = { kind = "flywheel", inertia = "20 kg*m2" }
    drag = { kind = "load", on = "wheel", torque = ")" +
                             fmt::format("{:.17g}", 15e3 / (1455 * pi / 30)) + R"( N*m", acts = "against motion" }
    press = { kind = "slider-crank", radius = "10 mm", rod = "100 mm", slider_mass = "1 g" }
    effects = { transients = true }
    run = { start = { speed = "1455 rpm" }, until = "10 s" }
  )");
  EXPECT_NEAR(figure(r, "current_use.motor"), 1, 1e-4);
  EXPECT_NEAR(figure(r, "thermal_use.motor"), 1, 1e-4);
}

// λ = 1 − 0.06 (6^(1/1.3) − 1), and the loop's power is its work over the cycle.
TEST(Compressor, VolumetricEfficiencyIsThatOfItsClearance) {
  const Result r = test::run(test::scene_file("docs/tasks/flywheel_sheet.toml"), false);
  EXPECT_NEAR(figure(r, "volumetric_efficiency.compressor"), 1 - 0.06 * (std::pow(6, 1 / 1.3) - 1), 1e-12);
  EXPECT_NEAR(figure(r, "loop_power.compressor") * figure(r, "cycle_time.compressor"),
              figure(r, "loop_work.compressor"), 1e-9);
}

// A reserve over a torque that is rounding would be a figure without a meaning.
TEST(Clutch, WhatHoldsNothingHasNoReserve) {
  const Result r = test::run(R"(
    line = ["motor", "guard", "wheel"]
    motor = { kind = "torque source", torque = "60 N*m", inertia = "1 kg*m2" }
    guard = { kind = "torque limiter", torque = "80 N*m" }
    wheel = { kind = "flywheel", inertia = "1e-14 kg*m2" }
    run = { start = "rest", until = "2 s" }
  )");
  EXPECT_EQ(r.find("torque_reserve.guard"), nullptr);
}

// Two compressors on one piston are distinguished by the names of their loads.
TEST(Compressor, EachOfTwoOnAPistonHasItsVolumetricEfficiency) {
  const Result r = test::run(test::scene_file("scenes/unloaded_compressor.toml"), false);
  std::set<std::string> names;
  for (const Figure& f : r.figures) EXPECT_TRUE(names.insert(f.name).second) << f.name << " is told twice";
  EXPECT_TRUE(names.contains("volumetric_efficiency.compressor.load1"));
}

}  // namespace
}  // namespace kurbel::drive_figures_test
