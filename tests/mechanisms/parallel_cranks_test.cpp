// parallel_cranks_test.cpp — rods on parallel cranks through their change points: closed form, both extractions, the machine.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "mechanisms/reduced/mechanism.h"
#include "mechanisms/reduced/newton_euler.h"
#include "studies/forces/forces.h"
#include "tests/mechanisms/linkage_checks.h"
#include "tests/mechanisms/linkage_examples.h"
#include "tests/published/published.h"

namespace kurbel::parallel_cranks_test {
namespace {

using std::numbers::pi;
using test::expect_both_extractions;
using test::expect_valid;
using test::SketchOf;

constexpr double r = 0.1, crank_mass = 7, crank_inertia = 0.3, rod_mass = 5;

// Cranks on bearings along a line at this slope, 0.3 m apart, drawn at φ; one rod over all of them, or one from each to the next.
// The last crank is the output.
SketchOf wheels(int count, double slope, double phi, bool one_rod) {
  SketchOf of;
  std::string bearings, pins;
  for (int k = 0; k < count; ++k) {
    const double x = 0.3 * k * std::cos(slope), y = 0.3 * k * std::sin(slope);
    bearings += static_cast<char>('A' + k), pins += static_cast<char>('a' + k);
    of.point(bearings.back(), x, y).point(pins.back(), x + r * std::cos(phi), y + r * std::sin(phi));
  }
  of.frame(bearings);
  for (std::size_t k = 0; k < pins.size(); ++k) {
    if (!one_rod && k > 0) of.link("rod" + pins.substr(k, 1), pins.substr(k - 1, 2), rod_mass, 0.2);
    if (one_rod && k == 1) of.link("rod", pins, rod_mass, 0.2);
    of.link("crank" + pins.substr(k, 1), bearings.substr(k, 1) + pins.substr(k, 1), crank_mass, crank_inertia);
  }
  return of.rocks("crank" + pins.substr(pins.size() - 1));
}
// Cranks with their centres of mass at r/2 turn alike, rods move on circles of radius r.
double closed_inertia(int cranks, int rods) {
  return cranks * (crank_inertia + crank_mass * r * r / 4) + rods * rod_mass * r * r;
}

void expect_parallel(const LinkageData& data, double inertia) {
  expect_valid(data);
  if (!data.linkage->faults().empty()) return;
  EXPECT_FALSE(data.linkage->arc());
  EXPECT_EQ(data.linkage->turns(), 1);
  const auto bodies = make_bodies(data);
  for (int i = 0; i < 64; ++i) {  // the change points, and places beside them
    const double phi = 2 * pi * (i / 2) / 32 + (i % 2) * std::pow(10, -1 - i % 13);
    for (const ReducedSample& s : {closed_sample(data, phi), bodies->sample(phi)}) {
      EXPECT_NEAR(s.inertia, inertia, 1e-12 * inertia) << phi;
      EXPECT_NEAR(s.inertia_slope, 0, 1e-12 * inertia) << phi;
      EXPECT_NEAR(s.inertia_curvature, 0, 1e-12 * inertia) << phi;
      EXPECT_NEAR(std::remainder(s.output_position - phi, 2 * pi), 0, 1e-12) << phi;
      EXPECT_NEAR(s.output_velocity_ratio, 1, 1e-12) << phi;
      EXPECT_NEAR(s.output_acceleration_ratio, 0, 1e-12) << phi;
    }
  }
  const Mechanism m("wheels", data);
  EXPECT_EQ(m.reduced->cycle().winding(), 1);
  EXPECT_NEAR(m.reduced->inertia(1.1).value, inertia, 1e-12 * inertia);
}

TEST(ParallelCranks, TurnAlikeThroughTheirChangePointsHoweverManyARodHolds) {
  for (int count = 2; count <= 5; ++count)
    for (const double slope : {0.0, -2.0})
      for (const double degrees : {5.0, 53.1301, 179.0}) {
        SCOPED_TRACE(fmt::format("{} cranks, slope {}, drawn at {}°", count, slope, degrees));
        const LinkageData data = wheels(count, slope, slope + degrees * pi / 180, true).data();
        expect_parallel(data, closed_inertia(count, 1));
        ASSERT_TRUE(data.linkage->faults().empty());
        EXPECT_EQ(data.linkage->structure().freedom, 3 - count);
        EXPECT_EQ(undetermined_reactions(data).empty(), count == 2);
        const CrankCycle cycle(data);
        ASSERT_EQ(cycle.change_points().size(), 2u);
        for (const double phi : cycle.change_points()) EXPECT_NEAR(std::sin(phi - slope), 0, 1e-12);
      }
}

TEST(ParallelCranks, RodsOneBehindAnotherChangeTogether) {
  for (int count = 3; count <= 5; ++count) {
    SCOPED_TRACE(count);
    const LinkageData data = wheels(count, 0.3, 1.4, false).data();
    expect_parallel(data, closed_inertia(count, count - 1));
    ASSERT_TRUE(data.linkage->faults().empty());
    EXPECT_EQ(data.linkage->structure().freedom, 1);
    EXPECT_EQ(CrankCycle(data).change_points().size(), 2u);
    EXPECT_EQ(undetermined_reactions(data), "");
  }
}

// The sketch in which all links lie in one line shows no branch: parallel cranks stay parallel.
TEST(ParallelCranks, DrawnInAChangePointTheyStayParallel) {
  for (int count = 2; count <= 4; ++count)
    for (const bool one_rod : {true, false})
      for (const double turned : {0.0, pi}) {
        SCOPED_TRACE(fmt::format("{} cranks, one rod {}, drawn at {}", count, one_rod, turned));
        const LinkageData data = wheels(count, 0.4, 0.4 + turned, one_rod).data();
        expect_parallel(data, closed_inertia(count, one_rod ? 1 : count - 1));
        ASSERT_TRUE(data.linkage->faults().empty());
        EXPECT_EQ(CrankCycle(data).change_points().size(), 2u);
      }
}

SketchOf rounded_to(SketchOf of, double unit) {
  for (LinkageSketch::Point& p : of.s.points) p.x = std::round(p.x / unit) * unit, p.y = std::round(p.y / unit) * unit;
  of.s.rounded = unit / 2;
  return of;
}

// Coordinates of a drawing to a thousandth of a millimetre: no crank is quite as long as the next, no bearing in line.
TEST(ParallelCranks, ThatDifferByTheirRoundingAreTakenAsParallel) {
  int moved = 0;  // by chance some agree as rounded
  for (int count = 2; count <= 5; ++count)
    for (const bool one_rod : {true, false})
      for (const double turned : {0.0, 0.37, 2.0, pi}) {
        SCOPED_TRACE(fmt::format("{} cranks, one rod {}, drawn at {}", count, one_rod, turned));
        SketchOf of = rounded_to(wheels(count, 0.4, 0.4 + turned, one_rod), 1e-6);
        const LinkageData data = of.data();
        expect_valid(data);
        if (!data.linkage->faults().empty()) continue;
        moved += data.linkage->moved_in_words().find("are taken as parallel") != std::string::npos;
        for (std::size_t p = 0; p < of.s.points.size(); ++p) {
          const LinkageSketch::Point &given = of.s.points[p], &taken = data.linkage->sketch().points[p];
          EXPECT_LE(std::hypot(taken.x - given.x, taken.y - given.y), 3e-6);
          if (of.s.has(LinkageSketch::frame, static_cast<int>(p))) {
            EXPECT_EQ(taken.x, given.x);
          }
        }
        test::expect_rigid(data);
        expect_both_extractions(data, 1e-12);
        EXPECT_EQ(CrankCycle(data).change_points().size(), 2u);
      }
  EXPECT_GT(moved, 20);
}

// A difference that is more than rounding stays: of a rocker 0.2 mm longer, in a sketch to a hundredth of a millimetre.
TEST(ParallelCranks, ThatDifferByMoreAreNotTakenAsParallel) {
  SketchOf of = wheels(2, 0, 1, true);
  of.s.points[3].y += 2e-4;
  of = rounded_to(of, 1e-5);
  EXPECT_EQ(of.data().linkage->moved_in_words(), "");
}

// A second rod on cranks 90° ahead: no change point is left.
TEST(ParallelCranks, ASecondRodAtARightAngleLeavesNoChangePoint) {
  SketchOf of;
  const double x = r * std::cos(0.4), y = r * std::sin(0.4);
  of.point('O', 0, 0)
      .point('A', x, y)
      .point('P', -y, x)
      .point('C', 0.4, 0)
      .point('B', 0.4 + x, y)
      .point('Q', 0.4 - y, x);
  of.frame("OC")
      .link("front", "OAP", 1, 0.01)
      .link("right", "AB", 2)
      .link("left", "PQ", 2)
      .link("rear", "CBQ", 1, 0.01);
  const LinkageData data = of.rocks("rear").data();
  expect_both_extractions(data, 1e-12);
  EXPECT_TRUE(CrankCycle(data).change_points().empty());
}

// A drag link turns the crank C D of a parallelogram C D E G with the frame: its arm goes as the drag link goes.
TEST(ParallelCranks, BehindAnotherGroupTheyFollowTheirOwnLeader) {
  SketchOf of;
  of.point('O', 0, 0).point('A', 0.16, 0).point('B', 0.19, 0.15).point('C', 0.05, 0).point('D', 0.14, 0.1);
  of.point('E', 0.34, 0.1).point('G', 0.25, 0).frame("OCG");
  of.link("crank", "OA", 1, 0.01).link("coupler", "AB", 1, 0.01).link("drag", "CBD", 2, 0.02).link("rod", "DE", 3, 0.1);
  of.link("arm", "GE", 1, 0.03).rocks("arm");
  const LinkageData data = of.data();
  expect_both_extractions(data, 1e-12);
  EXPECT_EQ(CrankCycle(data).change_points().size(), 2u);
  for (int i = 0; i < 40; ++i) {
    const LinkPoses poses = data.linkage->poses(0.16L * i);
    for (int k = 0; k <= Taylor::order; ++k) {
      EXPECT_EQ(poses[4].turn.sin.c[k], poses[2].turn.sin.c[k]);
      EXPECT_EQ(poses[3].turn.sin.c[k], 0);
    }
  }
}

// The named four-bar is followed through its change points by other equations.
TEST(ParallelCranks, HaveTheReactionsOfTheNamedFourBar) {
  FourBarData named;
  named.crank = r, named.coupler = 0.3, named.rocker = r, named.ground = 0.3, named.gravity = 9.81;
  named.crank_body =
      named.rocker_body = {crank_mass, r / 2, crank_inertia + crank_mass * r * r / 4};  // about the bearing
  named.coupler_body = {rod_mass, 0.15, 0.2};
  SketchOf of = wheels(2, 0, 1, true);
  of.s.gravity = 9.81;
  const LinkageData drawn = of.data();
  expect_valid(drawn);
  for (int i = 0; i < 50; ++i) {
    const double phi = 0.126 * i + 0.03;
    const LinkageState state{phi, 5, 2, -40};
    const LinkageForces a = forces_in(linkage_of(named, phi), state), b = forces_in(linkage_of(drawn, phi), state);
    EXPECT_NEAR(b.torque, a.torque, 1e-12 * std::abs(a.torque));
    ASSERT_EQ(a.joints.size(), b.joints.size());
    for (std::size_t k = 0; k < a.joints.size(); ++k) {
      double nearest = HUGE_VAL;  // their joints stand in another order
      for (const JointForces& j : b.joints) {
        const Force2 same = j.force - a.joints[k].force, opposite = j.force + a.joints[k].force;
        if ((j.at - a.joints[k].at).magnitude() < 1e-9)
          nearest = std::min({nearest, same.magnitude(), opposite.magnitude()});
      }
      EXPECT_LT(nearest, 1e-11 * a.joints[k].force.magnitude()) << phi << " " << a.joints[k].name;
    }
  }
}

std::string fault_of(const SketchOf& of) {
  const LinkageData data = of.data();
  return data.linkage->faults().empty() ? "" : data.linkage->faults()[0].text;
}

// The antiparallelogram has other ways through its change points; a third bearing a little out of the line, or parallelograms
// of two directions, are none of this.
TEST(ParallelCranks, WhatIsNotExactlyParallelIsRefused) {
  SketchOf crossed;
  crossed.point('O', 0, 0).point('A', 0, 0.1).point('B', 0.24, -0.08).point('C', 0.3, 0).frame("OC");
  crossed.link("crank", "OA", 1, 1).link("coupler", "AB").link("rocker", "CB").rocks("rocker");
  EXPECT_NE(fault_of(crossed).find("coupler and rocker lie in one line"), std::string::npos) << fault_of(crossed);
  for (const double off : {1e-12, 1e-7}) {
    SketchOf bent = wheels(3, 0, 1, true);
    for (const std::size_t p : {2u, 3u}) bent.s.points[p].y += off;
    EXPECT_NE(fault_of(bent).find("in one line, or one of them clearly out of it"), std::string::npos)
        << fault_of(bent);
  }
  SketchOf two = wheels(2, 0, 1, true);
  two.point('C', 0.3 + 0.2, 0.2).point('c', 0.5 + r * std::cos(1), 0.2 + r * std::sin(1));
  two.s.frame_points.push_back(4);
  two.link("rod2", "bc").link("crank3", "Cc").rocks("crank3");
  EXPECT_NE(fault_of(two).find("rod2 and crank3 lie in one line"), std::string::npos) << fault_of(two);
}

// --- the machine ---

std::string scene_of(bool third) {
  return fmt::format(
      "line = [\"motor\", \"rods\"]\nmotor = {{ kind = \"dc shunt motor\", stall_torque = \"400 N*m\", no_load_speed = "
      "\"12 rad/s\", inertia = \"2 kg*m2\" }}\n[rods]\nkind = \"linkage\"\nunit = \"mm\"\npoints = {{ O = [0, 0], A = "
      "[86.6025, 50], B = [486.6025, 50], C = [400, 0]{0} }}\nframe = \"O C{1}\"\noutput = \"rear\"\ntorque = {{ kind "
      "= "
      "\"medium\", viscous = \"8 N*m*s/rad\" }}\n[rods.links]\nfront = {{ points = \"O A\", mass = \"20 kg\", inertia "
      "= "
      "\"1.2 kg*m2\" }}\nrod = {{ points = \"A B{2}\", mass = \"8 kg\", inertia = \"0.3 kg*m2\" }}\nrear = {{ points = "
      "\"C B\", mass = \"20 kg\", inertia = \"1.1 kg*m2\" }}\n{3}[run]\nstart = {{ speed = \"9 rad/s\" }}\nuntil = \"4 "
      "s\"\n",
      third ? ", E = [200, 0], D = [286.6025, 50]" : "", third ? " E" : "", third ? " D" : "",
      third ? "third = { points = \"E D\", mass = \"20 kg\", inertia = \"1 kg*m2\" }\n" : "");
}

// I dω/dt = 400 (1 − ω/12) − 8 ω, the same with and without the third crank but for its inertia.
TEST(ParallelCranks, RunTheirMachineAsAWheelOfTheirInertia) {
  for (const bool third : {false, true}) {
    SCOPED_TRACE(third);
    const double a = std::hypot(0.0866025, 0.05), wheel = 20 * a * a / 4;
    const double inertia = 2 + 1.2 + 1.1 + 2 * wheel + 8 * a * a + (third ? 1 + wheel : 0), rate = 400.0 / 12 + 8;
    const Result run = test::run(test::scene_from(scene_of(third)));
    ASSERT_TRUE(run.complete);
    const std::vector<double> speed = test::series(run, "speed.rods");
    const auto& t = run.trajectory->time();
    ASSERT_GT(t.size(), 10u);
    for (std::size_t i = 0; i < t.size(); ++i)
      EXPECT_NEAR(speed[i], 400 / rate + (9 - 400 / rate) * std::exp(-rate / inertia * t[i]), 1e-6) << t[i];
    EXPECT_TRUE(std::any_of(run.notes.begin(), run.notes.end(), [](const std::string& note) {
      return note.find("rods: at the change points φ = 0°, 180° its links can go on in two ways") == 0;
    }));
  }
}

// 100 mm at 60° beside bearings 400 mm apart at 30°, to the digits of a drawing.
TEST(ParallelCranks, OfRoundedCoordinatesRunAndSayWhatWasMoved) {
  std::string text = scene_of(true);
  const auto put = [&](const std::string& what, const std::string& by) {
    ASSERT_NE(text.find(what), std::string::npos) << what;
    text.replace(text.find(what), what.size(), by);
  };
  put("A = [86.6025, 50], B = [486.6025, 50], C = [400, 0]",
      "A = [50, 86.603], B = [396.41, 286.603], C = [346.41, 200]");
  put("E = [200, 0], D = [286.6025, 50]", "E = [173.205, 100], D = [223.206, 186.602]");
  const Result run = test::run(test::scene_from(text));
  EXPECT_TRUE(run.complete);
  EXPECT_TRUE(std::any_of(run.notes.begin(), run.notes.end(), [](const std::string& note) {
    return note.find("rods: the links rod, rear, third are taken as parallel") == 0;
  }));
}

}  // namespace
}  // namespace kurbel::parallel_cranks_test
