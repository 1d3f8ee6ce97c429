// rocking_range_test.cpp — reduction and forces over the arc of a crank that rocks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "engine/numerics/angles.h"
#include "studies/forces/forces.h"
#include "studies/reduce/reduce.h"
#include "tests/support/files.h"
#include "tests/support/program.h"
#include "tests/support/scenes.h"

namespace kurbel::rocking_range_test {
namespace {

// Peaucellier's inversor driven by its arm QC. P stays on x = (a² − b²)/(2 r), at y = x tan(φ/2).
const char* const inversor = R"(
line = ["motor", "saw"]
motor = { kind = "torque source", torque = "1 N*m" }
[saw]
kind    = "linkage"
unit    = "mm"
points  = { Q = [100, 0], O = [0, 0], C = [198.1, -19.5], A = [252.9, 120.1], B = [224.7, -167.1], P = [279.5, -27.5] }
frame   = "O Q"
lengths = { OQ = "100 mm", QC = "100 mm", OA = "280 mm", OB = "280 mm", AC = "150 mm", BC = "150 mm", AP = "150 mm", BP = "150 mm" }
output  = "P"
output_along = "90 deg"
load    = { kind = "constant", force = "-60 N" }
[saw.links]
arm     = { points = "Q C", mass = "1.1 kg", inertia = "0.004 kg*m2" }
arm_a   = { points = "O A", mass = "1 kg", inertia = "0.007 kg*m2" }
arm_b   = { points = "O B", mass = "1 kg", inertia = "0.007 kg*m2" }
side_ac = { points = "A C", mass = "0.5 kg", inertia = "0.001 kg*m2" }
side_bc = { points = "B C", mass = "0.5 kg", inertia = "0.001 kg*m2" }
side_ap = { points = "A P", mass = "0.5 kg", inertia = "0.001 kg*m2" }
side_bp = { points = "B P", mass = "0.9 kg", inertia = "0.001 kg*m2" }
)";

// A double rocker whose left link stands between 27.65° and 98.2°.
std::string double_rocker(const std::string& friction = "") {
  return fmt::format(R"(
line = ["motor", "arm"]
motor = {{ kind = "torque source", torque = "1 N*m", inertia = "0.01 kg*m2" }}
[arm]
kind = "linkage"
unit = "mm"
points = {{ A = [0, 0], B = [60, 180], C = [160, 190], D = [200, 0] }}
frame = "A D"
links = {{ left = {{ points = "A B", mass = "1 kg" }}, top = {{ points = "B C", mass = "1 kg" }}, right = {{ points = "C D", mass = "1 kg" }} }}
output = "right"
gravity = "9.81 m/s2"
{}
[run]
until = "1 s"
)",
                     friction);
}
const char* const bushes =
    "joints = { A = { radius = '8 mm', friction = 0.1 }, B = { radius = '8 mm', friction = 0.1 }, "
    "C = { radius = '8 mm', friction = 0.1 }, D = { radius = '8 mm', friction = 0.1 } }";

TEST(RockingRange, PeaucelliersLineGivesTheTorqueOfItsLoad) {
  const double x = (0.28 * 0.28 - 0.15 * 0.15) / (2 * 0.1), half = 46 * degree;
  ReduceOptions options;
  options.speed = 2;
  options.range = AngleRange{-half, half};
  options.to = "saw.slider";
  const MachineReduction to_point = reduce(test::scene_from(inversor), options);
  options.to.clear();
  const MachineReduction r = reduce(test::scene_from(inversor), options);
  EXPECT_TRUE(r.over_a_range);
  EXPECT_TRUE(r.spectra.empty());
  ASSERT_EQ(r.positions.size(), 13U);
  EXPECT_NEAR(r.positions.front().phi, -half, 1e-15);
  EXPECT_NEAR(r.positions.back().phi, half, 1e-14);
  for (std::size_t k = 0; k < r.positions.size(); ++k) {
    const ReducedPosition& p = r.positions[k];
    const double by_angle = x / (2 * std::pow(std::cos(0.5 * p.phi), 2));
    EXPECT_NEAR(p.load, 60 * by_angle, 1e-9) << p.phi;
    ASSERT_TRUE(to_point.positions[k].ratio);
    EXPECT_NEAR(*to_point.positions[k].ratio, by_angle, 1e-10) << p.phi;
    EXPECT_NEAR(to_point.positions[k].inertia, p.inertia / (by_angle * by_angle), 1e-9);
  }
}

// Newton–Euler's equations of the links against energy: M = ½ I_r′ ω² + M_c, from two studies.
TEST(RockingRange, ForcesAgreeWithTheReduction) {
  for (const std::string& scene : {std::string(inversor), double_rocker()}) {
    ReduceOptions reducing;
    reducing.speed = 20;
    ForcesOptions forcing;
    forcing.speed = 20;
    const MachineReduction r = reduce(test::scene_from(scene), reducing);
    const Forces f = find_forces(test::scene_from(scene), forcing);
    EXPECT_FALSE(f.simulated);
    EXPECT_TRUE(f.over_a_range);
    const ForceCycle& c = *f.prescribed;
    EXPECT_NEAR(c.begin, r.begin, 1e-15);
    ASSERT_EQ(c.rows.size(), r.positions.size());
    const double scale = std::abs(c.torque.value);
    for (std::size_t k = 0; k < c.rows.size(); ++k) {
      const ReducedPosition& p = r.positions[k];
      EXPECT_NEAR(c.rows[k].forces.torque, 0.5 * p.slope * 400 + p.load, 1e-7 * scale) << p.phi;
    }
    EXPECT_NEAR(c.mean_speed.value, 20, 1e-10);
    EXPECT_TRUE(c.shaking_x.empty() && c.torque_orders.empty());
    // Its largest torque is at an end, which is examined itself.
    EXPECT_LT(*c.torque.error, 1e-9 * scale);
    const double grown = 200 * (r.positions.back().inertia - r.positions.front().inertia);
    EXPECT_NEAR(c.kinetic_change.value, grown, 1e-7 * std::abs(grown));
  }
}

