// rocking_crank_test.cpp — four-bars whose crank cannot turn fully, against equations of motion of their own: three angles
// and two closures with multipliers, in long double, which pass the ends of the crank's arc like any other place.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "engine/rigid/rigid_machine.h"
#include "mechanisms/reduced/mechanism.h"
#include "tests/support/jacobians.h"

namespace kurbel::rocking_crank_test {
namespace {

using test::figure;
using test::run;
using Real = long double;
using State = std::array<Real, 6>;  // φ, β of the coupler, ψ of the rocker; their rates
using std::numbers::pi;

struct Linkage {
  Real crank, coupler, rocker, ground;
  Real crank_mass = 5, crank_com = 0.05L, crank_inertia = 0.06L;
  Real coupler_mass = 1.5L, coupler_com = 0.06L, coupler_inertia = 0.004L;
  Real rocker_mass = 2, rocker_com = 0.03L, rocker_inertia = 0.03L;
  Real gravity = 9.81L, elevation, drag = 0.05L;  // of the rocker [N·m·s/rad]

  // The open branch: B left of A → D.
  State at(Real phi, Real omega) const {
    const Real x = ground - crank * std::cos(phi), y = -crank * std::sin(phi), s = std::hypot(x, y);
    const Real foot = (s * s + coupler * coupler - rocker * rocker) / (2 * s);
    const Real high = std::sqrt(coupler * coupler - foot * foot);
    const Real bx = (foot * x - high * y) / s, by = (foot * y + high * x) / s;
    const Real beta = std::atan2(by, bx), psi = std::atan2(by - y, bx - x);
    // Rates by the closures: a φ̇ t_φ + b β̇ t_β = c ψ̇ t_ψ, each along the other link.
    const Real sine = std::sin(psi - beta);
    return {phi,
            beta,
            psi,
            omega,
            omega * crank * std::sin(phi - psi) / (coupler * sine),
            omega * crank * std::sin(phi - beta) / (rocker * sine)};
  }
  State rate(const State& y) const {
    const auto& [phi, beta, psi, w, u, v] = y;
    const Real k = coupler_mass * crank * coupler_com, sine = std::sin(beta - phi), cosine = std::cos(beta - phi);
    const auto rise = [&](Real angle) {  // of a point on a link, by its angle
      return -std::sin(angle) * std::sin(elevation) + std::cos(angle) * std::cos(elevation);
    };
    // M q̈ + Gᵀ λ = Q, G q̈ = −Ġ q̇; unknowns q̈, λ.
    Real m[5][6] = {
        {crank_inertia + coupler_mass * crank * crank, k * cosine, 0, -crank * std::sin(phi), crank * std::cos(phi),
         k * sine * u * u - gravity * (crank_mass * crank_com + coupler_mass * crank) * rise(phi)},
        {k * cosine, coupler_inertia + coupler_mass * coupler_com * coupler_com, 0, -coupler * std::sin(beta),
         coupler * std::cos(beta), -k * sine * w * w - gravity * coupler_mass * coupler_com * rise(beta)},
        {0, 0, rocker_inertia, rocker * std::sin(psi), -rocker * std::cos(psi),
         -gravity * rocker_mass * rocker_com * rise(psi) - drag * v},
        {-crank * std::sin(phi), -coupler * std::sin(beta), rocker * std::sin(psi), 0, 0,
         crank * std::cos(phi) * w * w + coupler * std::cos(beta) * u * u - rocker * std::cos(psi) * v * v},
        {crank * std::cos(phi), coupler * std::cos(beta), -rocker * std::cos(psi), 0, 0,
         crank * std::sin(phi) * w * w + coupler * std::sin(beta) * u * u - rocker * std::sin(psi) * v * v}};
    for (int c = 0; c < 5; ++c) {
      int pivot = c;
      for (int r = c + 1; r < 5; ++r)
        if (std::abs(m[r][c]) > std::abs(m[pivot][c])) pivot = r;
      std::swap(m[c], m[pivot]);
      for (int r = 0; r < 5; ++r) {
        if (r == c) continue;
        const Real part = m[r][c] / m[c][c];
        for (int j = c; j < 6; ++j) m[r][j] -= part * m[c][j];
      }
    }
    return {w, u, v, m[0][5] / m[0][0], m[1][5] / m[1][1], m[2][5] / m[2][2]};
  }
  State step(const State& y, Real h) const {
    const auto moved = [&](const State& by, Real part) {
      State to{};
      for (std::size_t i = 0; i < 6; ++i) to[i] = y[i] + part * by[i];
      return to;
    };
    const State a = rate(y), b = rate(moved(a, h / 2)), c = rate(moved(b, h / 2)), d = rate(moved(c, h));
    State to{};
    for (std::size_t i = 0; i < 6; ++i) to[i] = y[i] + h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    return to;
  }
  std::string scene(double phi, double omega, double until) const {
    const auto n = [](Real v) { return static_cast<double>(v); };
    return fmt::format(R"(
line = ["bar"]
[bar]
kind = "four-bar"
crank = "{} m"
coupler = "{} m"
rocker = "{} m"
ground = "{} m"
crank_mass = "{} kg"
crank_com = "{} m"
crank_inertia = "{} kg*m2"
coupler_mass = "{} kg"
coupler_com = "{} m"
coupler_inertia = "{} kg*m2"
rocker_mass = "{} kg"
rocker_com = "{} m"
rocker_inertia = "{} kg*m2"
gravity = "{} m/s2"
ground_angle = "{} rad"
load = {{ kind = "medium", viscous = "{} N*m*s/rad" }}
[run]
start = {{ angle = "{} rad", speed = "{} rad/s" }}
until = "{} s"
accuracy = 1e-10
)",
                       n(crank), n(coupler), n(rocker), n(ground), n(crank_mass), n(crank_com), n(crank_inertia),
                       n(coupler_mass), n(coupler_com), n(coupler_inertia), n(rocker_mass), n(rocker_com),
                       n(rocker_inertia), n(gravity), n(elevation), n(drag), phi, omega, until);
  }
};

// Stops outside, stops on both sides, stops inside; the crank hangs about the middle of its arc.
const Linkage outside{.crank = 0.06L, .coupler = 0.2L, .rocker = 0.15L, .ground = 0.3L, .elevation = -1.5L};
const Linkage both{.crank = 0.2L, .coupler = 0.15L, .rocker = 0.1L, .ground = 0.18L, .elevation = -2.4L};
const Linkage inside{.crank = 0.2L, .coupler = 0.4L, .rocker = 0.12L, .ground = 0.15L, .elevation = 1.4L};

FourBarData data_of(const Linkage& l) {
  const auto n = [](Real v) { return static_cast<double>(v); };
  FourBarData d;
  d.crank = n(l.crank), d.coupler = n(l.coupler), d.rocker = n(l.rocker), d.ground = n(l.ground);
  d.crank_body = {n(l.crank_mass), n(l.crank_com), n(l.crank_inertia)};
  d.coupler_body = {n(l.coupler_mass), n(l.coupler_com), n(l.coupler_inertia)};
  d.rocker_body = {n(l.rocker_mass), n(l.rocker_com), n(l.rocker_inertia)};
  d.gravity = n(l.gravity), d.ground_angle = n(l.elevation);
  return d;
}

TEST(RockingCrank, OscillatesWithinItsArcAsThreeAnglesWithMultipliersDo) {
  for (const Linkage& l : {outside, both, inside}) {
    SCOPED_TRACE(static_cast<double>(l.ground));
    const CrankArc arc = *data_of(l).loop().arc();
    const double from = arc.middle + 0.3 * arc.half;
    const int steps = 25000;
    State y = l.at(from, 0);
    Real least = y[0], greatest = y[0];
    for (int k = 0; k < steps; ++k) {
      y = l.step(y, 2.0L / steps);
      least = std::min(least, y[0]), greatest = std::max(greatest, y[0]);
    }
    EXPECT_GT(static_cast<double>(greatest - least), 0.2 * arc.half);  // it oscillates
    const Result r = run(l.scene(from, 0, 2));
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_NEAR(figure(r, "final_angle.bar"), static_cast<double>(y[0]), 2e-8);
    EXPECT_NEAR(figure(r, "final_speed.bar"), static_cast<double>(y[3]), 2e-7);
    EXPECT_LT(r.energy.relative, 1e-8);
  }
}

// The reference goes on through the end of the arc; the run ends there, at its time, and says where and what to do.
TEST(RockingCrank, EndOfItsArcEndsTheRunReportedWithTimeAndAngle) {
  for (const double way : {1.0, -1.0}) {
    const CrankArc arc = *data_of(both).loop().arc();
    State y = both.at(arc.middle, way * 12);
    const Real h = 1e-5L, end = arc.middle + way * arc.reach();
    Real t = 0;
    State next = both.step(y, h);
    for (; t < 1 && way * (next[0] - end) < 0; t += h) y = next, next = both.step(y, h);
    ASSERT_LT(static_cast<double>(t), 1);
    const Real time = t + h * (end - y[0]) / (next[0] - y[0]);
    const Result r = run(both.scene(arc.middle, way * 12, 2), false);
    ASSERT_FALSE(r.complete);
    const std::string reported =
        fmt::format("comes to the end of its arc at φ = {:.4g}°", static_cast<double>(end) * 180 / pi);
    EXPECT_NE(r.diagnosis.find(reported), std::string::npos) << r.diagnosis << "\nnot: " << reported;
    EXPECT_NE(r.diagnosis.find("let a load, a spring or a brake reverse it before"), std::string::npos);
    const double reported_time = std::stod(r.diagnosis.substr(r.diagnosis.find("t = ") + 4));
    EXPECT_NEAR(reported_time, static_cast<double>(time), 1e-6);
  }
}

// Both extractions, each channel by itself, out to the ends where the inertia grows without bound.
TEST(RockingCrank, TablesAreThoseOfTheBodiesOverTheWholeArc) {
  for (const Linkage& l : {outside, both, inside}) {
    SCOPED_TRACE(static_cast<double>(l.ground));
    const FourBarData d = data_of(l);
    const Mechanism m("bar", d), second = m.extracted_from(Extraction::second);
    const CrankArc arc = *m.arc();
    const std::unique_ptr<MechanismBodies> bodies = make_bodies(d);
    for (double part = -0.998; part < 1; part += 0.0713) {
      const double phi = arc.middle + part * arc.half;
      const ReducedSample s = bodies->sample(phi);
      for (const Mechanism* k : {&m, &second}) {
        SCOPED_TRACE(part);
        const double size = s.inertia / arc.half;
        EXPECT_NEAR(k->reduced->inertia(phi).value, s.inertia, 1e-9 * s.inertia);
        EXPECT_NEAR(k->reduced->inertia(phi).slope, s.inertia_slope, 1e-8 * (size + std::fabs(s.inertia_slope)));
        EXPECT_NEAR(std::remainder(k->reduced->output_position(phi).value - s.output_position, 2 * pi), 0, 1e-9);
        EXPECT_NEAR(k->reduced->output_position(phi).slope, s.output_velocity_ratio,
                    1e-9 * (1 + std::fabs(s.output_velocity_ratio)));
        EXPECT_NEAR(k->reduced->gravity_torque(phi).value, s.gravity_torque, 1e-8 * s.gravity_torque_scale);
      }
      const Real rate = l.at(phi, 1)[5];
      EXPECT_NEAR(s.output_velocity_ratio, static_cast<double>(rate), 1e-9 * (1 + std::fabs(s.output_velocity_ratio)));
    }
    EXPECT_GT(m.reduced->inertia(arc.middle + arc.reach()).value, 5 * m.reduced->inertia(arc.middle).value);
    EXPECT_NE(MechanismElement(m).describe().find("its crank rocks between φ ="), std::string::npos);
  }
}

TEST(RockingCrank, HasNoCycleAndNoPlaceBeyondItsArc) {
  const CrankArc arc = *data_of(both).loop().arc();
  const double outer = std::acos((0.04 + 0.0324 - 0.0625) / (2 * 0.2 * 0.18));
  const double inner = std::acos((0.04 + 0.0324 - 0.0025) / (2 * 0.2 * 0.18));
  EXPECT_NEAR(arc.middle - arc.half, inner, 1e-14);
  EXPECT_NEAR(arc.middle + arc.half, outer, 1e-14);
  try {
    run(both.scene(0, 0, 1), false);
    ADD_FAILURE() << "φ = 0 lies beyond the arc";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("cannot stand at φ = 0°: its crank rocks between φ = 13.87° and 82.1°"),
              std::string::npos)
        << error.what();
  }
  try {
    const RigidMachine machine(test::scene_from(both.scene(arc.middle, 0, 1)));
    ADD_FAILURE() << "a machine that never comes round has no cycle";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("rocks and never turns fully"), std::string::npos) << error.what();
  }
}

