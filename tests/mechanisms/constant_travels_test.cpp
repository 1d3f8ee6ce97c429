// constant_travels_test.cpp — what acts within a linkage along a travel that is constant but for rounding: it does no work and
// costs no steps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "mechanisms/link_forces/link_forces.h"
#include "studies/forces/forces.h"
#include "tests/mechanisms/linkage_examples.h"
#include "tests/support/scenes.h"

namespace kurbel::constant_travels_test {
namespace {

using std::numbers::pi;
using test::SketchOf;
using Of = LinkageTravel::Of;

struct Constant {
  const char* name;
  LinkageData of;
  LinkageTravel travel;
};

// A slider-crank whose slide stands at `angle`: points O A B are 0 1 2, links crank, rod, ram are 0 1 2.
SketchOf ram_at(double angle) {
  SketchOf of;
  const auto place = [&](char name, double along, double across) {
    of.point(name, along * std::cos(angle) - across * std::sin(angle),
             along * std::sin(angle) + across * std::cos(angle));
  };
  place('O', 0, 0), place('A', 0.06, 0.01), place('B', 0.25, 0.01);
  of.frame("O").link("crank", "OA", 1).link("rod", "AB", 1).link("ram", "B", 2);
  return of.slide("ram", angle).moves("ram", 'B', angle);
}

// O A B C with a third rod: D on the coupler, E on the rocker, so that D E keeps its length.
SketchOf parallelogram(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  SketchOf of;
  const auto place = [&](char name, double x, double y) { of.point(name, c * x - s * y, s * x + c * y); };
  place('O', 0, 0), place('A', 0.03, 0.095), place('B', 0.33, 0.095), place('C', 0.3, 0), place('D', 0.13, 0.195);
  place('F', 0.1, 0.1);
  return of.frame("OCF").link("crank", "OA", 1).link("coupler", "ABD", 1).link("rocker", "CB", 1).rocks("rocker");
}

// Travels that never change, at slides and links of any direction.
std::vector<Constant> constant_travels(double angle) {
  const int frame = LinkageSketch::frame;
  const LinkageData ram = ram_at(angle).data(), parallel = parallelogram(angle).data();
  return {{"across the slide", ram, {Of::way, {}, {2, 2}, angle + pi / 2}},
          {"against it", ram, {Of::way, {}, {1, 2}, angle - pi / 2}},
          {"of a ram that does not turn", ram, {Of::rotation, {frame, -1}, {2, -1}, 0}},
          {"between F and D", parallel, {Of::distance, {frame, 5}, {1, 4}, 0}},
          {"of a coupler that does not turn", parallel, {Of::rotation, {frame, -1}, {1, -1}, 0}},
          {"of cranks that turn alike", parallel, {Of::rotation, {0, -1}, {2, -1}, 0}},
          {"across Peaucellier's line", test::peaucellier().data(), {Of::way, {}, {6, 5}, 0}}};
}

// In every extraction, and in every table: no velocity is left, and the position is the one that is drawn.
TEST(ConstantTravels, AreConstantWhoeverReadsThem) {
  for (const double angle : {0.0, -pi / 4, 0.3, 1.0, pi / 2, 2.2, -3.0})
    for (const Constant& constant : constant_travels(angle)) {
      SCOPED_TRACE(fmt::format("{} at {}", constant.name, angle));
      ASSERT_EQ(fault_of(*constant.of.linkage, constant.travel), "");
      const MechanismData data(LinkageTravelData{constant.of.linkage, constant.travel});
      const LinkPoses drawn = constant.of.linkage->poses(constant.of.linkage->drawn_at());
      const double place = double(travel_series(*constant.of.linkage, drawn, constant.travel).value());
      const auto bodies = data.make_bodies();
      const auto& arc = data.arc();
      for (const double part : {-0.9, -0.4, 0.01, 0.3, 0.8}) {
        const double phi = arc ? arc->middle + part * arc->half : pi * part;
        for (const ReducedSample& s : {closed_sample(data, phi), bodies->sample(phi)}) {
          EXPECT_NEAR(s.output_position, place, 1e-12);
          EXPECT_EQ(s.output_velocity_ratio, 0);
          EXPECT_EQ(s.output_acceleration_ratio, 0);
        }
      }
      for (const Extraction from : {Extraction::first, Extraction::second}) {
        const Mechanism mechanism("m", data, from);
        EXPECT_TRUE(mechanism.stands_still());
        EXPECT_EQ(mechanism.reduced->output_velocity(2).value, 0);
        EXPECT_TRUE(mechanism.reduced->report().converged);
      }
    }
}

// A nanometre a metre is a motion.
TEST(ConstantTravels, AreNotThoseThatMoveALittle) {
  std::mt19937 random(3);
  for (int k = 0; k < 20; ++k) {
    const double angle = std::uniform_real_distribution<double>(-pi, pi)(random), off = std::pow(10, -1 - k % 9);
    const LinkageData linkage = ram_at(angle).data();
    const MechanismData data(LinkageTravelData{linkage.linkage, {Of::way, {}, {2, 2}, angle + pi / 2 + off}});
    const Mechanism mechanism("m", data), whole("m", linkage);
    EXPECT_FALSE(mechanism.stands_still()) << angle;
    EXPECT_NEAR(mechanism.stroke(), whole.stroke() * std::sin(off), 1e-6 * off) << angle;
  }
}

// --- in scenes ---

std::string ram(const std::string& within,
                const std::string& drive = "kind = \"prescribed speed\"\nspeed = \"120 rpm\"",
                const std::string& further = "") {
  return "line = [\"drive\", \"m\"]\n[drive]\n" + drive + R"(
[m]
kind = "linkage"
points = { O = [0, 0], A = [60, 10], B = [250, 10] }
unit = "mm"
frame = "O"
slides = { ram = "0 deg" }
)" + further +
         "\n[m.links]\ncrank = { points = \"O A\", mass = \"1 kg\" }\nrod = \"A B\"\nram = { points = \"B\", mass = "
         "\"2 "
         "kg\" }\n" +
         within + "\n[run]\nuntil = \"3 s\"\n";
}

// Whatever acts along them, the run is the one without it.
TEST(ConstantTravels, RunAsIfNothingActed) {
  const Result bare = test::run(ram(""));
  ASSERT_TRUE(bare.complete) << bare.diagnosis;
  for (const char* within :
       {"[m.forces]\nf = { on = \"B\", along = \"90 deg\", load = { kind = \"constant\", force = \"10 N\" } }",
        "[m.forces]\nf = { on = \"B\", along = \"90 deg\", load = { kind = \"opposing\", force = \"10 N\" } }",
        "[m.forces]\nf = { on = \"B\", along = \"90 deg\", load = { kind = \"medium\", viscous = \"10 N*s/m\" } }",
        "[m.couples]\nf = { between = \"frame ram\", torque = { kind = \"constant\", torque = \"10 N*m\" } }",
        "[m.couples]\nf = { between = \"frame ram\", stiffness = \"9 N*m/rad\", damping = \"5 N*m*s/rad\" }"}) {
    const Result r = test::run(ram(within));
    ASSERT_TRUE(r.complete) << r.diagnosis << within;
    EXPECT_LE(r.statistics.stepper.steps, bare.statistics.stepper.steps + 10) << within;
    EXPECT_NEAR(test::figure(r, "motor_rms_torque.drive"), test::figure(bare, "motor_rms_torque.drive"), 1e-8)
        << within;
    for (const auto& [account, work] : r.energy.by_account)
      if (account != "drive") {
        EXPECT_EQ(work, 0) << account << within;
      }
  }
}

// The guide carries the force across it.
TEST(ConstantTravels, KeepTheirReactions) {
  const auto guide = [](const std::string& within) {
    ForcesOptions options;
    options.simulate = false;
    const Forces f = find_forces(test::scene_from(ram(within)), options);
    for (const JointForces& joint : f.front().positions.front().forces.joints)
      if (joint.name == std::string("slide ram")) return joint.force.y;
    return std::nan("");
  };
  const double with =
      guide("[m.forces]\nf = { on = \"B\", along = \"90 deg\", load = { kind = \"constant\", force = \"10 N\" } }");
  EXPECT_NEAR(with - guide(""), -10, 1e-9);
}

// A load however small beside the inertia, and inertia however small beside the weights: the squared torque of what drives is
// judged by the greatest of them, so that the steps are those of the motion.
TEST(ConstantTravels, SmallTorquesKeepNoStepsShort) {
  const Result bare = test::run(ram(""), false);
  for (int k = 0; k <= 18; k += 3) {
    const Result r = test::run(ram(fmt::format("[m.forces]\nf = {{ on = \"B\", along = \"0 deg\", load = {{ kind = "
                                               "\"constant\", force = \"1e-{} N\" }} }}",
                                               k)),
                               false);
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_LE(r.statistics.stepper.steps, 2 * bare.statistics.stepper.steps) << k;
  }
  std::int64_t steps = 0;
  for (const char* speed : {"100 rpm", "1 rpm", "0.01 rpm", "0.0001 rpm"}) {
    const Scene scene = test::scene_from(
        ram("", fmt::format("kind = \"prescribed speed\"\nspeed = \"{}\"", speed), "gravity = \"9.81 m/s2\""));
    Scene turned = scene;
    turned.run.until = 3 * 60 / std::stod(speed);
    const Result r = test::run(turned, false);
    ASSERT_TRUE(r.complete) << r.diagnosis;
    if (steps == 0) steps = r.statistics.stepper.steps;
    EXPECT_LE(r.statistics.stepper.steps, 2 * steps) << speed;
  }
}

}  // namespace
}  // namespace kurbel::constant_travels_test
