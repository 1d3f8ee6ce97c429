// translation_test.cpp — screw and nut, wedge, slide: against a textbook, free bodies solved face by face, and equations
// of motion of their own in long double.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "drivetrain/shared/inclined_plane.h"
#include "tests/published/published.h"
#include "tests/support/jacobians.h"
#include "tests/support/validation.h"

namespace kurbel::translation_test {
namespace {

using test::Against;
using test::figure;
using test::run;
using test::series;
using test::Validation;
using Real = long double;

constexpr double pi = std::numbers::pi, two_pi = 2 * pi;
constexpr double gravity = 9.80665;

// Shigley's Mechanical Engineering Design (Budynas, Nisbett, 9th ed., 2011), example 8–1: square thread, 32 mm, pitch
// 4 mm, double, f = f_c = 0.08, d_c = 40 mm, 6.4 kN: 26.18 N·m raise it, 9.77 N·m lower it, e = 0.311.
TEST(Screw, RaisesAndLowersWithTheTorquesOfTheTextbook) {
  const Validation is(Against::published,
                      "Budynas, Nisbett: Shigley's Mechanical Engineering Design, 9th ed., ex. 8–1 (power screw)");
  for (const int sense : {1, -1}) {
    const Result r = run(fmt::format(R"(
line = ["motor", "screw"]
motor = {{ kind = "prescribed speed", speed = "{} rad/s" }}
screw = {{ kind = "screw", lead = "8 mm", mean_diameter = "30 mm", thread_angle = "0 deg", friction_coefficient = 0.08, collar_diameter = "40 mm", collar_friction = 0.08, force = "6.4 kN", acts = "always" }}
run = {{ until = "1 s", samples = 3, accuracy = 1e-9 }}
)",
                                     10 * sense));
    ASSERT_TRUE(r.complete) << r.diagnosis;
    const double torque = sense * series(r, "torque.screw.in").back();
    is.near(sense > 0 ? "torque that raises" : "torque that lowers", "N·m", torque, sense > 0 ? 26.18 : 9.77, 0.005);
    if (sense > 0) {
      is.near("efficiency when raising", "", 6400 * 0.008 / (two_pi * torque), 0.311, 0.0005);
    }
    // In the units of translation.
    EXPECT_NEAR(series(r, "velocity.screw").back(), sense * 0.08 / two_pi, 1e-15);
    EXPECT_NEAR(series(r, "position.screw").back(), sense * 0.08 / two_pi, 1e-12);
    EXPECT_NEAR(series(r, "force.screw").back(), -6400, 1e-9);
  }
}

// Forces of a square thread's turn, unrolled, and of a collar: N on the flank, T its pull along the flank, resolved along
// and across the axis; no formula of efficiency.
//     up:  Q = N (cos γ − μ sin γ),  F = N (sin γ + μ cos γ) + μ_b Q
TEST(InclinedPlane, EfficienciesAreThoseOfTheFreeBodies) {
  for (const double angle : {0.02, 0.1, 0.6, 1.1})
    for (const double friction : {0.0, 0.05, 0.3})
      for (const double base : {0.0, 0.2})
        for (const double guide : {0.0, 0.15}) {
          const InclinedPlane plane{angle, std::atan(friction), base, guide};
          for (const int sense : {1, -1}) {
            // Load: Q = vertical part less the guide's friction; wedge: F = horizontal part and the base's friction.
            const double vertical = std::cos(angle) - sense * friction * std::sin(angle);
            const double across = std::sin(angle) + sense * friction * std::cos(angle);
            const double load = vertical - sense * guide * std::abs(across);
            const double push = across + sense * base * vertical;
            if (sense > 0 && load > 0) {
              EXPECT_NEAR(plane.efficiency(), load * std::tan(angle) / push, 1e-14);
            } else if (sense < 0) {
              EXPECT_NEAR(plane.efficiency_back(), push / (load * std::tan(angle)), 1e-13);
            }
          }
        }
}

// --- a spindle press in equations of its own ---

struct Press {
  Real flywheel = 15, mass = 300, lead = 0.05, diameter = 0.12, friction = 0.07, base = 0.03;  // base: μ_c d_c/d₂
  Real begin = 0.04, stiffness = 3e7L, drag = 0.2L;  // the work: from that travel on [N/m]; on the spindle [N·m·s]