// Chrono's joint test Revolute_Case01 (ADAMS; tests/cases/mb05_adams_pendulum.toml) as a crank that rocks: it falls from
// the horizontal with ω² = 2 m g h/I at the bottom, and its period is 4 √(I/(m g h)) K(sin 45°).
TEST(RockingCrank, PendulumOfMb05HasThePeriodOfItsEllipticIntegral) {
  const double m = 1, h = 2, g = 9.80665, inertia = 0.1 + m * h * h;
  const double period = 4 * std::sqrt(inertia / (m * g * h)) * 1.8540746773013719;
  const auto scene = [&](double until) {
    return fmt::format(R"(
line = ["pendulum"]
[pendulum]
kind = "four-bar"
crank = "3 m"
coupler = "10 m"
rocker = "7.5 m"
ground = "15 m"
crank_mass = "{} kg"
crank_com = "{} m"
crank_inertia = "{} kg*m2"
gravity = "{} m/s2"
ground_angle = "-90 deg"
[run]
start = {{ angle = "90 deg", speed = "0 rpm" }}
until = "{} s"
accuracy = 1e-10
)",
                       m, h, inertia, g, until);
  };
  const Result bottom = run(scene(period / 4)), whole = run(scene(period));
  ASSERT_TRUE(bottom.complete && whole.complete) << bottom.diagnosis << whole.diagnosis;
  EXPECT_NEAR(figure(bottom, "final_angle.pendulum"), 0, 1e-8);
  EXPECT_NEAR(figure(bottom, "final_speed.pendulum"), -std::sqrt(2 * m * g * h / inertia), 1e-8);
  EXPECT_NEAR(figure(whole, "final_angle.pendulum"), pi / 2, 1e-8);
  EXPECT_NEAR(figure(whole, "final_speed.pendulum"), 0, 1e-7);
}

// The crossed branch is the mirror image of the open one.
TEST(RockingCrank, MirroredLinkageMakesTheMirroredMotion) {
  const FourBarData d = data_of(outside);
  FourBarData mirrored = d;
  mirrored.crossed = true;
  const Mechanism a("bar", d), b("bar", mirrored);
  for (double phi = -2.4; phi < 2.4; phi += 0.3) {
    EXPECT_NEAR(a.reduced->inertia(phi).value, b.reduced->inertia(-phi).value, 1e-10);
    EXPECT_NEAR(a.reduced->output_position(phi).slope, b.reduced->output_position(-phi).slope, 1e-10);
  }
}

TEST(RockingCrank, JacobianIsThatOfDifferences) {
  const CrankArc arc = *data_of(both).loop().arc();
  for (const double part : {-0.9, -0.2, 0.5, 0.95})
    test::expect_exact_jacobian(both.scene(arc.middle, 0, 1), arc.middle + part * arc.half, {}, {3.0});
}

}  // namespace
}  // namespace kurbel::rocking_crank_test
