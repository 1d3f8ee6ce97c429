// known_linkages_test.cpp — linkages that people know, against circles cut by complex numbers in this file: Watt's and
// Stephenson's chains, a six-link press, Klann's leg, linkages one behind another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "mechanisms/reduced/mechanism.h"
#include "mechanisms/reduced/newton_euler.h"
#include "tests/mechanisms/circles_cut.h"
#include "tests/mechanisms/linkage_checks.h"
#include "tests/mechanisms/linkage_examples.h"
#include "tests/support/scenes.h"

namespace kurbel::known_linkages_test {
namespace {

using test::carried;
using test::Complex;
using test::crank_pin;
using test::cut;
using test::Moving;
using test::Real;
using test::side_of;
using test::SketchOf;
using test::turning;
constexpr Real pi = std::numbers::pi_v<Real>;

Complex drawn(const LinkageData& data, char name) {
  for (const LinkageSketch::Point& p : data.linkage->sketch().points)
    if (p.name[0] == name) return {p.x, p.y};
  return {};
}
// Where the linkage has a point, in the axes of the sketch from the driving link's bearing on.
Complex place(const LinkageData& data, const LinkPoses& poses, char name) {
  const Linkage& l = *data.linkage;
  const LinkageSketch& s = l.sketch();
  for (int p = 0; p < static_cast<int>(s.points.size()); ++p) {
    if (s.points[static_cast<std::size_t>(p)].name[0] != name) continue;
    int body = LinkageSketch::frame;
    while (!s.has(body, p)) ++body;
    const Path at = poses[body](l.spot_of(p));
    return Complex(at.x.value(), at.y.value()) * std::polar(Real(1), Real(l.structure().axes.turned()));
  }
  return {};
}

// Σ m |v_S|² + J ϑ′² of links by two points each.
class InertiaSum {
 public:
  InertiaSum(const LinkageData& data) : s_(data.linkage->sketch()) {}
  void add(const std::string& name, const Moving& a, const Moving& b, Complex sketch_a, Complex sketch_b) {
    for (const LinkageSketch::Link& link : s_.links) {
      if (link.name != name) continue;
      const Moving com = carried(a, b, sketch_a, sketch_b, {link.com_x, link.com_y});
      const Real w = turning(a, b);
      sum_ += link.mass * std::norm(com.v) + link.inertia * w * w;
    }
  }
  double sum() const { return static_cast<double>(sum_); }

 private:
  const LinkageSketch& s_;
  Real sum_ = 0;
};

// A crank OA, a four-bar O A B C, and a dyad D E G behind it; D on the link through `first` and `second`.
struct SixBar {
  LinkageData data;
  char first, second;
  std::string carrier, fourth, fifth;