  Real k() const { return lead / (2 * std::numbers::pi_v<Real>); }
  Real gamma() const { return std::atan(lead / (std::numbers::pi_v<Real> * diameter)); }
  Real rho() const { return std::atan(friction / std::cos(15 * std::numbers::pi_v<Real> / 180)); }
  // Spindle: J α = −M_d − Q r (tan(γ ± ρ′) ± μ_b), + while the nut is pushed (Q > 0) in the sense of ω > 0.
  // Nut: Q + m g − F(s) = m k α.
  Real acceleration(Real s, Real omega) const {
    const Real resisting = s > begin ? stiffness * (s - begin) : 0, weight = mass * static_cast<Real>(gravity);
    Real alpha = 0;
    for (const int pushed : {1, -1}) {
      const Real arm = diameter / 2 * (std::tan(gamma() + pushed * rho()) + pushed * base);
      // Q = m k α + F − m g
      alpha = (-drag * omega - (resisting - weight) * arm) / (flywheel + mass * k() * arm);
      if (pushed * (mass * k() * alpha + resisting - weight) >= 0) return alpha;
    }
    return alpha;
  }
  std::string scene(double omega, double until) const {
    return fmt::format(R"(
line = ["wheel", "screw"]
wheel = {{ kind = "load", damping = "{:.17g} N*m*s/rad", inertia = "{:.17g} kg*m2" }}
screw = {{ kind = "screw", lead = "{:.17g} m", mean_diameter = "{:.17g} m", friction_coefficient = {:.17g}, collar_diameter = "{:.17g} m", collar_friction = {:.17g}, mass = "{:.17g} kg", inclination = "-90 deg", table = {{ over = "travel", unit = ["m", "N"], points = [[{:.17g}, 0], [{:.17g}, {:.17g}]] }} }}
run = {{ start = {{ speed = "{} rad/s" }}, until = "{} s", accuracy = 1e-10, samples = 401 }}
)",
                       static_cast<double>(drag), static_cast<double>(flywheel), static_cast<double>(lead),
                       static_cast<double>(diameter), static_cast<double>(friction), static_cast<double>(diameter / 2),
                       static_cast<double>(base * 2), static_cast<double>(mass), static_cast<double>(begin),
                       static_cast<double>(begin + 1), static_cast<double>(stiffness), omega, until);
  }
};

// Classical Runge–Kutta in long double; the step in which the nut meets the work, and the last one, are cut by bisection.
struct Stop {
  Real time = 0, travel = 0, force = 0;
};
Stop stop_of(const Press& press, Real omega) {
  std::array<Real, 2> y{0, omega};  // s, ω
  const auto rate = [&](const std::array<Real, 2>& at) {
    return std::array<Real, 2>{press.k() * at[1], press.acceleration(at[0], at[1])};
  };
  const auto step = [&](const std::array<Real, 2>& from, Real h) {
    const auto moved = [&](const std::array<Real, 2>& by, Real part) {
      return std::array<Real, 2>{from[0] + part * by[0], from[1] + part * by[1]};
    };
    const auto a = rate(from), b = rate(moved(a, h / 2)), c = rate(moved(b, h / 2)), d = rate(moved(c, h));
    std::array<Real, 2> to{};
    for (std::size_t i = 0; i < 2; ++i) to[i] = from[i] + h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    return to;
  };
  const auto cut = [&](auto beyond, Real h) {
    Real low = 0, high = h;
    for (int i = 0; i < 80; ++i) {
      const Real middle = (low + high) / 2;
      (beyond(step(y, middle)) ? high : low) = middle;
    }
    return high;
  };
  Stop stop;
  const Real h = 2e-5L;
  bool met = false;
  while (true) {
    Real by = h;
    auto next = step(y, by);
    if (!met && next[0] > press.begin) {
      by = cut([&](const auto& at) { return at[0] > press.begin; }, h);
      next = step(y, by), met = true;
    } else if (next[1] < 0) {
      by = cut([&](const auto& at) { return at[1] < 0; }, h);
      y = step(y, by);
      stop.time += by;
      break;
    }
    y = next, stop.time += by;
  }
  stop.travel = y[0];
  stop.force = press.stiffness * (y[0] - press.begin);
  return stop;
}

