// hard_linkages_test.cpp — linkages near change points and dead centres, with light links, and with springs over a toggle.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "mechanisms/reduced/reduced_mechanism.h"
#include "tests/mechanisms/circles_cut.h"
#include "tests/mechanisms/linkage_checks.h"
#include "tests/mechanisms/linkage_examples.h"
#include "tests/support/scenes.h"

namespace kurbel::hard_linkages_test {
namespace {

using test::Complex;
using test::crank_pin;
using test::cut;
using test::Moving;
using test::Real;
using test::SketchOf;
using test::turning;
constexpr Real pi = std::numbers::pi_v<Real>;

// A four-bar O A B C, drawn where its crank stands square to the frame; a rocker of inertia alone.
struct FourBar {
  Real crank, coupler, rocker, frame;
  Moving pin(Real phi) const { return cut(crank_pin(crank, phi), coupler, {frame, {}}, rocker, 1); }
  // Of a crank of 0.01 kg·m² and a rocker of 1 kg·m².
  Real inertia(Real phi) const { return 0.01L + std::pow(turning({frame, {}}, pin(phi)), 2); }
  LinkageData data(Real drawn_at) const {
    SketchOf of;
    const auto point = [&](char name, Complex at) { of.point(name, double(at.real()), double(at.imag())); };
    point('O', {}), point('A', crank_pin(crank, drawn_at).p), point('B', pin(drawn_at).p), point('C', frame);
    of.frame("OC").link("crank", "OA", 1, 0.01).com(0, 0).link("coupler", "AB").link("rocker", "CB", 1, 1);
    of.com(double(frame), 0).rocks("rocker");
    return of.data();
  }
};

// A parallelogram whose coupler is too short by ε: twice a turn its links come within √ε of one line. Within these errors
// of the largest value the ratio is right there, by series and by Simbody.
TEST(HardLinkages, NearChangePoints) {
  for (const double epsilon : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    SCOPED_TRACE(epsilon);
    const FourBar bar{0.1L, 0.3L - 0.1L * epsilon, 0.1L + 0.2L * epsilon, 0.3L};
    const LinkageData data = bar.data(1.2L);
    ASSERT_TRUE(data.linkage->faults().empty()) << data.linkage->faults()[0].text;
    ASSERT_FALSE(data.linkage->arc());
    const auto bodies = make_bodies(data);
    Real largest = 0, off = 0, off_by_simbody = 0;
    for (const Real middle : {0.0L, pi})
      for (int i = -20; i <= 20; ++i) {
        const double phi = double(middle + std::copysign(std::pow(10.0L, std::abs(i) / 4.0L - 5), i));
        // The sketch's doubles are the linkage's lengths.
        const Real wanted = bar.inertia(phi);
        largest = std::max(largest, wanted);
        off = std::max(off, std::fabs(closed_sample(data, phi).inertia - wanted));
        off_by_simbody = std::max(off_by_simbody, std::fabs(bodies->sample(phi).inertia - wanted));
      }
    EXPECT_LE(double(off / largest), 1e-15 / epsilon);
    EXPECT_LE(double(off_by_simbody / largest), 1e-14 / epsilon);
    // The tables say so themselves.
    const ReducedMechanism first = extract_mechanism(data),
                           second = extract_mechanism(data, table_tolerance, table_max_pieces, Extraction::second);
    double apart = 0;
    for (int i = 0; i < 400; ++i) {
      const double phi = double(2 * pi) * (i + 0.2) / 400, inertia = first.inertia(phi).value;
      apart = std::max(apart, std::abs(second.inertia(phi).value - inertia) / inertia);
    }
    EXPECT_LE(apart, 4 * second.report().channels[0].error + 2 * table_tolerance);
  }
}

// A double rocker: up to a millionth of its arc from where it locks.
TEST(HardLinkages, NearDeadCentres) {
  const FourBar bar{0.3L, 0.2L, 0.35L, 0.4L};
  const LinkageData data = bar.data(1.4L);
  ASSERT_TRUE(data.linkage->faults().empty() && data.linkage->arc());
  const CrankArc arc = *data.linkage->arc();
  // Coupler and rocker in one line: stretched; law of cosines.
  const Real locked = std::acos((0.3L * 0.3L + 0.4L * 0.4L - 0.55L * 0.55L) / (2 * 0.3L * 0.4L));
  EXPECT_NEAR(double(arc.middle + arc.half), double(locked), 1e-12);
  const auto bodies = make_bodies(data);
  for (const double part : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const double phi = arc.middle + arc.half * (1 - part);
    const Real wanted = bar.inertia(phi);
    EXPECT_NEAR(closed_sample(data, phi).inertia / double(wanted), 1, 1e-14 / part) << part;
    EXPECT_NEAR(bodies->sample(phi).inertia / double(wanted), 1, 1e-13 / part) << part;
  }
}

// All links but the driving one lighter and lighter: nothing depends on them in the end, and energy is kept.
TEST(HardLinkages, LightLinks) {
  for (const double mass : {1.0, 1e-3, 1e-6, 1e-9, 0.0}) {
    SCOPED_TRACE(mass);
    SketchOf of = test::stephenson();
    for (std::size_t k = 1; k < of.s.links.size(); ++k) of.s.links[k].mass *= mass, of.s.links[k].inertia *= mass;
    const LinkageData data = of.data();
    test::expect_both_extractions(data, 1e-12);
    const double crank = of.s.links[0].inertia + of.s.links[0].mass * 0.025 * 0.025;
    for (int i = 0; i < 12; ++i) {
      const double rest = closed_sample(data, 0.5 * i).inertia - crank;
      const double one = closed_sample(test::stephenson().data(), 0.5 * i).inertia - crank;
      EXPECT_NEAR(rest, mass * one, 1e-16 + 1e-14 * mass * one);
    }
  }
}

// A lever with a spring over its toggle, E = J ω²/2 + k (s − s₀)²/2 with s² = a² + b² − 2 a b cos φ: kept over passages
// of the toggle for springs of five orders of stiffness, and shared out as the closed form has it.
TEST(HardLinkages, SpringsOverAToggle) {
  for (const double stiffness : {1.0, 1e2, 1e4, 1e6}) {
    SCOPED_TRACE(stiffness);
    const Result r = test::run(test::scene_from(fmt::format(R"(
line = ["m"]
[m]
kind   = "linkage"
unit   = "mm"
points = {{ O = [0, 0], A = [50, 0], B = [190, 140], C = [240, 0], T = [80, 0] }}
frame  = "O C T"
[m.links]
crank   = {{ points = "O A", mass = "1 kg", com = [0, 0], inertia = "0.5 kg*m2" }}
coupler = "A B"
rocker  = "C B"
[m.springs]
over    = {{ between = "T A", stiffness = "{} N/m", free_length = "90 mm" }}
[run]
start    = {{ speed = "{} rad/s", angle = "100 deg" }}
until    = "1 s"
accuracy = 1e-11
)",
                                                            stiffness, 1.0 + 0.3 * std::sqrt(stiffness))));
    EXPECT_TRUE(r.complete) << r.diagnosis;
    EXPECT_LT(r.energy.relative, 1e-10);
    const double phi = test::figure(r, "final_angle.m"), omega = test::figure(r, "final_speed.m");
    const double start = 1.0 + 0.3 * std::sqrt(stiffness);
    const auto stored = [&](double angle) {
      const double s = std::sqrt(0.0025 + 0.0064 - 0.008 * std::cos(angle));
      return 0.5 * stiffness * std::pow(s - 0.09, 2);
    };
    const double before = 0.25 * start * start + stored(100 * double(pi) / 180),
                 after = 0.25 * omega * omega + stored(phi);
    EXPECT_NEAR(after, before, 1e-8 * before);
  }
}

}  // namespace
}  // namespace kurbel::hard_linkages_test
