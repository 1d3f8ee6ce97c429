// slider_crank_motion_test.cpp — published motions of slider-cranks: a run-up from rest, a free one under its weight,
// and one at a prescribed speed.
#include <fmt/format.h>

#include "tests/published/published.h"
#include "tests/support/validation.h"

namespace kurbel::slider_crank_motion_test {
namespace {

using test::Against;
using test::figure;
using test::run;
using test::Validation;

// --- SC03 (tests/cases/sc03_exudyn_slidercrank.toml): from rest by 0.1 N·m; uniform rods, no weight ---

const char* const run_up = R"(
line = ["drive", "crank"]
[drive]
kind = "torque source"
torque = "0.1 N*m"
[crank]
kind = "slider-crank"
radius = "0.1 m"
rod = "0.3 m"
crank_mass = "0.2 kg"
crank_com = "0.05 m"
crank_inertia = "6.6666666666666667e-4 kg*m2"   # m L²/3
rod_mass = "0.2 kg"
rod_inertia = "1.5e-3 kg*m2"                    # m L²/12
slider_mass = "0.4 kg"
[run]
until = "3 s"
samples = 61
accuracy = 1e-10
)";
const test::InlineSliderCrank run_up_mechanism{.r = 0.1,
                                               .l = 0.3,
                                               .crank_inertia = 0.2 * 0.01 / 3,
                                               .rod_mass = 0.2,
                                               .rod_com = 0.15,
                                               .rod_inertia = 0.2 * 0.09 / 12,
                                               .slider_mass = 0.4};

TEST(SliderCrankRunUp, MotionMatchesTheReferenceOfExudynsCase) {
  const Validation is(Against::published, "EXUDYN, slider-crank run up from rest (case sc03)");
  const Result r = run(run_up);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto phi = test::series(r, "angle.crank"), omega = test::series(r, "speed.crank");
  const struct {
    std::size_t row;
    double phi, omega;
  } expected[] = {{20, 14.12789222, 20.53748285}, {40, 55.0724438, 39.79557704}, {60, 121.88627751, 101.36564506}};
  for (const auto& e : expected) {
    is.close(fmt::format("angle at {} s", 0.05 * static_cast<double>(e.row)), "rad", phi[e.row], e.phi, 1e-7);
    is.close(fmt::format("speed at {} s", 0.05 * static_cast<double>(e.row)), "rad/s", omega[e.row], e.omega, 1e-7);
  }
  is.near("largest difference to the converged series, angle", "rad",
          test::largest_difference(r, "angle.crank", test::published_series("sc03_exudyn.csv", 1, 4)), 0,
          2e-8);  // ten digits
  is.near("largest difference to the converged series, speed", "rad/s",
          test::largest_difference(r, "speed.crank", test::published_series("sc03_exudyn.csv", 1, 5)), 0, 6e-8);
  // MATLAB's series with RelTol 1e-6 drifts by 5.7e-3 rad.
  is.near("largest difference to MATLAB's series at RelTol 1e-6, angle", "rad",
          test::largest_difference(r, "angle.crank", test::published_series("sc03_exudyn.csv", 1, 2)), 0, 6e-3);
}

// Equation of work (theory 2.3) with a constant torque: M φ = ½ I_r(φ) ω² at every moment.
TEST(SliderCrankRunUp, WorkOfTheTorqueIsTheKineticEnergy) {
  const Validation is(Against::closed_form, "Slider-crank run up by a constant torque: M φ = ½ I_r(φ) ω²");
  const Result r = run(run_up);
  const auto phi = test::series(r, "angle.crank"), omega = test::series(r, "speed.crank");
  for (std::size_t row = 1; row < phi.size(); ++row) {
    const double work = 0.1 * phi[row];
    EXPECT_NEAR(0.5 * run_up_mechanism.inertia(phi[row]) * omega[row] * omega[row], work, 1e-9 * work) << row;
  }
  is.near("work of the torque over 3 s", "J", 1, r.find("work.driving"), 0.1 * phi.back(), 1e-10 * phi.back());
}

TEST(SliderCrankRunUp, FirstAccelerationIsTorqueOverReducedInertia) {
  const Validation is(Against::closed_form, "Slider-crank at its dead centre: ε = M/I_r, I_r = (m₁ + m₂) r²/3");
  // At the dead centre only crank and rod turn: I_r = (m₁ + m₂) L₁²/3, ε = 75 rad/s².
  const Scene scene = test::scene_from(run_up);
  Equations equations(compile(scene, {}), false);
  const std::vector<double> y = equations.start(0);
  is.near("first acceleration", "rad/s²", equations.snapshot(0, y).alpha[0], 75, 75e-12);
}

// --- SC02 (tests/cases/sc02_engine1a.toml): Modelica's Engine1a, the slider on top, weight along the stroke ---

TEST(FreeEngineUnderItsWeight, MotionMatchesTheReference) {
  const Validation is(Against::published, "Modelica.Mechanics.MultiBody Engine1a, free under its weight (case sc02)");
  const Result r = run(R"(
line = ["crank"]
[crank]
kind = "slider-crank"
radius = "0.1 m"
rod = "0.2 m"
crank_mass = "10 kg"
crank_com = "0.01314280927234432 m"             # static moment of 0.1314280927 kg·m
crank_inertia = "1.0114306736259937 kg*m2"
rod_mass = "1.848 kg"
rod_inertia = "0.0067144 kg*m2"
slider_mass = "6.047565858160353 kg"
gravity = "9.80665 m/s2"
stroke_angle = "90 deg"
[run]
start = { speed = "10 rad/s" }
until = "5 s"
samples = 101
accuracy = 1e-10
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  is.near("angle after 5 s", "rad", 1, r.find("final_angle.crank"), 53.4150446, 1e-7);
  is.near("speed after 5 s", "rad/s", 1, r.find("final_speed.crank"), 11.64032783, 1e-7);
  // The case's own series has ten digits; Modelica's holds to its own tolerance, 1.5e-4 rad.
  is.near("largest difference to the converged series, angle", "rad",
          test::largest_difference(r, "angle.crank", test::published_series("sc02_Engine1a.csv", 1, 4)), 0, 1e-8);
  is.near("largest difference to the converged series, speed", "rad/s",
          test::largest_difference(r, "speed.crank", test::published_series("sc02_Engine1a.csv", 1, 5)), 0, 1e-8);
  is.near("largest difference to Modelica's series, angle", "rad",
          test::largest_difference(r, "angle.crank", test::published_series("sc02_Engine1a.csv", 1, 2)), 0, 1.6e-4);
}

// --- MB04 (tests/cases/mb04_ivp_slidercrank.toml): the crank turns at 150 rad/s; here with a rigid rod ---

const char* const prescribed = R"(
line = ["drive", "crank"]
[drive]
kind = "prescribed speed"
speed = "150 rad/s"
[crank]
kind = "slider-crank"
radius = "0.15 m"
rod = "0.30 m"
crank_mass = "0.36 kg"
crank_com = "0.075 m"
crank_inertia = "0.002727 kg*m2"
rod_mass = "0.151104 kg"
rod_inertia = "0.0011340859 kg*m2"              # 0.0045339259 about the pin, less m (l/2)²
slider_mass = "0.075552 kg"
[run]
until = "0.1 s"
samples = 201
accuracy = 1e-10
)";

TEST(SliderCrankAtPrescribedSpeed, SliderMovesAsTheClosedFormSays) {
  const Validation is(
      Against::closed_form,
      "Slider-crank at a prescribed speed: position, velocity, acceleration (Simeon's data, rigid rod)");
  const Result r = run(prescribed);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double w = 150, l1 = 0.15, l2 = 0.3;
  const auto x = test::series(r, "position.crank"), v = test::series(r, "velocity.crank"),
             a = test::series(r, "acceleration.crank");
  is.near("acceleration at the dead centre", "m/s²", a.front(), -5062.5, 5062.5e-11);  // −(l₁ Ω² + l₂ (Ω/2)²)
  for (std::size_t row = 0; row < x.size(); ++row) {
    const double phi = w * r.trajectory->time()[row], s = std::sin(phi), c = std::cos(phi);
    const double root = std::sqrt(l2 * l2 - l1 * l1 * s * s);
    const double slope = -l1 * s - l1 * l1 * s * c / root;
    const double bend = -l1 * c - l1 * l1 * (c * c - s * s) / root - std::pow(l1 * l1 * s * c, 2) / std::pow(root, 3);
    EXPECT_NEAR(x[row], l1 * c + root, 1e-12);
    EXPECT_NEAR(v[row], slope * w, 1e-10);
    EXPECT_NEAR(a[row], bend * w * w, 1e-7);
  }
  is.near("greatest acceleration", "m/s²", 1, r.find("peak_acceleration.crank"), -5062.5, 1e-7);
}

// The drive's work is the change of the kinetic energy, ½ Ω² (I_r(Ω t) − I_r(0)).
TEST(SliderCrankAtPrescribedSpeed, DriveDoesTheWorkThatTheReducedInertiaNeeds) {
  const Validation is(Against::closed_form,
                      "Slider-crank at a prescribed speed: work of the drive = ½ Ω² (I_r(φ) − I_r(0))");
  const test::InlineSliderCrank m{.r = 0.15,
                                  .l = 0.3,
                                  .crank_inertia = 0.002727,
                                  .rod_mass = 0.151104,
                                  .rod_com = 0.15,
                                  .rod_inertia = 0.0011340859,
                                  .slider_mass = 0.075552};
  const Result r = run(prescribed);
  const double work = 0.5 * 150 * 150 * (m.inertia(15) - m.inertia(0));
  EXPECT_GT(std::abs(work), 1);
  is.near("work of the drive over 0.1 s", "J", 1, r.find("work.driving"), work, 1e-9 * std::abs(work));
}

}  // namespace
}  // namespace kurbel::slider_crank_motion_test