TEST(Screw, PressSpendsItsEnergyAsItsOwnEquationsSay) {
  const Press press;
  const Stop truth = stop_of(press, 20);
  const Result r = run(press.scene(20, 2));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_LT(truth.time, 1.9L);
  // γ = 7.6° and ρ′ = 4.1° with the collar's 0.03: it does not lock itself, and comes back after the blow.
  const Real weight = press.mass * static_cast<Real>(gravity);  // counts among the forces
  EXPECT_NEAR(figure(r, "peak_force.screw"), static_cast<double>(weight - truth.force),
              1e-8 * static_cast<double>(truth.force));
  const auto travel = series(r, "position.screw");
  EXPECT_LT(travel.back(), static_cast<double>(truth.travel) - 0.001);
  EXPECT_LT(r.energy.relative, 1e-9);
}

// With more friction it locks itself: the blow leaves it standing where it stopped, under the full force.
TEST(Screw, SelfLockingPressStaysInTheWork) {
  Press press;
  press.friction = 0.12L;
  const Stop truth = stop_of(press, 20);
  const Result r = run(press.scene(20, 2));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_NEAR(series(r, "position.screw").back(), static_cast<double>(truth.travel), 1e-10);
  EXPECT_NEAR(series(r, "force.screw").back(),
              static_cast<double>(static_cast<Real>(gravity) * press.mass - truth.force),
              1e-8 * static_cast<double>(truth.force));
  double nearest = 1;
  for (const Event& event : r.events) nearest = std::min(nearest, std::abs(event.t - static_cast<double>(truth.time)));
  EXPECT_LT(nearest, 1e-8);
  EXPECT_EQ(figure(r, "final_speed.screw"), 0.0);
  EXPECT_NE(r.explanation.find("self-locking"), std::string::npos);
}

TEST(Screw, BranchOfTheWayBackHoldsAndLetsGo) {
  // The work resists on the way down and springs back by a branch of its own; a slide without friction between them
  // loses just the area between the branches.
  const Result r = run(R"(
line = ["wheel", "screw"]
wheel = { kind = "inertia", inertia = "10 kg*m2" }
screw = { kind = "screw", lead = "50 mm", mass = "100 kg", start_travel = "5 mm", table = { over = "travel", unit = ["mm", "kN"], points = [[0, 0], [10, 0], [60, 500]], return_points = [[0, 0], [10, 0], [60, 100]] } }
run = { start = { speed = "20 rad/s" }, until = "1.5 s", accuracy = 1e-9, samples = 3 }
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double k = 0.05 / two_pi, inertia = 10 + 100 * k * k, kinetic = 0.5 * inertia * 400;
  EXPECT_NEAR(figure(r, "final_speed.wheel"), -20 * std::sqrt(0.2), 1e-7);
  EXPECT_NEAR(figure(r, "work.useful"), -0.8 * kinetic, 1e-5);
  EXPECT_NEAR(figure(r, "peak_force.screw"), -std::sqrt(2 * kinetic * 1e7), 0.01);  // ½ c x² = ½ I ω²
}

TEST(Screw, JacobianEqualsDifferences) {
  const std::string scene = R"(
line = ["motor", "coupling", "screw"]
motor = { kind = "load", damping = "0.3 N*m*s/rad", inertia = "0.02 kg*m2" }
coupling = { kind = "coupling", stiffness = "500 N*m/rad", damping = "2 N*m*s/rad" }
screw = { kind = "screw", lead = "30 mm", mean_diameter = "40 mm", friction_coefficient = 0.1, mass = "50 kg", inclination = "30 deg", guide_friction = 0.1, damping = "40 N*s/m", quadratic = "9 N*s2/m2", inertia = "0.01 kg*m2", table = { over = "travel", unit = ["mm", "kN"], interpolation = "smooth", points = [[-40, 0], [-3, 0.5], [10, 3], [60, 5]] } }
effects = { elasticity = true }
run = { start = { speed = "SPEED rad/s" }, until = "1 s" }
)";
  for (const double speed : {30.0, -30.0})
    test::expect_exact_jacobian_near_start(test::with(scene, "SPEED", test::digits(speed)), {}, 1e-6);
}

