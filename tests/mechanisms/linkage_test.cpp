// linkage_test.cpp — linkages drawn as sketches: dyads and Newton's groups against closed forms, the named mechanisms, each
// other and Simbody's bodies; what is refused, and in which words.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "mechanisms/reduced/mechanism_data.h"
#include "mechanisms/reduced/newton_euler.h"
#include "tests/mechanisms/linkage_checks.h"
#include "tests/mechanisms/linkage_examples.h"
#include "tests/mechanisms/mechanism_examples.h"

namespace kurbel::linkage_test {
namespace {

using std::numbers::pi;
using test::expect_both_extractions;
using test::expect_rigid;
using test::sample_channels;
using test::SketchOf;
using test::values_in;

// --- closed forms ---

SketchOf scotch_yoke() {
  SketchOf of;
  of.point('O', 0, 0).point('A', 0.06, 0).point('Y', 0.3, 0).frame("O");
  of.link("crank", "OA", 4, 0.02).com(0.01, 0).link("block", "A", 1.2).link("yoke", "Y", 85);
  of.slide("block", pi / 2, "yoke").slide("yoke", 0).moves("yoke", 'Y', 0);
  return of;
}

TEST(Linkage, ScotchYokeIsACosine) {
  const LinkageData data = scotch_yoke().data();
  expect_rigid(data);
  expect_both_extractions(data, 1e-13);
  ASSERT_EQ(data.linkage->structure().groups.size(), 1u);
  EXPECT_EQ(name_of(data.linkage->structure().groups[0]), "RPP");
  const auto bodies = make_bodies(data);
  for (int i = 0; i < 24; ++i) {
    const double phi = 0.26 * i, s = std::sin(phi), c = std::cos(phi);
    const ReducedSample f = bodies->sample(phi);
    EXPECT_NEAR(f.output_position, 0.24 + 0.06 * c, 1e-15);
    EXPECT_NEAR(f.output_velocity_ratio, -0.06 * s, 1e-15);
    EXPECT_NEAR(f.inertia, 0.02 + 4 * 1e-4 + 1.2 * 0.0036 + 85 * 0.0036 * s * s, 1e-14);
    EXPECT_NEAR(f.inertia_slope, 85 * 0.0036 * 2 * s * c, 1e-13);
    EXPECT_NEAR(f.inertia_curvature, 85 * 0.0036 * 2 * std::cos(2 * phi), 1e-13);
  }
}

// It does not turn with what it is pinned to: x_E = r cos φ′ + √(AD² − r² sin² φ′) + 0.15 m, the crank along OA.
TEST(Linkage, ASlidersPointBesideItsPinMovesAsTheSliderDoes) {
  const LinkageData data = test::ram_with_a_point_beside_its_pin().data();
  expect_both_extractions(data, 1e-12);
  const auto bodies = make_bodies(data);
  for (int i = 0; i < 24; ++i) {
    const double phi = 0.26 * i, s = 0.06 * std::sin(phi), c = 0.06 * std::cos(phi);
    const double along = std::sqrt(0.25 * 0.25 + 0.06 * 0.06 - s * s);
    EXPECT_NEAR(bodies->sample(phi).output_position, c + along + 0.15, 1e-14);
    EXPECT_NEAR(bodies->sample(phi).output_velocity_ratio, -s - s * c / along, 1e-14);
  }
}

TEST(Linkage, PeaucelliersPointMovesOnAStraightLine) {
  const LinkageData data = test::peaucellier().data();
  expect_rigid(data);
  expect_both_extractions(data, 1e-12);
  const Linkage& l = *data.linkage;
  ASSERT_TRUE(l.arc());  // at its ends arm and side lie in one line: 2 r cos(φ/2) = a − b
  EXPECT_NEAR(l.arc()->middle, 0, 1e-10);
  EXPECT_NEAR(l.arc()->half, 2 * std::acos(0.13 / 0.2), 1e-10);
  EXPECT_EQ(l.structure().groups.size(), 3u);
  const int p = 5, link = 6;
  for (int i = -9; i <= 9; ++i) {
    const Path at = l.poses(l.arc()->half * i / 10)[link](l.spot_of(p));
    // The output's axis is the line: what lies across it stands still, with all derivatives. Origin in Q.
    EXPECT_NEAR(static_cast<double>(-at.y.value()), (0.28 * 0.28 - 0.15 * 0.15) / 0.2 - 0.1, 1e-15);
    for (int k = 1; k <= Taylor::order; ++k) EXPECT_NEAR(static_cast<double>(at.y.c[k]), 0, 1e-13);
  }
}

// --- the named mechanisms ---

void expect_same(const MechanismData& a, const MechanismData& b, double within) {
  const auto first = a.make_bodies(), other = b.make_bodies();
  double scale[sample_channels] = {};
  for (int i = 0; i < 40; ++i) {
    const std::vector<double> values = values_in(closed_sample(a, 0.16 * i));
    for (std::size_t c = 0; c < sample_channels; ++c) scale[c] = std::max(scale[c], std::abs(values[c]));
  }
  scale[1] = std::max(scale[1], 0.01 * scale[0]), scale[2] = std::max(scale[2], 0.01 * scale[0]);
  for (int i = 0; i < 40; ++i) {
    const double phi = 0.16 * i + 0.05;
    const std::vector<double> wanted = values_in(closed_sample(a, phi));
    for (const std::vector<double>& got : {values_in(other->sample(phi)), values_in(closed_sample(b, phi))})
      for (std::size_t c = 0; c < sample_channels; ++c) {
        const double off = c == 3 && a.rocks() ? std::remainder(got[c] - wanted[c], 2 * pi) : got[c] - wanted[c];
        EXPECT_LE(std::abs(off), within * scale[c]) << "channel " << c << " at " << phi;
      }
    EXPECT_NEAR(other->potential_energy(phi), first->potential_energy(phi), within * (1 + scale[6]));
    EXPECT_NEAR(other->kinetic_energy(phi, 3), first->kinetic_energy(phi, 3), within * 4.5 * scale[0]);
  }
}

FourBarData named_four_bar() {
  FourBarData d;
  d.crank = 0.08, d.coupler = 0.39, d.rocker = 0.17, d.ground = 0.37;
  d.crank_body = {12, -0.017, 0.6}, d.coupler_body = {7, 0.15, 0.08}, d.rocker_body = {22, 0.09, 0.7};
  d.gravity = 9.81, d.ground_angle = 0.4;
  return d;
}
// Drawn at φ = 0.8.
LinkageData as_linkage(const FourBarData& d) {
  const PlanarLinkage there = linkage_of(d, 0.8L);
  const auto x = [](const Path& p) { return double(p.x.value()); };
  const auto y = [](const Path& p) { return double(p.y.value()); };
  SketchOf of;
  of.point('O', 0, 0).point('A', x(there.joints[1].at), y(there.joints[1].at));
  of.point('B', x(there.joints[2].at), y(there.joints[2].at)).point('D', d.ground, 0).frame("OD");
  const char* const points[] = {"OA", "AB", "DB"};
  for (int k = 0; k < 3; ++k) {
    const PlanarLinkage::Body& body = there.bodies[static_cast<std::size_t>(k)];
    of.link(body.name, points[k], body.mass, double(body.inertia)).com(x(body.com), y(body.com));
  }
  of.rocks("rocker");
  of.s.gravity = d.gravity, of.s.elevation = d.ground_angle;
  return of.data();
}

TEST(Linkage, AFourBarIsTheFourBar) {
  const FourBarData d = named_four_bar();
  const LinkageData data = as_linkage(d);
  expect_rigid(data);
  expect_same(d, data, 1e-12);
}

TEST(Linkage, ReactionsOfAFourBarAreTheFourBars) {
  const FourBarData d = named_four_bar();
  const LinkageData data = as_linkage(d);
  for (int i = 0; i < 12; ++i) {
    const LinkageState state = {0.5 * i, 11, -40, 300};
    const LinkageForces wanted = forces_in(linkage_of(d, state.phi), state);
    const LinkageForces got = forces_in(linkage_of(data, state.phi), state);
    double largest = 0;
    for (const JointForces& j : wanted.joints) largest = std::max(largest, j.force.magnitude());
    EXPECT_NEAR(got.torque, wanted.torque, 1e-12 * largest);
    ASSERT_EQ(got.joints.size(), wanted.joints.size());
    for (const JointForces& a : wanted.joints)
      for (const JointForces& b : got.joints) {
        if (std::string(a.from) != b.from || std::string(a.on) != b.on) continue;
        EXPECT_NEAR(b.force.x, a.force.x, 1e-12 * largest) << a.name;
        EXPECT_NEAR(b.force.y, a.force.y, 1e-12 * largest) << a.name;
      }
  }
}

// The torque on the driving link by the links' equilibrium is that of the reduced functions.
void expect_balanced(const LinkageData& data) {
  const MechanismData as_data(data);
  const auto arc = data.linkage->arc();
  for (int i = 0; i < 20; ++i) {
    LinkageState state = {0.31 * i, 9, 70, 200};
    if (arc) state.phi = arc->middle + 0.08 * (i - 10) * arc->half;
    const LinkageForces f = forces_in(as_data.linkage(state.phi), state);
    const ReducedSample s = closed_sample(as_data, state.phi);
    const double terms[] = {s.inertia * state.alpha, 0.5 * s.inertia_slope * state.omega * state.omega,
                            -s.gravity_torque, -s.output_velocity_ratio * state.load};
    double torque = 0, largest = 0;
    for (const double term : terms) torque += term, largest = std::max(largest, std::abs(term));
    EXPECT_NEAR(f.torque, torque, 1e-12 * largest) << i;
    EXPECT_LT(f.residual, 1e-14);
    // The frame carries weights, inertia forces and the load on a point.
    Force2 frame, rest = f.shaking_force;
    for (const JointForces& j : f.joints)
      if (std::string(j.from) == "frame") frame = frame + j.force;
    double mass = 0, force = 1;
    for (const LinkageSketch::Link& link : data.linkage->sketch().links) mass += link.mass;
    const PlanarLinkage l = as_data.linkage(state.phi);
    rest.x -= mass * l.gravity * std::sin(l.elevation), rest.y -= mass * l.gravity * std::cos(l.elevation);
    if (!l.rocks) rest.x += state.load;
    for (const JointForces& j : f.joints) force = std::max(force, j.force.magnitude());
    EXPECT_NEAR(frame.x, -rest.x, 1e-12 * force) << i;
    EXPECT_NEAR(frame.y, -rest.y, 1e-12 * force) << i;
  }
}

TEST(Linkage, ReactionsBalanceEveryLink) {
  for (SketchOf of :
       {scotch_yoke(), test::peaucellier(), test::stephenson(), test::stephenson().drives("lever").rocks("crank")}) {
    of.s.gravity = 9.81, of.s.elevation = 0.3;
    expect_balanced(of.data());
  }
}

TEST(Linkage, ASliderCrankIsTheSliderCrank) {
  SliderCrankData d = full_mechanism(2.5, 0.02);
  SketchOf of;
  const PlanarLinkage there = linkage_of(d, 0.5L);
  const auto x = [](const Path& p) { return double(p.x.value()); };
  const auto y = [](const Path& p) { return double(p.y.value()); };
  of.point('O', 0, 0).point('A', x(there.joints[1].at), y(there.joints[1].at));
  of.point('B', x(there.joints[2].at), y(there.joints[2].at)).frame("O");
  of.link("crank", "OA", d.crank_mass, d.crank_inertia - d.crank_mass * d.crank_com * d.crank_com);
  of.com(x(there.bodies[0].com), y(there.bodies[0].com));
  of.link("rod", "AB", d.rod_mass, d.rod_inertia).com(x(there.bodies[1].com), y(there.bodies[1].com));
  of.link("slider", "B", d.slider_mass).slide("slider", 0).moves("slider", 'B', 0);
  of.s.gravity = d.gravity, of.s.elevation = d.stroke_angle;
  const LinkageData data = of.data();
  expect_rigid(data);
  expect_same(d, data, 1e-12);
}

TEST(Linkage, ASlottedLeverIsTheInvertedSliderCrank) {
  SlottedLeverData d;
  d.crank = 0.1, d.ground = 0.25;
  d.crank_body = {3, 0.02, 0.1}, d.lever_body = {6, 0.2, 0.5};
  d.block_mass = 1.5, d.block_inertia = 0.01, d.gravity = 9.81;
  SketchOf of;
  const double ax = 0.1 * std::cos(1.1), ay = 0.1 * std::sin(1.1), reach = std::hypot(ax - 0.25, ay);
  of.point('O', 0, 0).point('A', ax, ay).point('D', 0.25, 0);
  of.point('E', 0.25 + 0.4 * (ax - 0.25) / reach, 0.4 * ay / reach).frame("OD");
  of.link("crank", "OA", 3, 0.1 - 3 * 0.0004).com(0.2 * ax, 0.2 * ay);
  of.link("block", "A", 1.5, 0.01);
  of.link("lever", "DE", 6, 0.5 - 6 * 0.04).com(0.25 + 0.2 * (ax - 0.25) / reach, 0.2 * ay / reach);
  of.slide("block", std::atan2(ay, ax - 0.25), "lever").rocks("lever");
  of.s.gravity = 9.81;
  const LinkageData data = of.data();
  expect_rigid(data);
  expect_same(d, data, 1e-12);
}

// --- groups of higher class ---

// Driven by its crank the chain is two dyads; driven by its lever, four links in one group.
TEST(Linkage, StephensonsChainDrivenFromItsOtherLoopIsOfClassIII) {
  SketchOf of = test::stephenson();
  const LinkageData by_crank = of.data();
  expect_rigid(by_crank);
  expect_both_extractions(by_crank, 1e-12);
  EXPECT_EQ(by_crank.linkage->structure().groups.size(), 2u);
  const LinkageData by_lever = of.drives("lever").rocks("crank").data();
  expect_rigid(by_lever);
  expect_both_extractions(by_lever, 1e-11);
  ASSERT_EQ(by_lever.linkage->structure().groups.size(), 1u);
  EXPECT_EQ(name_of(by_lever.linkage->structure().groups[0]), "class III of order 3");
  ASSERT_TRUE(by_lever.linkage->arc());
  // The same positions, wherever the lever comes with the crank within the arc.
  int compared = 0;
  const Linkage &a = *by_crank.linkage, &b = *by_lever.linkage;
  for (int i = 0; i < 72; ++i) {
    const LinkPoses there = a.poses(a.drawn_at() + (i - 36) * pi / 180);
    const Path end = there[4](a.spot_of(5)) - there[4](a.spot_of(6));
    const double psi = b.arc()->near(static_cast<double>(std::atan2(end.y.value(), end.x.value())));
    if (std::abs(psi - b.arc()->middle) > 0.9 * b.arc()->half) continue;
    const LinkPoses here = b.poses(psi);
    const SketchSpot shift = a.spot_of(0) - b.spot_of(0);
    const Path crank = here[0](b.spot_of(1)), other = there[0](a.spot_of(1));
    // The other branch of the lever's position is another crank's.
    if (std::abs(static_cast<double>(crank.x.value() + shift.x - other.x.value())) > 0.02) continue;
    ++compared;
    EXPECT_NEAR(static_cast<double>(crank.x.value() + shift.x), static_cast<double>(other.x.value()), 1e-13) << i;
    EXPECT_NEAR(static_cast<double>(crank.y.value() + shift.y), static_cast<double>(other.y.value()), 1e-13) << i;
  }
  EXPECT_GT(compared, 10);
}

// A crank–rocker O A B C far from dead positions, whose coupler carries a plate on three rods: where the crank locks,
// the plate's group does.
TEST(Linkage, OfAGroupBehindADyadThatLocksTheLinksAreNamed) {
  std::mt19937 random(7);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  int locks = 0;
  for (int i = 0; i < 15; ++i) {
    SketchOf of;
    const double phi = uniform(0, 2 * pi);
    of.point('O', 0, 0).point('A', 0.08 * std::cos(phi), 0.08 * std::sin(phi)).point('C', 0.4, 0);
    of.point('B', 0.35, 0.3).point('D', 0.25, 0.45);
    of.point('P', uniform(0.4, 0.6), uniform(-0.3, 0.6)).point('Q', uniform(0.6, 0.9), uniform(0.3, 0.6));
    of.point('R', uniform(0.5, 0.8), uniform(0.1, 0.3)).point('G', uniform(0.2, 1.2), uniform(-0.5, 0.8));
    of.point('H', uniform(0.5, 1), uniform(-0.2, 0.05)).frame("OCGH");
    of.link("crank", "OA", 1, 0.01).link("coupler", "ABD").link("rocker", "CB").link("plate", "PQR");
    of.link("rod_d", "DP").link("rod_g", "GQ").link("rod_h", "HR", 1, 0.01).rocks("rod_h");
    const LinkageData data = of.data();
    if (!data.linkage->faults().empty() || !data.linkage->arc()) continue;
    ++locks;
    EXPECT_EQ(data.linkage->locks_in_words(), "the links plate, rod_d, rod_g, rod_h can be closed no further");
  }
  EXPECT_GT(locks, 3);
}

// Newton's method on a dyad finds what its closed form finds.
TEST(Linkage, NewtonsMethodOnADyadFindsItsClosedForm) {
  const LinkageData data = test::stephenson().data();
  const Linkage& l = *data.linkage;
  for (int i = 0; i < 20; ++i) {
    const long double phi = l.drawn_at() + 0.01L * i;
    const LinkPoses wanted = l.poses(phi);
    LinkPoses poses(5);
    poses.of(0) = wanted[0];
    for (AssurGroup group : l.structure().groups) {
      group.form = AssurGroup::Form::newton;
      std::vector<LinkShift> shifts(2);
      ASSERT_TRUE(close_by_newton(group, l.structure().joints, 0.4L, poses, shifts).closed);
    }
    for (int link = 1; link < 5; ++link)
      for (int k = 0; k <= Taylor::order; ++k) {
        EXPECT_NEAR(double(poses[link].at.x.c[k]), double(wanted[link].at.x.c[k]), 1e-15) << link << k;
        EXPECT_NEAR(double(poses[link].turn.sin.c[k]), double(wanted[link].turn.sin.c[k]), 1e-14) << link << k;
      }
  }
}

SketchOf locomotive(double third) {
  SketchOf of;
  of.point('O', 0, 0).point('A', 0.1, 0.02).point('C', 0.4, 0).point('B', 0.5, 0.02);
  of.point('E', 0.2, 0.1).point('D', 0.3, 0.12 + third).frame("OCE");
  of.link("crank", "OA", 1, 0.01).link("coupler", "ABD", 3, 0.05).link("rocker", "CB", 1, 0.01);
  of.link("third", "ED", 1, 0.01).rocks("rocker");
  return of;
}

// Three parallel cranks: by count it cannot move, in truth the coupler only shifts, through what were change points of two.
TEST(Linkage, AParallelogramWithARedundantRodTurns) {
  const LinkageData data = locomotive(0).data();
  expect_rigid(data);
  const Linkage& l = *data.linkage;
  EXPECT_EQ(l.structure().freedom, 0);
  EXPECT_GT(l.structure().groups.front().superfluous, 0);
  EXPECT_FALSE(l.arc());
  expect_both_extractions(data, 1e-12);
  for (int i = 0; i < 60; ++i) {
    const LinkPoses poses = l.poses(0.11L * i);
    EXPECT_NEAR(double(poses[1].turn.sin.value()), 0, 1e-14);
    EXPECT_NEAR(double(poses[3].turn.rate().value()), 1, 1e-14);
  }
  EXPECT_NE(undetermined_reactions(data).find("not assessed"), std::string::npos);
}

// Parallel cranks at 0, 0.2 and 0.4 m, the middle bearing by h beside the line of the others.
std::string fault_of_three_cranks(double drawn_at, double h) {
  SketchOf of;
  const double x = 0.1 * std::cos(drawn_at), y = 0.1 * std::sin(drawn_at);
  of.point('O', 0, 0).point('A', x, y).point('C', 0.4, 0).point('B', 0.4 + x, y);
  of.point('E', 0.2, h).point('D', 0.2 + x, h + y).frame("OCE");
  of.link("crank", "OA", 1, 0.01).link("coupler", "ABD", 3, 0.05).link("rocker", "CB", 1, 0.01);
  of.link("third", "ED", 1, 0.01).rocks("rocker");
  const LinkageData data = of.data();
  return data.linkage->faults().empty() ? "" : data.linkage->faults()[0].text;
}

TEST(Linkage, AThirdCrankOutOfTheLineOfTheOthersLeavesNoChangePoint) {
  for (const double degrees : {5.0, 30.0, 53.1301, 90.0, 121.7, 179.0, 200.0, 359.5})
    for (const double h : {-0.1, -0.02, 0.02, 0.1})
      EXPECT_EQ(fault_of_three_cranks(degrees * pi / 180, h), "") << degrees << " " << h;
}

// A drag link O A B C turns the crank C D of an antiparallelogram C D E G, whose links fall into one line with the ground.
TEST(Linkage, AChangePointBehindAnotherGroupIsSaid) {
  SketchOf of;
  of.point('O', 0, 0).point('A', 0.16, 0).point('B', 0.19, 0.15).point('C', 0.05, 0).point('D', 0.14, 0.1);
  const double x = 0.11, y = -0.1,
               along = 2 * 0.2 * x / (x * x + y * y);  // D to G; the parallelogram's E mirrored at it
  of.point('E', 0.14 + along * x - 0.2, 0.1 + along * y).point('G', 0.25, 0).frame("OCG");
  of.link("crank", "OA", 1, 0.01).link("coupler", "AB").link("drag", "CBD").link("rod", "DE").link("arm", "GE");
  of.rocks("arm");
  const LinkageData data = of.data();
  ASSERT_EQ(data.linkage->faults().size(), 1u);
  EXPECT_NE(data.linkage->faults()[0].text.find("rod and arm lie in one line"), std::string::npos)
      << data.linkage->faults()[0].text;
}

// a + d = b + c − e: beyond e = 0 the crank turns, below it rocks; what lies within a few millionths of it is refused.
TEST(Linkage, AChangePointIsRefusedWhereMillionthsOfALengthDecide) {
  const auto four_bar = [](double rocker) {
    const double a = 0.06, b = 0.2, d = 0.22, x = a * std::cos(1.0), y = a * std::sin(1.0);
    const double dx = (d - x) / std::hypot(d - x, y), dy = -y / std::hypot(d - x, y), s = std::hypot(d - x, y);
    const double along = (s * s + b * b - rocker * rocker) / (2 * s), beside = std::sqrt(b * b - along * along);
    SketchOf of;
    of.point('O', 0, 0).point('A', x, y).point('D', d, 0).frame("OD");
    of.point('B', x + along * dx - beside * dy, y + along * dy + beside * dx);
    of.link("crank", "OA", 1, 0.01).link("coupler", "AB", 1, 0.01).link("rocker", "DB", 1, 0.01).rocks("rocker");
    return of.data();
  };
  const LinkageData turns = four_bar(0.08 + 4e-8), rocks = four_bar(0.08 - 1e-6);
  ASSERT_TRUE(turns.linkage->faults().empty()) << turns.linkage->faults()[0].text;
  ASSERT_TRUE(rocks.linkage->faults().empty()) << rocks.linkage->faults()[0].text;
  EXPECT_FALSE(turns.linkage->arc());
  EXPECT_TRUE(rocks.linkage->arc());
  for (const double e : {2e-8, 0.0, -1e-7}) {
    const LinkageData undecided = four_bar(0.08 + e);
    ASSERT_EQ(undecided.linkage->faults().size(), 1u) << e;
    EXPECT_NE(undecided.linkage->faults()[0].text.find("a few millionths of a length decide"), std::string::npos);
  }
}

// Of three cranks the least pivot of the closures goes with h; their closed form has nothing of it.
TEST(Linkage, ThreeCranksNearlyInLineKeepTheirDigits) {
  for (const double h : {2e-2, 2e-3, 5e-4}) {
    SketchOf of;
    const double x = 0.1 * std::cos(2.1), y = 0.1 * std::sin(2.1);
    of.point('O', 0, 0).point('A', x, y).point('C', 0.4, 0).point('B', 0.4 + x, y);
    of.point('E', 0.2, h).point('D', 0.2 + x, h + y).frame("OCE");
    of.link("crank", "OA", 1, 0.01).link("coupler", "ABD", 3, 0.05).link("rocker", "CB", 1, 0.01);
    of.link("third", "ED", 1, 0.01).rocks("rocker");
    const LinkageData data = of.data();
    ASSERT_TRUE(data.linkage->faults().empty()) << h << data.linkage->faults()[0].text;
    for (int i = 0; i < 720; ++i) {
      const LinkPoses poses = data.linkage->poses(0.0087266463L * i);
      EXPECT_NEAR(double(poses[2].turn.rate().value()), 1, 1e-17) << h;
    }
  }
  EXPECT_NE(fault_of_three_cranks(2.1, 1e-5).find("a few millionths of a length decide"), std::string::npos);
}

TEST(Linkage, ARedundantRodOfAnotherLengthIsRefused) {
  const LinkageData data = locomotive(0.003).data();
  ASSERT_EQ(data.linkage->faults().size(), 1u);
  EXPECT_NE(data.linkage->faults()[0].text.find("1 closure more than they need"), std::string::npos)
      << data.linkage->faults()[0].text;
}

// Of a four-bar the dyad is nearest to a dead position where the ground and the crank lie in one line: cos μ = (b² + c² −
// (d ± a)²)/2bc between coupler and rocker, and the margin is the least sin² μ.
TEST(Linkage, TheMarginOfADyadIsTheSineOfTheAngleBetweenItsLinks) {
  const double a = 0.06, d = 0.22;
  for (const auto& [b, c] : {std::pair(0.2, 0.16), std::pair(0.16, 0.2), std::pair(0.3, 0.18)}) {
    SketchOf of;
    const double x = (b * b - c * c + (d - a) * (d - a)) / (2 * (d - a));  // of B from A, with A on the line OD
    of.point('O', 0, 0).point('A', a, 0).point('B', a + x, std::sqrt(b * b - x * x)).point('D', d, 0).frame("OD");
    of.link("crank", "OA", 1, 0.01).link("coupler", "AB", 1, 0.01).link("rocker", "DB", 1, 0.01).rocks("rocker");
    const LinkageData data = of.data();
    ASSERT_EQ(data.linkage->least_margins().size(), 1u);
    double least = 1;
    for (const double reach : {d - a, d + a})
      least = std::min(least, 1 - std::pow((b * b + c * c - reach * reach) / (2 * b * c), 2));
    EXPECT_NEAR(double(data.linkage->least_margins()[0].margin), least, 1e-9) << b;
  }
}

// A ram of mass m on a line at 0.5 rad, in a sketch that lies at 0.3 rad: its weight takes −m g sin 0.8 s′, and nothing else
// has mass. Whether the crank is drawn from its bearing or towards it, φ is its direction from there
// in the sketch, of which the line is the axis of positions.
TEST(Linkage, WeightsOnASlantedLineAndACrankThatIsDrawnBackwards) {
  for (const char* crank : {"OA", "AO"}) {
    SketchOf of;
    of.point('O', 0, 0).point('A', 0.1, 0).point('B', 0.1 + 0.3 * std::cos(0.4), 0.3 * std::sin(0.4)).frame("O");
    of.link("crank", crank).link("rod", "AB").link("ram", "B", 7).slide("ram", 0.5).moves("ram", 'B', 0.5);
    of.s.gravity = 9.81, of.s.elevation = 0.3;
    const LinkageData data = of.data();
    ASSERT_TRUE(data.linkage->faults().empty()) << data.linkage->faults()[0].text;
    for (int i = 0; i < 12; ++i) {
      const double phi = 0.1 + 0.5 * i;
      const ReducedSample s = closed_sample(data, phi);
      EXPECT_GT(std::abs(s.output_velocity_ratio), 1e-3);
      EXPECT_NEAR(s.gravity_torque, -7 * 9.81 * std::sin(0.8) * s.output_velocity_ratio, 1e-12) << crank << phi;
      const PlanarLinkage l = linkage_of(data, phi);
      EXPECT_NEAR(std::remainder(double(l.bodies[0].direction.angle()) + 0.5 - phi, 2 * M_PI), 0, 1e-12)
          << crank << phi;
    }
  }
}

// A rod from A on a circle of radius 1 about C goes through S, 0.6 beside C; its point P, 0.9 from A, draws a curve with a
// loop in it, about O. A driver about O that P slides on rotates twice in a cycle: towards C it meets the curve 0.5
// from S, where A stands 0.4 off, and 0.7 from S, where A stands 1.6 off.
TEST(Linkage, ACycleOfTwoTurnsComesBackAfterBoth) {
  const double rod = 0.3 + std::sqrt(0.09 + 0.64), x = -0.5, y = std::sqrt(0.75);  // A from S at 120°
  const double from = 0.25 + (rod - 0.9) * x, up = (rod - 0.9) * y;                // P from O
  SketchOf of;
  of.point('C', 0, 0).point('S', 0.6, 0).point('O', 0.35, 0).point('A', 0.6 + rod * x, rod * y);
  of.point('P', 0.35 + from, up).point('D', 0.35 + 3 * from, 3 * up).frame("CSO");
  of.link("driver", "OD", 1, 0.1).link("block", "P").link("rod", "AP", 1, 0.1).link("guide", "S");
  of.link("arm", "CA", 1, 0.1).slide("block", std::atan2(up, from), "driver").slide("guide", std::atan2(y, x), "rod");
  of.drives("driver").moves("block", 'P', 0);
  const LinkageData data = of.data();
  const Linkage& l = *data.linkage;
  ASSERT_TRUE(l.faults().empty()) << l.faults()[0].text;
  ASSERT_EQ(l.turns(), 2);
  const auto place = [&](double turns) {
    const Path p = l.poses(2 * std::acos(-1.0L) * turns)[1](l.spot_of(4));
    return std::pair(double(p.x.value()), double(p.y.value()));
  };
  const double outer = std::min(place(0.5).first, place(1.5).first),
               inner = std::max(place(0.5).first, place(1.5).first);
  EXPECT_NEAR(outer, -0.45, 1e-12);
  EXPECT_NEAR(inner, -0.25, 1e-12);
  for (const double turns : {0.1, 0.3, 0.5, 0.9}) {
    const auto [first, high] = place(turns);
    const auto [other, low] = place(turns + 1);
    EXPECT_GT(std::hypot(other - first, low - high), 1e-3) << turns;
    const auto [again, level] = place(turns + 2);
    EXPECT_NEAR(again, first, 1e-12) << turns;
    EXPECT_NEAR(level, high, 1e-12) << turns;
  }
  expect_rigid(data);
}

// --- lengths ---

double distance_in(const LinkageSketch& s, int a, int b) {
  const auto &p = s.points[static_cast<std::size_t>(a)], &q = s.points[static_cast<std::size_t>(b)];
  return std::hypot(p.x - q.x, p.y - q.y);
}

// The sketch is drawn to a tenth of a length's unit; the lengths that are given hold, those that are not stay.
TEST(Linkage, GivenLengthsMoveTheSketch) {
  SketchOf of;
  of.point('O', 0, 0).point('A', 15, 0).point('Z', -38, -7.8).point('B', -24, 31.3).point('C', -27, -45.5);
  of.point('D', -74.8, 8.1).point('E', -59.2, -28.1).point('F', -43.2, -91.8).frame("OZ");
  of.link("crank", "OA").link("upper", "AB").link("lower", "AC").link("thigh", "ZBD").link("guide", "ZC");
  of.link("shank", "DE").link("foot", "CEF").moves("foot", 'F', 0);
  const std::vector<LinkageSketch::Length> lengths = {
      {1, 3, 50, "AB"},   {1, 4, 61.9, "AC"}, {2, 3, 41.5, "ZB"}, {2, 4, 39.3, "ZC"}, {2, 5, 40.1, "ZD"},
      {3, 5, 55.8, "BD"}, {5, 6, 39.4, "DE"}, {4, 6, 36.7, "CE"}, {6, 7, 65.7, "EF"}, {4, 7, 49, "CF"}};
  EXPECT_TRUE(take_lengths(of.s, lengths).empty());
  for (const LinkageSketch::Length& l : lengths) EXPECT_NEAR(distance_in(of.s, l.from, l.to), l.value, 1e-13) << l.name;
  EXPECT_NEAR(distance_in(of.s, 0, 1), 15, 1e-14);
  EXPECT_NEAR(of.s.points[0].x, 0, 1e-15);
  EXPECT_NEAR(of.s.points[2].x, -38, 1e-13);
  expect_rigid(of.data());
  EXPECT_EQ(of.data().linkage->structure().groups.size(), 3u);

  const LinkageFaults none = take_lengths(of.s, {{1, 7, 10, "AF"}});
  ASSERT_EQ(none.size(), 1u);
  EXPECT_NE(none[0].text.find("no link has both A and F"), std::string::npos) << none[0].text;
  const LinkageFaults open = take_lengths(of.s, {{1, 3, 500, "AB"}});
  ASSERT_EQ(open.size(), 1u);
  EXPECT_NE(open[0].text.find("cannot be closed"), std::string::npos) << open[0].text;
  // Of the thigh Z B D a length is given, two others stay.
  const LinkageFaults kept = take_lengths(of.s, {{2, 3, 900, "ZB"}});
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_NE(kept[0].text.find(" as drawn"), std::string::npos) << kept[0].text;
  for (const char* side : {"ZD", "BD"}) EXPECT_NE(kept[0].text.find(side), std::string::npos) << kept[0].text;
}

// Of the frame a length moves the points that it ends in, and no other.
TEST(Linkage, ALengthOfTheFrameMovesItsOwnPoints) {
  SketchOf of = test::stephenson();
  EXPECT_TRUE(take_lengths(of.s, {{0, 3, 0.25, "OC"}}).empty());
  EXPECT_NEAR(of.s.points[0].x, 0, 1e-16);
  EXPECT_NEAR(of.s.points[3].x, 0.25, 1e-16);
  EXPECT_NEAR(of.s.points[3].y, 0, 1e-16);
  EXPECT_NEAR(of.s.points[6].x, 0.42, 1e-16);
  EXPECT_NEAR(of.s.points[6].y, 0.08, 1e-16);
  EXPECT_NEAR(distance_in(of.s, 1, 2), std::hypot(0.14, 0.14), 1e-16);
  expect_rigid(of.data());
}

// A longer frame turns the links; their centres of mass, beside their lines, stay where they are on them.
TEST(Linkage, CentresOfMassTurnWithTheirLinks) {
  SketchOf of = test::stephenson();
  struct Place {
    double along, across, turned;
  };
  const auto places = [&] {
    std::vector<Place> all;
    for (const LinkageSketch::Link& link : of.s.links) {
      const auto &p = of.s.points[static_cast<std::size_t>(link.points[0])],
                 &q = of.s.points[static_cast<std::size_t>(link.points[1])];
      const double x = q.x - p.x, y = q.y - p.y, l = std::hypot(x, y), u = link.com_x - p.x, v = link.com_y - p.y;
      all.push_back({(x * u + y * v) / l, (x * v - y * u) / l, std::atan2(y, x)});
    }
    return all;
  };
  for (LinkageSketch::Link& link : of.s.links) link.com_x += 0.01, link.com_y += 0.03;
  const std::vector<Place> before = places();
  EXPECT_TRUE(take_lengths(of.s, {{0, 3, 0.27, "OC"}}).empty());
  const std::vector<Place> after = places();
  double turned = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_NEAR(after[k].along, before[k].along, 1e-12) << k;
    EXPECT_NEAR(after[k].across, before[k].across, 1e-12) << k;
    turned = std::max(turned, std::abs(after[k].turned - before[k].turned));
  }
  EXPECT_GT(turned, 0.02);
}

// A ram keeps its line, a block the offset of its slot.
TEST(Linkage, GivenLengthsKeepSlides) {
  SketchOf of;
  of.point('O', 0, 0).point('A', 103, 38).point('D', 0, -304).point('E', 161, 232).point('R', -18, 236).frame("OD");
  of.link("crank", "OA").link("block", "A").link("lever", "DE").link("link", "ER").link("ram", "R");
  const double through = std::atan2(342, 103);
  of.slide("block", through, "lever").slide("ram", 0).moves("ram", 'R', 0);
  const double offset = 161 * std::sin(through) - 536 * std::cos(through);  // of E from the slot's line through D
  EXPECT_TRUE(take_lengths(of.s, {{0, 1, 110, "OA"}, {3, 4, 180, "ER"}, {2, 3, 560, "DE"}}).empty());
  EXPECT_NEAR(distance_in(of.s, 0, 1), 110, 1e-12);
  EXPECT_NEAR(distance_in(of.s, 3, 4), 180, 1e-12);
  EXPECT_NEAR(of.s.points[4].y, 236, 1e-12);
  EXPECT_EQ(of.s.points[2].y, -304);
  const double angle = of.s.slides[0].angle, x = of.s.points[3].x, y = of.s.points[3].y + 304;
  EXPECT_NEAR(x * std::sin(angle) - y * std::cos(angle), offset * 560 / std::hypot(161, 536), 1e-9);
  const LinkageData data = of.data();
  expect_rigid(data);
  ASSERT_EQ(data.linkage->structure().groups.size(), 2u);
  EXPECT_EQ(name_of(data.linkage->structure().groups[0]), "RPR");
  EXPECT_EQ(name_of(data.linkage->structure().groups[1]), "RRP");
}

// --- what is refused ---

std::string fault_of(const SketchOf& of) {
  const LinkageData data = of.data();
  return data.linkage->faults().empty() ? "" : data.linkage->faults()[0].text;
}

TEST(Linkage, WhatDoesNotMoveAsItShouldIsSaidInWords) {
  SketchOf loose = test::stephenson();
  loose.s.links[4].points.erase(loose.s.links[4].points.begin());  // the lever has no bearing
  loose.moves("rod", 'E', 0);
  EXPECT_NE(fault_of(loose).find("3·5 − 2·6 = 3"), std::string::npos) << fault_of(loose);
  EXPECT_NE(fault_of(loose).find("rod, lever"), std::string::npos) << fault_of(loose);

  SketchOf alone = test::stephenson();
  alone.point('X', 1, 1).point('Y', 1, 2).link("alone", "XY");
  EXPECT_NE(fault_of(alone).find("alone is connected with nothing"), std::string::npos) << fault_of(alone);

  SketchOf dead;
  dead.point('O', 0, 0).point('A', 0.1, 0).point('B', 0.3, 0).point('C', 0.5, 0).frame("OC");
  dead.link("crank", "OA", 1, 1).link("coupler", "AB").link("rocker", "CB").rocks("rocker");
  EXPECT_NE(fault_of(dead).find("coupler and rocker lie in one line"), std::string::npos) << fault_of(dead);
}

// A rod between two points whose distance changes locks the linkage: whichever two, the closure too many is said, and what
// needs it; no group is made of a link that is held too often and one that is held too rarely.
TEST(Linkage, ARodTooManyIsSaidWhereverItIs) {
  for (const SketchOf& linkage : {test::stephenson(), test::peaucellier()}) {
    ASSERT_EQ(fault_of(linkage), "");
    const int points = static_cast<int>(linkage.s.points.size());
    int tried = 0;
    for (int a = 0; a < points; ++a)
      for (int b = 0; b < a; ++b) {
        bool together = linkage.s.has(LinkageSketch::frame, a) && linkage.s.has(LinkageSketch::frame, b);
        for (int k = 0; k < static_cast<int>(linkage.s.links.size()); ++k)
          together = together || (linkage.s.has(k, a) && linkage.s.has(k, b));
        if (together) continue;
        SketchOf locked = linkage;
        locked.s.links.insert(locked.s.links.end() - 1, {.name = "extra", .points = {a, b}});
        ++locked.s.output.link;
        const std::string fault = fault_of(locked);
        EXPECT_NE(fault.find("1 closure more than they need"), std::string::npos) << a << " " << b << ": " << fault;
        EXPECT_NE(fault.find("extra"), std::string::npos) << a << " " << b << ": " << fault;
        ++tried;
        SketchOf loose = locked;  // the count is right again, the linkage is not
        loose.point('Z', 2, 1).s.links.push_back({.name = "tail", .points = {a, points}});
        EXPECT_NE(fault_of(loose).find("does not determine: tail"), std::string::npos) << fault_of(loose);
        EXPECT_EQ(fault_of(loose).find("= 1; must be 1"), std::string::npos) << fault_of(loose);
      }
    EXPECT_GT(tried, 5);
  }
}

TEST(Linkage, ACrankThatLocksRocksWithinItsArc) {
  SketchOf of;
  of.point('O', 0, 0).point('A', 0, 0.3).point('B', 0.3, 0.35).point('C', 0.4, 0).frame("OC");
  of.link("crank", "OA", 1, 1).link("coupler", "AB", 1, 0.01).link("rocker", "CB", 1, 0.02).rocks("rocker");
  const LinkageData data = of.data();
  expect_rigid(data);
  const FourBarLoop loop = {0.3L, std::hypot(0.3L, 0.05L), std::hypot(0.1L, 0.35L), 0.4L};
  ASSERT_TRUE(data.linkage->arc() && loop.arc());
  EXPECT_NEAR(data.linkage->arc()->half, loop.arc()->half, 1e-9);
  EXPECT_NEAR(data.linkage->arc()->near(loop.arc()->middle), data.linkage->arc()->middle, 1e-9);
  EXPECT_EQ(data.linkage->locks_in_words(), "coupler and rocker lie in one line");
}

}  // namespace
}  // namespace kurbel::linkage_test