TEST(RockingRange, BothStudiesTakeTheArcAtTheStart) {
  struct Case {
    const char *start, *line, *parts;
    double phase, crank_middle;  // [°]
  };
  const double middle = 0.5 * (27.65 + 98.2);
  const Case cases[] = {{"{ angle = '60 deg' }", R"(["motor", "arm"])", "", 0, middle},
                        {"{ angle = '410 deg' }", R"(["motor", "arm"])", "", 0, middle + 360},
                        {"{ angle = '380 deg' }", R"(["motor", "arm"])", "", 30, middle + 360},
                        {"{ on = 'arm', angle = '-320 deg' }", R"(["motor", "arm"])", "", 0, middle - 360},
                        {"{ on = 'motor', angle = '1260 deg' }", R"(["motor", "gear", "arm"])",
                         "gear = { kind = 'gearbox', stages = [{ teeth = [20, 60] }] }", 0, middle + 360}};
  for (const Case& c : cases) {
    std::string scene = double_rocker() + fmt::format("start = {}\n", c.start);
    scene.replace(scene.find(R"(["motor", "arm"])"), std::string(R"(["motor", "arm"])").size(), c.line);
    scene.replace(scene.find("[arm]"), 0, std::string(c.parts) + "\n");
    scene.replace(scene.find("gravity"), 0, fmt::format("phase = '{} deg'\n", c.phase));
    ReduceOptions reducing;
    reducing.speed = 20;
    ForcesOptions forcing;
    forcing.speed = 20;
    const MachineReduction r = reduce(test::scene_from(scene), reducing);
    const Forces f = find_forces(test::scene_from(scene), forcing);
    EXPECT_NEAR(0.5 * (r.positions.front().phi + r.positions.back().phi) / degree, c.crank_middle - c.phase, 0.1);
    EXPECT_NEAR(f.prescribed->begin - c.phase * degree, r.begin, 1e-12) << c.start;
  }
}

// Where the velocity of a pin reverses within the range, its friction jumps: the works close only if that is an edge.
TEST(RockingRange, FrictionReversesWithinTheRange) {
  ForcesOptions options;
  options.range = AngleRange{30 * degree, 95 * degree};
  for (const double speed : {20.0, -20.0}) {
    options.speed = speed;
    const Forces f = find_forces(test::scene_from(double_rocker(bushes)), options);
    const ForceCycle& c = *f.prescribed;
    double sum = -c.kinetic_change.value, turnover = 0, lost = 0;
    for (const CycleWork& w : c.work) {
      sum += w.work.value, turnover += w.turnover;
      if (w.kind == "harmful") lost -= w.work.value;
    }
    EXPECT_GT(lost, 0.01 * turnover);
    EXPECT_NEAR(sum, 0, 1e-9 * turnover);
    ASSERT_TRUE(c.efficiency || !c.no_efficiency.empty());
  }
}

TEST(RockingRange, RefusesARangeThatLeavesTheArc) {
  const auto refused = [](const std::string& scene, const AngleRange& range) -> std::string {
    ReduceOptions options;
    options.range = range;
    try {
      reduce(test::scene_from(scene), options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refused(double_rocker(), {20 * degree, 80 * degree}).find("to 98.1"), std::string::npos);
  EXPECT_NE(refused(double_rocker(), {80 * degree, 40 * degree}).find("must rise"), std::string::npos);
  const std::string turning = R"(
line = ["motor", "press"]
motor = { kind = "torque source", torque = "1 N*m", inertia = "0.1 kg*m2" }
press = { kind = "slider-crank", radius = "50 mm", rod = "180 mm", slider_mass = "3 kg" }
)";
  EXPECT_NE(refused(turning, {0, 1}).find("turns fully"), std::string::npos);
}

test::Said check(const std::string& scene) {
  const test::ScratchFolder folder;
  std::ofstream(folder / "scene.toml") << scene;
  return test::said_by_program("check '" + (folder / "scene.toml").string() + "'");
}

// A scene that cannot start is not valid; one whose crank rocks says so.
TEST(RockingRange, CheckSaysWhatAMotionWouldRunInto) {
  const test::Said refused = check(double_rocker());
  EXPECT_EQ(refused.code, 2) << refused.text;
  EXPECT_TRUE(refused.has("\"arm\" cannot stand at φ = 0°")) << refused.text;
  EXPECT_TRUE(refused.has("in the middle 62.93°")) << refused.text;
  const test::Said valid = check(inversor);
  EXPECT_EQ(valid.code, 0) << valid.text;
  EXPECT_TRUE(valid.has("\"saw\" cannot turn: its crank rocks between φ = -98.92° and 98.92°")) << valid.text;
}

}  // namespace
}  // namespace kurbel::rocking_range_test
