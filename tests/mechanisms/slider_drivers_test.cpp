// slider_drivers_test.cpp — machines that a slider drives: cylinder and linear motor against equations of motion of their
// own in long double; dead centres, where they move nothing.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "tests/support/jacobians.h"

namespace kurbel::slider_drivers_test {
namespace {

using test::figure;
using test::run;
using Real = long double;
using State = std::array<Real, 2>;  // φ, ω

// Slider-crank with a massless rod; the force on its slider by place, speed and sense of travel.
struct Machine {
  Real radius = 0.15L, rod = 0.6L, inertia = 9, mass = 20, drag = 1.5L;
  std::function<Real(Real x, Real v, int travel)> force;

  Real root(Real phi) const { return std::sqrt(rod * rod - radius * radius * std::sin(phi) * std::sin(phi)); }
  Real position(Real phi) const { return radius * std::cos(phi) + root(phi); }
  Real slope(Real phi) const {
    return -radius * std::sin(phi) - radius * radius * std::sin(phi) * std::cos(phi) / root(phi);
  }
  Real curvature(Real phi) const {
    const Real r2 = radius * radius, s = std::sin(phi), c = std::cos(phi), w = root(phi);
    return -radius * c - r2 * (c * c - s * s) / w - r2 * r2 * s * s * c * c / (w * w * w);
  }
  // (I + m x′²) ω̇ = −m x′ x″ ω² + F x′ − b ω
  State rate(const State& y, int travel) const {
    const Real x1 = slope(y[0]), f = force(position(y[0]), x1 * y[1], travel);
    const Real torque = -mass * x1 * curvature(y[0]) * y[1] * y[1] + f * x1 - drag * y[1];
    return {y[1], torque / (inertia + mass * x1 * x1)};
  }
  State step(const State& y, Real h, int travel) const {
    const auto moved = [&](const State& by, Real part) { return State{y[0] + part * by[0], y[1] + part * by[1]}; };
    const State a = rate(y, travel), b = rate(moved(a, h / 2), travel), c = rate(moved(b, h / 2), travel),
                d = rate(moved(c, h), travel);
    State to{};
    for (std::size_t i = 0; i < 2; ++i) to[i] = y[i] + h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    return to;
  }
  // Classical Runge–Kutta; a step over a dead centre is cut there, where the force changes its branch. ω > 0.
  State after(State y, Real time, int steps) const {
    const Real h = time / steps, pi = std::numbers::pi_v<Real>;
    for (int k = 0; k < steps; ++k) {
      const int half = static_cast<int>(std::floor(y[0] / pi));
      const int travel = half % 2 == 0 ? -1 : 1;
      const State whole = step(y, h, travel);
      const Real centre = (half + 1) * pi;
      if (whole[0] < centre) {
        y = whole;
        continue;
      }
      Real low = 0, high = h;
      for (int i = 0; i < 70; ++i) {
        const Real middle = (low + high) / 2;
        (step(y, middle, travel)[0] < centre ? low : high) = middle;
      }
      y = step(step(y, high, travel), h - high, -travel);
    }
    return y;
  }
  std::string scene(const std::string& load, double phi, double omega, double until) const {
    return fmt::format(R"(
line = ["crank", "wheel"]
crank = {{ kind = "slider-crank", radius = "{} m", rod = "{} m", slider_mass = "{} kg", crank_inertia = "1 kg*m2", load = {} }}
wheel = {{ kind = "load", inertia = "{} kg*m2", damping = "{} N*m*s/rad" }}
run = {{ start = {{ angle = "{} rad", speed = "{} rad/s" }}, until = "{} s", accuracy = 1e-10, samples = 11 }}
)",
                       static_cast<double>(radius), static_cast<double>(rod), static_cast<double>(mass), load,
                       static_cast<double>(inertia) - 1, static_cast<double>(drag), phi, omega, until);
  }
};

void expect_agreement(const Machine& machine, const std::string& load, double phi, double omega) {
  const State truth = machine.after({phi, omega}, 4, 40000);
  ASSERT_GT(truth[0], 8);  // it rotated, through dead centres
  const Result r = run(machine.scene(load, phi, omega, 4));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_NEAR(figure(r, "final_angle.wheel"), static_cast<double>(truth[0]), 1e-8 * static_cast<double>(truth[0]));
  EXPECT_NEAR(figure(r, "final_speed.wheel"), static_cast<double>(truth[1]), 1e-8 * static_cast<double>(truth[1]));
  EXPECT_LT(r.energy.relative, 1e-9);
  EXPECT_GT(figure(r, "work.driving"), 0.0);
}

// Both chambers, the pressures straight over the distance d from the outer dead centre:
//     F = −(p₁ − p_out) A + (p₂ − p_out) (A − A_rod)
TEST(SliderDriver, CylinderDrivesTheCrankAsItsOwnEquationsSay) {
  Machine machine;
  const Real pi = std::numbers::pi_v<Real>, area = pi / 4 * 0.2L * 0.2L, behind = area - pi / 4 * 0.05L * 0.05L;
  const Real outer = machine.radius + machine.rod, stroke = 2 * machine.radius, bar = 1e5L;
  machine.force = [=](Real x, Real, int travel) {
    const Real part = (outer - x) / stroke;
    const bool away = travel < 0;  // from the outer dead centre
    const Real p1 = away ? 5 - 3 * part : 1.5L - 0.3L * part, p2 = away ? 1.1L + 0.2L * part : 2 + 2.5L * part;
    return -(p1 - 1) * bar * area + (p2 - 1) * bar * behind;
  };
  expect_agreement(
      machine,
      R"({ kind = "cylinder", bore = "200 mm", rod_diameter = "50 mm", outside_pressure = "1 bar", pressure = { over = "travel", unit = ["mm", "bar"], points = [[0, 1.5], [300, 1.2]], return_points = [[0, 5], [300, 2]] }, pressure_behind = { over = "travel", unit = ["mm", "bar"], points = [[0, 2], [300, 4.5]], return_points = [[0, 1.1], [300, 1.3]] } })",
      0.6, 4);
}

// Single-acting, by a formula of the angle: it pushes on the half turn away from the outer dead centre alone.
TEST(SliderDriver, CylinderOverTheAngleLeavesTheOtherFaceToTheAir) {
  Machine machine;
  const Real area = std::numbers::pi_v<Real> / 4 * 0.16L * 0.16L;
  machine.force = [=](Real, Real, int travel) { return -(travel < 0 ? 4e5L : 1.2e5L) * area + 1e5L * area; };
  expect_agreement(
      machine,
      R"({ kind = "cylinder", bore = "160 mm", outside_pressure = "1 bar", pressure = { over = "angle", unit = ["deg", "bar"], points = [[0, 4], [180, 4], [180, 1.2], [360, 1.2], [360, 4]] } })",
      0.6, 4);
}

// F = F₀ (sgn v − v/v₀)
TEST(SliderDriver, LinearMotorFollowsTheMotion) {
  Machine machine;
  machine.force = [](Real, Real v, int travel) { return 900 * (travel - v / 2.5L); };
  expect_agreement(machine, R"({ kind = "linear motor", stall_force = "900 N", no_load_velocity = "2.5 m/s" })", 0.6,
                   4);
}

// At rest in a dead centre no force on the slider moves the crank, in either; beside it every force does.
TEST(SliderDriver, MovesNothingFromRestInADeadCentre) {
  Machine machine;
  const std::string push =
      R"({ kind = "linear motor", stall_force = "900 N", no_load_velocity = "2.5 m/s", pushes = "folded" })";
  const Result still = run(machine.scene(push, 0, 0, 2));
  ASSERT_TRUE(still.complete) << still.diagnosis;
  EXPECT_EQ(figure(still, "final_angle.wheel"), 0.0);
  EXPECT_EQ(figure(still, "work.driving"), 0.0);
  const Result goes = run(machine.scene(push, 1e-3, 0, 2));
  EXPECT_GT(figure(goes, "final_angle.wheel"), 0.5);
  // With the motion it gives nothing where there is none.
  const Result waits =
      run(machine.scene(R"({ kind = "linear motor", stall_force = "900 N", no_load_velocity = "2.5 m/s" })", 1, 0, 2));
  EXPECT_EQ(figure(waits, "final_speed.wheel"), 0.0);
}

// Nothing moves behind an elastic coupling, and no work is done: what rounding leaves of works is no error.
TEST(SliderDriver, MovesNothingThroughACouplingEither) {
  const Result still = run(R"(
line = ["wheel", "coupling", "crank"]
wheel = { kind = "load", inertia = "0.3 kg*m2", torque = "0.5 N*m", damping = "2 N*m*s/rad" }
coupling = { kind = "coupling", stiffness = "500 N*m/rad", damping = "0.5 N*m*s/rad" }
effects = { elasticity = true }
run = { start = { angle = "0 deg" }, until = "8 s" }
[crank]
kind = "slider-crank"
radius = "50 mm"
rod = "200 mm"
slider_mass = "3 kg"
rod_mass = "1 kg"
crank_inertia = "0.05 kg*m2"
load = { kind = "table", working_end = "folded", force = { over = "angle", unit = ["deg", "N"], points = [[0, 50], [180, 900], [180, -400], [360, -400], [360, 50]] } }
)");
  ASSERT_TRUE(still.complete) << still.diagnosis;
  EXPECT_FALSE(still.unconfirmed()) << still.accuracy_in_words();
  // x′ of the dead centre is rounding: the angle stays a millionth of the accuracy.
  EXPECT_NEAR(figure(still, "final_angle.crank"), 0, 1e-12);
  EXPECT_TRUE(std::any_of(still.claims.begin(), still.claims.end(),
                          [](const Claim& c) { return c.predicate == Predicate::does_not_move; }));
}

TEST(SliderDriver, JacobianEqualsDifferences) {
  for (
      const std::string load :
      {R"({ kind = "cylinder", bore = "200 mm", rod_diameter = "50 mm", pressure = { over = "travel", unit = ["mm", "bar"], points = [[0, 1.5], [300, 1.2]], return_points = [[0, 5], [300, 2]] }, pressure_behind = { over = "angle", unit = ["deg", "bar"], interpolation = "smooth", points = [[0, 2], [100, 3], [220, 1], [360, 2]] } })",
       R"({ kind = "linear motor", stall_force = "900 N", no_load_velocity = "2.5 m/s" })"})
    for (const double speed : {6.0, -6.0})
      test::expect_exact_jacobian_near_start(Machine().scene(load, 1, speed, 1), {}, 1e-6);
}

}  // namespace
}  // namespace kurbel::slider_drivers_test
