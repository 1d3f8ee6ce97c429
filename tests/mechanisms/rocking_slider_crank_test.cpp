// rocking_slider_crank_test.cpp — slider-cranks whose rod is too short for a turn, against equations of motion of their
// own: two angles and one closure with its multiplier, in long double, which pass the ends of the arc like any place.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

#include "mechanisms/reduced/mechanism.h"
#include "tests/support/jacobians.h"

namespace kurbel::rocking_slider_crank_test {
namespace {

using test::figure;
using test::run;
using Real = long double;
using State = std::array<Real, 4>;  // φ, β of the rod; their rates
using std::numbers::pi;

struct Swing {
  Real radius = 0.2L, rod = 0.12L, offset = 0.03L;
  bool folds = false;
  Real elevation = -1.5L;  // of +x: the crank hangs near the middle of its arc
  Real crank_mass = 5, crank_com = 0.08L, crank_inertia = 0.06L;
  Real rod_mass = 1, rod_com = 0.05L, rod_inertia = 0.002L;
  Real slider_mass = 0.3L, gravity = 9.81L, drag = 0.8L;  // of the slider [N·s/m]

  SliderCrankData data() const {
    const auto n = [](Real v) { return static_cast<double>(v); };
    return {n(radius),        n(rod),       n(offset),  n(crank_mass),  n(crank_com),
            n(crank_inertia), n(rod_mass),  n(rod_com), n(rod_inertia), n(slider_mass),
            n(gravity),       n(elevation), folds};
  }
  CrankArc arc() const { return *data().loop().arc(); }
  State at(Real phi, Real omega) const {
    const Real sine = (offset - radius * std::sin(phi)) / rod, beta = std::asin(sine);
    const Real there = folds ? std::numbers::pi_v<Real> - beta : beta;
    return {phi, there, omega, -omega * radius * std::cos(phi) / (rod * std::cos(there))};
  }
  // M q̈ + Gᵀ λ = Q, G q̈ = −Ġ q̇ of r sin φ + l sin β = e; the slider is at x = r cos φ + l cos β.
  State rate(const State& y) const {
    const auto& [phi, beta, w, u] = y;
    const Real x1 = -radius * std::sin(phi), x2 = -rod * std::sin(beta);  // of x by φ, β
    const Real g1 = radius * std::cos(phi), g2 = rod * std::cos(beta);
    const Real k = rod_mass * radius * rod_com, turn = beta - phi;
    const Real m11 = crank_inertia + rod_mass * radius * radius + slider_mass * x1 * x1;
    const Real m12 = k * std::cos(turn) + slider_mass * x1 * x2;
    const Real m22 = rod_inertia + rod_mass * rod_com * rod_com + slider_mass * x2 * x2;
    const auto rise = [&](Real angle) {  // of a point on a link, by its angle
      return -std::sin(angle) * std::sin(elevation) + std::cos(angle) * std::cos(elevation);
    };
    // On the slider: weight, drag, and minus its mass times the acceleration that the rates alone make.
    const Real force = -gravity * slider_mass * std::sin(elevation) - drag * (x1 * w + x2 * u) +
                       slider_mass * (g1 * w * w + g2 * u * u);
    const Real q1 =
        k * std::sin(turn) * u * u - gravity * (crank_mass * crank_com + rod_mass * radius) * rise(phi) + force * x1;
    const Real q2 = -k * std::sin(turn) * w * w - gravity * rod_mass * rod_com * rise(beta) + force * x2;
    const Real closing = radius * std::sin(phi) * w * w + rod * std::sin(beta) * u * u;
    // Across the closure, q̈ = t s + n c: t = (g₂, −g₁) keeps it, n = (g₁, g₂) closes it.
    const Real square = g1 * g1 + g2 * g2, c = closing / square;
    const Real across = q1 * g2 - q2 * g1 - c * (g2 * (m11 * g1 + m12 * g2) - g1 * (m12 * g1 + m22 * g2));
    const Real s = across / (m11 * g2 * g2 - 2 * m12 * g1 * g2 + m22 * g1 * g1);
    return {w, u, g2 * s + g1 * c, -g1 * s + g2 * c};
  }
  State step(const State& y, Real h) const {
    const auto moved = [&](const State& by, Real part) {
      State to{};
      for (std::size_t i = 0; i < 4; ++i) to[i] = y[i] + part * by[i];
      return to;
    };
    const State a = rate(y), b = rate(moved(a, h / 2)), c = rate(moved(b, h / 2)), d = rate(moved(c, h));
    State to{};
    for (std::size_t i = 0; i < 4; ++i) to[i] = y[i] + h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    return to;
  }
  std::string scene(double phi, double omega, double until, const std::string& more = "") const {
    const auto n = [](Real v) { return static_cast<double>(v); };
    return fmt::format(R"(
line = ["swing"]
[swing]
kind = "slider-crank"
radius = "{} m"
rod = "{} m"
offset = "{} m"
branch = "{}"
crank_mass = "{} kg"
crank_com = "{} m"
crank_inertia = "{} kg*m2"
rod_mass = "{} kg"
rod_com = "{} m"
rod_inertia = "{} kg*m2"
slider_mass = "{} kg"
gravity = "{} m/s2"
stroke_angle = "{} rad"
load = {{ kind = "medium", viscous = "{} N*s/m" }}
{}
[run]
start = {{ angle = "{} rad", speed = "{} rad/s" }}
until = "{} s"
accuracy = 1e-10
)",
                       n(radius), n(rod), n(offset), folds ? "folds" : "follows", n(crank_mass), n(crank_com),
                       n(crank_inertia), n(rod_mass), n(rod_com), n(rod_inertia), n(slider_mass), n(gravity),
                       n(elevation), n(drag), more, phi, omega, until);
  }
};

// Stops on both sides of the line, with the rod either way; above it and below it.
const Swing both, folded{.folds = true, .elevation = -1.75L, .rod_mass = 0.3L, .slider_mass = 0.1L},
    below{.rod = 0.25L, .offset = 0.1L, .elevation = 3.0L}, above{.rod = 0.25L, .offset = -0.1L, .elevation = 0.1L};

TEST(RockingSliderCrank, OscillatesWithinItsArcAsTwoAnglesWithAMultiplierDo) {
  for (const Swing& l : {both, folded, below, above}) {
    SCOPED_TRACE(fmt::format("offset {}, folds {}", static_cast<double>(l.offset), l.folds));
    const CrankArc arc = l.arc();
    const double from = arc.middle + 0.4 * arc.half;
    const int steps = 25000;
    State y = l.at(from, 0);
    Real least = y[0], greatest = y[0];
    int turns = 0;
    for (int k = 0; k < steps; ++k) {
      const State next = l.step(y, 2.5L / steps);
      turns += (next[2] > 0) != (y[2] > 0);
      y = next;
      least = std::min(least, y[0]), greatest = std::max(greatest, y[0]);
    }
    EXPECT_GT(static_cast<double>(greatest - least), 0.2 * arc.half);
    EXPECT_GE(turns, 3);  // some oscillations
    const Result r = run(l.scene(from, 0, 2.5));
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_NEAR(figure(r, "final_angle.swing"), static_cast<double>(y[0]), 1e-8);
    EXPECT_NEAR(figure(r, "final_speed.swing"), static_cast<double>(y[2]), 1e-7);
    EXPECT_LT(r.energy.relative, 1e-8);
    ASSERT_FALSE(r.notes.empty());
    EXPECT_EQ(r.notes.front().find("\"swing\" cannot turn: its crank rocks between φ = "), 0u) << r.notes.front();
  }
}

// −l ≤ e − r sin φ ≤ l.
TEST(RockingSliderCrank, ArcEndsWhereTheRodStandsSquareToTheLine) {
  EXPECT_NEAR(both.arc().middle - both.arc().half, std::asin(-0.45), 1e-15);
  EXPECT_NEAR(both.arc().middle + both.arc().half, std::asin(0.75), 1e-15);
  EXPECT_NEAR(below.arc().middle, pi / 2, 1e-15);
  EXPECT_NEAR(below.arc().half, pi / 2 + std::asin(0.75), 1e-15);
  EXPECT_NEAR(above.arc().middle, -pi / 2, 1e-15);
  EXPECT_NEAR(above.arc().half, below.arc().half, 1e-15);
  EXPECT_FALSE((SliderLoop{0.1L, 0.13L, 0.03L}.arc()));  // passes upright
  EXPECT_FALSE((SliderLoop{0.1L, 0.35L, 0.03L}.arc()));  // turns
  EXPECT_FALSE((SliderLoop{0.1L, 0.2L, 0.31L}.arc()));   // does not reach the line
  EXPECT_NE(
      MechanismElement(Mechanism("swing", both.data()))
          .describe()
          .find("its crank rocks between φ = -26.74° and 48.59°, where the rod stands square to the slider's line"),
      std::string::npos);
}

// The reference goes on through the end of the arc; the run ends there, at its time, and says where and what to do.
TEST(RockingSliderCrank, EndOfItsArcEndsTheRunReportedWithTimeAndAngle) {
  for (const Swing& l : {both, below}) {
    const CrankArc arc = l.arc();
    State y = l.at(arc.middle, 25);
    const Real h = 2e-6L, end = arc.middle + arc.reach();
    Real t = 0;
    State next = l.step(y, h);
    for (; t < 1 && next[0] < end; t += h) y = next, next = l.step(y, h);
    ASSERT_LT(static_cast<double>(t), 1);
    const Real time = t + h * (end - y[0]) / (next[0] - y[0]);
    const Result r = run(l.scene(arc.middle, 25, 2), false);
    ASSERT_FALSE(r.complete);
    const std::string reported =
        fmt::format("comes to the end of its arc at φ = {:.4g}°", static_cast<double>(end) * 180 / pi);
    EXPECT_NE(r.diagnosis.find(reported), std::string::npos) << r.diagnosis << "\nnot: " << reported;
    EXPECT_NEAR(std::stod(r.diagnosis.substr(r.diagnosis.find("t = ") + 4)), static_cast<double>(time), 1e-6);
  }
}

// Both extractions against Simbody's bodies, each channel by itself, out to the ends where the inertia has no bound.
TEST(RockingSliderCrank, TablesAreThoseOfTheBodiesOverTheWholeArc) {
  for (const Swing& l : {both, folded, below, above}) {
    SCOPED_TRACE(fmt::format("offset {}, folds {}", static_cast<double>(l.offset), l.folds));
    const SliderCrankData d = l.data();
    const Mechanism m("swing", d), second = m.extracted_from(Extraction::second);
    const CrankArc arc = *m.arc();
    const std::unique_ptr<MechanismBodies> bodies = make_bodies(d);
    for (double part = -0.998; part < 1; part += 0.0713) {
      const double phi = arc.middle + part * arc.half;
      const ReducedSample s = bodies->sample(phi);
      const double r = d.radius;
      for (const Mechanism* k : {&m, &second}) {
        SCOPED_TRACE(part);
        EXPECT_NEAR(k->reduced->inertia(phi).value, s.inertia, 1e-9 * s.inertia);
        EXPECT_NEAR(k->reduced->inertia(phi).slope, s.inertia_slope,
                    1e-8 * (s.inertia / arc.half + std::fabs(s.inertia_slope)));
        EXPECT_NEAR(k->reduced->output_position(phi).value, s.output_position, 1e-10 * r);
        EXPECT_NEAR(k->reduced->output_position(phi).slope, s.output_velocity_ratio,
                    1e-9 * (r + std::fabs(s.output_velocity_ratio)));
        EXPECT_NEAR(k->reduced->gravity_torque(phi).value, s.gravity_torque, 1e-8 * s.gravity_torque_scale);
      }
      const State there = l.at(phi, 1);
      EXPECT_NEAR(s.output_position, r * std::cos(phi) + d.rod_length * std::cos(static_cast<double>(there[1])), 1e-12);
    }
    EXPECT_GT(m.reduced->inertia(arc.middle + arc.reach()).value, 5 * m.reduced->inertia(arc.middle).value);
  }
}

// The mirror image below the line has the angles' signs turned.
TEST(RockingSliderCrank, MirroredOffsetMakesTheMirroredMotion) {
  const Mechanism a("swing", below.data()), b("swing", above.data());
  for (double phi = -0.5; phi < 3.5; phi += 0.3) {
    EXPECT_NEAR(a.reduced->inertia(phi).value, b.reduced->inertia(-phi).value, 1e-10);
    EXPECT_NEAR(a.reduced->output_position(phi).value, b.reduced->output_position(-phi).value, 1e-11);
  }
}

TEST(RockingSliderCrank, JacobianIsThatOfDifferences) {
  const CrankArc arc = both.arc();
  for (const double part : {-0.9, -0.2, 0.5, 0.95})
    test::expect_exact_jacobian(both.scene(arc.middle, 0, 1), arc.middle + part * arc.half, {}, {3.0});
}

// What the pins' friction takes is what the drag of the slider does not take of the energy that is gone.
TEST(RockingSliderCrank, FrictionInItsJointsTakesWhatTheEnergyLacks) {
  const CrankArc arc = both.arc();
  const std::string friction = "crank_pin = { radius = \"20 mm\", friction = 0.1 }\n[effects]\njoint_friction = true";
  const double from = arc.middle + 0.4 * arc.half;
  const Result smooth = run(both.scene(from, 0, 0.3)), rough = run(both.scene(from, 0, 0.3, friction));
  ASSERT_TRUE(smooth.complete && rough.complete) << smooth.diagnosis << rough.diagnosis;
  EXPECT_LT(rough.energy.relative, 1e-7);
  EXPECT_LT(figure(rough, "work.harmful"), -1e-3);
  EXPECT_GT(std::abs(figure(smooth, "final_angle.swing") - figure(rough, "final_angle.swing")), 1e-4);
}

}  // namespace
}  // namespace kurbel::rocking_slider_crank_test