  struct At {
    Moving a, b, c, d, e, g;
  };
  At at(Real phi) const {
    const auto p = [&](char name) { return drawn(data, name); };
    At x;
    x.a = crank_pin(std::abs(p('A') - p('O')), phi), x.a.p += p('O');
    x.c = {p('C'), {}}, x.g = {p('G'), {}};
    x.b = cut(x.a, std::abs(p('B') - p('A')), x.c, std::abs(p('B') - p('C')), side_of(p('A'), p('C'), p('B')));
    const Moving &from = first == 'A' ? x.a : x.c, &to = x.b;
    x.d = carried(from, to, p(first), p(second), p('D'));
    x.e = cut(x.d, std::abs(p('E') - p('D')), x.g, std::abs(p('E') - p('G')), side_of(p('D'), p('G'), p('E')));
    return x;
  }
  double inertia(const At& x) const {
    const auto p = [&](char name) { return drawn(data, name); };
    InertiaSum sum(data);
    sum.add("crank", {p('O'), {}}, x.a, p('O'), p('A'));
    sum.add("coupler", x.a, x.b, p('A'), p('B'));
    sum.add("rocker", x.c, x.b, p('C'), p('B'));
    sum.add("rod", x.d, x.e, p('D'), p('E'));
    sum.add("lever", x.g, x.e, p('G'), p('E'));
    return sum.sum();
  }
};

void expect_six_bar(const SixBar& six) {
  const LinkageData& data = six.data;
  ASSERT_TRUE(data.linkage->faults().empty()) << data.linkage->faults()[0].text;
  ASSERT_FALSE(data.linkage->arc());
  const auto bodies = make_bodies(data);
  for (int i = 0; i < 72; ++i) {
    const Real phi = (5 * i + 0.3L) * pi / 180;
    const SixBar::At x = six.at(phi);
    const LinkPoses poses = data.linkage->poses(phi);
    for (const auto& [name, moving] : {std::pair{'B', x.b}, {'D', x.d}, {'E', x.e}})
      EXPECT_LT(std::abs(place(data, poses, name) + drawn(data, 'O') - moving.p), 1e-16L) << name << " at " << phi;
    const double inertia = six.inertia(x);
    EXPECT_NEAR(closed_sample(data, double(phi)).inertia, inertia, 1e-14 * inertia);
    EXPECT_NEAR(bodies->sample(double(phi)).inertia, inertia, 1e-12 * inertia);
  }
}

// Watt's second chain: two four-bars that share a rocker of three points.
SixBar watt() {
  SketchOf of;
  of.point('O', 0, 0).point('A', 0.04, 0.03).point('B', 0.22, 0.15).point('C', 0.25, -0.02).point('D', 0.33, 0.13);
  of.point('E', 0.5, 0.2).point('G', 0.48, -0.05).frame("OCG");
  of.link("crank", "OA", 2, 0.004).link("coupler", "AB", 1.5, 0.01).link("rocker", "CBD", 2.5, 0.02);
  of.link("rod", "DE", 1.2, 0.006).link("lever", "GE", 3, 0.03).rocks("lever");
  return {of.data(), 'C', 'B', "rocker", "rod", "lever"};
}
SixBar stephenson() { return {test::stephenson().data(), 'A', 'B', "coupler", "rod", "lever"}; }

TEST(KnownLinkages, WattsChain) { expect_six_bar(watt()); }
TEST(KnownLinkages, StephensonsChain) { expect_six_bar(stephenson()); }

// One behind another, the rocker of one drives the next: ψ₂(ψ₁(φ)) by the second four-bar alone.
TEST(KnownLinkages, OneLinkageBehindAnother) {
  const SixBar six = watt();
  SketchOf of;
  of.point('C', 0.25, -0.02).point('D', 0.33, 0.13).point('E', 0.5, 0.2).point('G', 0.48, -0.05).frame("CG");
  of.link("rocker", "CD", 1, 0.02).link("rod", "DE", 1.2, 0.006).link("lever", "GE", 3, 0.03).rocks("lever");
  const LinkageData next = of.data();
  ASSERT_TRUE(next.linkage->faults().empty());
  for (int i = 0; i < 36; ++i) {
    const Real phi = (10 * i + 0.3L) * pi / 180;
    const SixBar::At x = six.at(phi);
    const double psi = static_cast<double>(std::arg(x.d.p - x.c.p));
    const ReducedSample whole = closed_sample(six.data, double(phi)), second = closed_sample(next, psi);
    EXPECT_NEAR(std::remainder(whole.output_position - second.output_position, double(2 * pi)), 0, 1e-14);
    EXPECT_NEAR(whole.output_velocity_ratio, second.output_velocity_ratio * double(turning(x.c, x.d)), 1e-14);
  }
}

// Driven from its other loop: a group of class III. The crank's angle that belongs to the lever's by bisection in this
// file; inertia and rates by the ratio there.
TEST(KnownLinkages, StephensonsChainDrivenFromItsOtherLoop) {
  const SixBar six = stephenson();
  const LinkageData by_lever = test::stephenson().drives("lever").rocks("crank").data();
  ASSERT_EQ(name_of(by_lever.linkage->structure().groups.at(0)), "class III of order 3");
  const CrankArc arc = *by_lever.linkage->arc();
  const auto bodies = make_bodies(by_lever);
  const auto lever = [&](Real phi) {
    const SixBar::At x = six.at(phi);
    return std::arg(x.e.p - x.g.p);
  };
  // From the sketch on to where the lever reverses.
  int compared = 0;
  for (const int sense : {-1, 1}) {
    Real last = 0;
    for (int k = 0; k < 90; ++k, ++compared) {
      const Real phi = last + sense * pi / 180, step = lever(phi) - lever(last),
                 first = lever(sense * pi / 180) - lever(0);
      if (step * first < 0) break;
      last = phi;
      const double psi = arc.near(double(lever(phi)));
      if (std::abs(psi - arc.middle) > 0.95 * arc.half) break;
      const SixBar::At x = six.at(phi);
      const Real ratio = turning(x.g, x.e);
      const ReducedSample other = closed_sample(by_lever, psi), simbody = bodies->sample(psi);
      // ψ is a double, so that φ is known to its rounding over the ratio.
      const double known = 4e-15 * std::max(1.0, std::abs(1 / double(ratio)));
      EXPECT_NEAR(std::remainder(other.output_position - double(phi), double(2 * pi)), 0, known) << k;
      EXPECT_NEAR(other.output_velocity_ratio * double(ratio), 1, 1e-12) << k;
      const double inertia = six.inertia(x) / double(ratio * ratio);
      EXPECT_NEAR(other.inertia / inertia, 1, 1e-12) << k;
      EXPECT_NEAR(simbody.inertia / inertia, 1, 1e-11) << k;
    }
  }
  EXPECT_GT(compared, 40);
}

// The press of the scenes: its ram by a circle on a line; how long it stands near its lower end; which force a torque of
// the crank holds on the way there.
TEST(KnownLinkages, SixLinkPressDwellsAndGainsForce) {
  const auto model = compile(test::scene_file("scenes/six_link_press.toml"), Effects{});
  const Mechanism* press = find_mechanism(model->network, "press");
  ASSERT_NE(press, nullptr);
  const LinkageData& data = *press->data.as<LinkageData>();
  const auto p = [&](char name) { return drawn(data, name); };
  // x downwards from the crank's axis, with its derivative.
  const auto ram = [&](Real phi) {
    const Moving a = crank_pin(std::abs(p('A')), phi), c = {p('C'), {}};
    const Moving b = cut(a, std::abs(p('B') - p('A')), c, std::abs(p('B') - p('C')), side_of(p('A'), p('C'), p('B')));
    const Moving d = carried(a, b, p('A'), p('B'), p('D'));
    const Real rod = std::abs(p('E') - p('D')), aside = p('E').real() - d.p.real(),
               high = std::sqrt(rod * rod - aside * aside);
    return std::pair(high - d.p.imag(), aside * d.v.real() / high - d.v.imag());
  };
  Real greatest = 0, least = 10;
  for (int i = 0; i < 3600; ++i) {
    const auto [x, slope] = ram(i * pi / 1800);
    greatest = std::max(greatest, x), least = std::min(least, x);
    if (i % 60) continue;
    EXPECT_NEAR(press->reduced->output_position(double(i * pi / 1800)).value, double(x), 3e-12);
    EXPECT_NEAR(press->reduced->output_velocity(double(i * pi / 1800)).value, double(slope), 3e-12);
    // Statics: a force F up on the ram is held by M = F x′.
    const double phi = double(i * pi / 1800);
    const PlanarLinkage l = linkage_of(LinkageData{data.linkage, 0}, phi);
    EXPECT_NEAR(forces_in(l, {phi, 0, 0, -1e6}).torque, 1e6 * double(slope), 1e-6);
  }
  EXPECT_NEAR(press->stroke(), double(greatest - least), 1e-6);
  // Within 5 mm of the lower end: its share of the turn, by bisection on either side of it.
  const auto dwell = [&](const std::function<double(double)>& x, double lowest, double near) {
    double edge[2];
    for (const int side : {0, 1}) {
      double inside = lowest, outside = lowest + (side ? 1 : -1) * 1.5;
      for (int i = 0; i < 60; ++i) {
        const double middle = (inside + outside) / 2;
        (x(lowest) - x(middle) < near ? inside : outside) = middle;
      }
      edge[side] = inside;
    }
    return edge[1] - edge[0];
  };
  double lowest = 0;
  for (const double r : press->travel.reversals)
    if (press->reduced->output_position(r).value > double(greatest) - 1e-4) lowest = r;
  const double by_press = dwell([&](double phi) { return press->reduced->output_position(phi).value; }, lowest, 0.005);
  const double by_hand = dwell([&](double phi) { return double(ram(phi).first); }, lowest, 0.005);
  EXPECT_NEAR(by_press, by_hand, 1e-9);
  EXPECT_GT(by_press, 0.3);
  EXPECT_NEAR(double(ram(lowest).second), 0, 1e-9);
}

// Klann's leg with the lengths of a published optimisation (boim.com/Walkin8r): crank AC, rod C–H–F, rockers BH and DE, leg
// E–F–G. Drawn to a tenth, moved to the lengths.
TEST(KnownLinkages, KlannsLegWalks) {
  const Real ac = 17.5L, bh = 23.7L, cf = 73.4L, ch = 38.8L, de = 34.1L, ef = 57.7L, eg = 111.7L, fg = 59, fh = 35.2L;
  const Complex b{-38.8L, -12.5L}, d{-14.6L, 41.9L};
  struct Leg {
    Moving c, h, f, e, g;
  };
  const auto leg = [&](Real phi) {
    Leg x;
    x.c = crank_pin(ac, phi);
    x.h = cut(x.c, ch, {b, {}}, bh, -1);
    x.f = cut(x.c, cf, x.h, fh, -1);
    x.e = cut(x.f, ef, {d, {}}, de, 1);
    x.g = cut(x.e, eg, x.f, fg, 1);
    return x;
  };
  const Leg first = leg(0);
  SketchOf of;
  const auto point = [&](char name, Complex at) {
    of.point(name, std::round(10 * double(at.real())) / 10, std::round(10 * double(at.imag())) / 10);
  };
  of.point('A', 0, 0).point('C', 17.5, 0).point('B', -38.8, -12.5).point('D', -14.6, 41.9);
  point('H', first.h.p), point('F', first.f.p), point('E', first.e.p), point('G', first.g.p);
  of.frame("ABD");
  of.link("crank", "AC", 1, 50).link("rod", "CHF", 1, 300).link("lower", "BH", 1, 50).link("upper", "DE", 1, 50);
  of.link("leg", "EFG", 1, 900).moves("leg", 'G', 0);
  ASSERT_TRUE(take_lengths(of.s, {{1, 4, 38.8, "CH"},
                                  {1, 5, 73.4, "CF"},
                                  {4, 5, 35.2, "HF"},
                                  {2, 4, 23.7, "BH"},
                                  {3, 6, 34.1, "DE"},
                                  {6, 5, 57.7, "EF"},
                                  {6, 7, 111.7, "EG"},
                                  {5, 7, 59, "FG"}})
                  .empty());
  const LinkageData data = of.data();
  test::expect_rigid(data);
  test::expect_both_extractions(data, 1e-12);
  ASSERT_FALSE(data.linkage->arc());
  Real low = 1e3, high = -1e3, left = 1e3, right = -1e3;
  for (int i = 0; i < 360; ++i) {
    const Real phi = i * pi / 180;
    const Complex foot = place(data, data.linkage->poses(phi), 'G');
    EXPECT_LT(std::abs(foot - leg(phi).g.p), 1e-11L) << i;
    low = std::min(low, foot.imag()), high = std::max(high, foot.imag());
    left = std::min(left, foot.real()), right = std::max(right, foot.real());
  }
  // A step is longer than it is high, and over half a turn the foot keeps within a twentieth of it.
  EXPECT_GT(right - left, 1.5L * (high - low));
  int on_ground = 0;
  for (int i = 0; i < 360; ++i)
    if (leg(i * pi / 180).g.p.imag() < low + 0.05L * (right - left)) ++on_ground;
  EXPECT_GT(on_ground, 150);
}

// Two linkages on one shaft, the one a quarter of a turn ahead: inertia and energy are the sums.
TEST(KnownLinkages, TwoLinkagesOnOneShaft) {
  const std::string body = R"(
kind   = "linkage"
unit   = "mm"
points = { O = [0, 0], A = [50, 0], B = [190, 140], C = [240, 0] }
frame  = "O C"
links  = { crank = { points = "O A", mass = "2 kg", inertia = "0.1 kg*m2" }, coupler = { points = "A B", mass = "1 kg", inertia = "0.01 kg*m2" }, rocker = { points = "C B", mass = "3 kg" } }
gravity = "9.81 m/s2"
)";
  const Scene scene = test::scene_from("line = [\"a\", \"b\"]\n[a]" + body + "[b]" + body + "phase = \"90 deg\"\n" + R"(
[run]
start    = { speed = "60 rpm", on = "a" }
until    = "2 s"
accuracy = 1e-12
)");
  const Result r = test::run(scene);
  EXPECT_TRUE(r.complete) << r.diagnosis;
  EXPECT_LT(r.energy.relative, 1e-11);
  EXPECT_LT(r.energy.reduction_residual, 1e-12);
  // E is kept: ½ (I(φ) + I(φ + 90°)) ω² + U(φ) + U(φ + 90°), from I and U of one alone.
  const auto model = compile(scene, Effects{});
  const MechanismData& data = find_mechanism(model->network, "a")->data;
  const auto energy = [&](double phi, double omega) {
    double sum = 0;
    for (const double at : {phi, phi + double(pi) / 2}) {
      const ClosedForm f = data.closed_form(at);
      sum += double(f.inertia) * omega * omega / 2 + double(f.potential_energy);
    }
    return sum;
  };
  const double end = energy(test::figure(r, "final_angle.a"), test::figure(r, "final_speed.a"));
  EXPECT_NEAR(end, energy(0, double(2 * pi)), 1e-9 * std::abs(end));
}

}  // namespace
}  // namespace kurbel::known_linkages_test