TEST(Screw, LossesOffLeaveNoTrace) {
  const auto text = [](const std::string& friction, const std::string& more) {
    return "line = [\"wheel\", \"screw\"]\nwheel = { kind = \"inertia\", inertia = \"1 kg*m2\" }\nscrew = { kind = "
           "\"screw\", lead = \"20 mm\", mean_diameter = \"40 mm\", mass = \"50 kg\", force = \"1 kN\"" +
           friction + " }\nrun = { start = { speed = \"20 rad/s\" }, until = \"1 s\" }\n" + more;
  };
  const Scene off = test::scene_from(text(", friction_coefficient = 0.1", "effects = { gear_losses = false }\n"));
  const Scene absent = test::scene_from(text("", ""));
  test::expect_same_model(off, absent);
  EXPECT_EQ(compile(off, off.effects)->free_shafts, 1u);
}

// A wedge: the load's free body and the wedge's, solved for their accelerations with the two faces and the base.
//     N across the slope, V = N (cos γ ∓ μ sin γ), H = N (sin γ ± μ cos γ);  m s̈ tan γ = V ∓ μ_g H − m g
//     m_w s̈ = F − H ∓ μ_b V
TEST(Wedge, AcceleratesAsItsFreeBodiesDo) {
  const double gamma = 10 * pi / 180, mu = 0.08, base = 0.05, guide = 0.1, mass = 400, wedge = 30, inertia = 0.02,
               r = 0.05, torque = 70;
  const double vertical = std::cos(gamma) - mu * std::sin(gamma), across = std::sin(gamma) + mu * std::cos(gamma);
  // N = m (g + s̈ tan γ)/(vertical − μ_g across);  (m_w + J/r²) s̈ = M/r − N (across + μ_b vertical)
  const double per_load = (across + base * vertical) / (vertical - guide * across);
  const double s =
      (torque / r - mass * gravity * per_load) / (wedge + inertia / (r * r) + mass * std::tan(gamma) * per_load);
  ASSERT_GT(s, 0);
  const Result moved = run(fmt::format(R"(
line = ["push", "wedge"]
push = {{ kind = "torque source", torque = "{} N*m", inertia = "0.005 kg*m2" }}
wedge = {{ kind = "wedge", wedge_angle = "10 deg", radius = "50 mm", friction_coefficient = 0.08, base_friction = 0.05, side_friction = 0.1, inertia = "0.015 kg*m2", wedge_mass = "30 kg", mass = "400 kg", inclination = "90 deg" }}
run = {{ until = "0.5 s", accuracy = 1e-9, samples = 3 }}
)",
                                       torque));
  ASSERT_TRUE(moved.complete) << moved.diagnosis;
  EXPECT_NEAR(series(moved, "acceleration.wedge").back(), s * std::tan(gamma), 1e-12);
  EXPECT_NEAR(series(moved, "position.wedge").back(), 0.5 * s * std::tan(gamma) * 0.25, 1e-10);
}

// A car on a plane of β: runs up, stops, and stays if tan β ≤ μ; else runs back.
TEST(Slide, StopsOnTheInclinedPlaneAndStaysWithinTheFrictionAngle) {
  const double beta = 12 * pi / 180, speed = 3;
  for (const double mu : {0.1, 0.3}) {
    const Result r = run(fmt::format(R"(
line = ["wheel"]
wheel = {{ kind = "slide", radius = "200 mm", mass = "500 kg", inclination = "12 deg", guide_friction = {} }}
run = {{ start = {{ speed = "{} rad/s" }}, until = "3 s", accuracy = 1e-9, samples = 3 }}
)",
                                     mu, speed / 0.2));
    ASSERT_TRUE(r.complete) << r.diagnosis;
    const double up = gravity * (std::sin(beta) + mu * std::cos(beta)), top = speed * speed / (2 * up);
    const double down = gravity * (std::sin(beta) - mu * std::cos(beta)), left = 3 - speed / up;
    EXPECT_NEAR(series(r, "position.wheel").back(), down > 0 ? top - 0.5 * down * left * left : top, 1e-8) << mu;
    EXPECT_NEAR(figure(r, "final_speed.wheel"), down > 0 ? -down * left / 0.2 : 0, 1e-7) << mu;
  }
}

}  // namespace
}  // namespace kurbel::translation_test
