// margins_test.cpp — separation margins by closed forms: every crossing of every shaft's orders is there, whatever a motor's
// curve does; what tolerances make of a margin.
#include "studies/margins/margins.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "studies/margins/margins_findings.h"
#include "studies/modes/campbell.h"
#include "studies/modes/critical_speeds.h"
#include "studies/modes/modes.h"
#include "tests/support/scenes.h"

namespace kurbel::margins_test {
namespace {

constexpr double rpm = M_PI / 30;

const Margin* row_of(const Margins& m, int mode, const std::string& label) {
  for (const Margin& row : m.rows)
    if (m.modes[row.mode].number == mode && m.lines[row.line].label == label) return &row;
  return nullptr;
}
const ExcitationLine* line_of(const Margins& m, const std::string& label) {
  for (const ExcitationLine& line : m.lines)
    if (line.label == label) return &line;
  return nullptr;
}

Margins margins_of(const Scene& scene, const ModesOptions& options = {}) {
  return find_modes(scene, scene.effects, options).margins;
}

// A motor's rated speed is stated for the link behind its gear.
TEST(Margins, SpeedsAreThoseOfTheLink) {
  const Scene scene = test::scene_from(R"(
    line = ["motor", "gear", "crank"]
    motor = { kind = "induction motor", rated_power = "4 kW", rated_speed = "1440 rpm", synchronous_speed = "1500 rpm", breakdown_ratio = 2.8, inertia = "0.02 kg*m2" }
    gear = { kind = "gearbox", stages = [{ teeth = [20, 60] }] }
    crank = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "0.1 kg*m2", slider_mass = "1 kg" }
  )");
  const OperatingSpeeds speeds = operating_speeds(*compile(scene, scene.effects), {}, {});
  EXPECT_NEAR(speeds.slowest, 1440 * M_PI / 30 / 3, 1e-9);
  EXPECT_EQ(speeds.slowest, speeds.fastest);
}

// A shunt motor's data have a speed without load, at which nothing is driven: it is no rated speed.
TEST(Margins, OnlyANameplateHasARatedSpeed) {
  const Scene scene = test::scene_from(R"(
    line = ["motor", "gear", "crank"]
    motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "150 rad/s", inertia = "0.02 kg*m2" }
    gear = { kind = "gearbox", stages = [{ teeth = [20, 60] }] }
    crank = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "0.1 kg*m2", slider_mass = "1 kg" }
  )");
  const auto model = compile(scene, scene.effects);
  const OperatingSpeeds steady = operating_speeds(*model, {}, 35.0), unknown = operating_speeds(*model, {}, {});
  EXPECT_EQ(steady.words, "of the steady motion");
  EXPECT_EQ(steady.fastest, 35.0);
  EXPECT_EQ(unknown.words, "reference speed of motor");
  EXPECT_NEAR(unknown.fastest, 50, 1e-9);
}

// Below its breakdown the motor does not stay; the shaft crosses there all the same: ω = √(k (1/J₁ + 1/J₂)).
TEST(Margins, DoNotDependOnTheSlopeOfAMotorsCurve) {
  const double omega = std::sqrt(1400 * (1 / 0.1 + 1 / 0.8));
  Scene scene = test::scene_file("tests/cases/reports/crossing_below_breakdown.toml");
  for (const double ratio : {2.8, 1.6}) {
    SCOPED_TRACE(ratio);
    for (Section& section : scene.components)
      for (Setting& s : section.settings)
        if (s.key == "breakdown_ratio") s.number = ratio;
    const ModesStudy study = find_modes(scene, scene.effects, {});
    const Margin* row = row_of(study.margins, 1, "1×");
    ASSERT_NE(row, nullptr);
    ASSERT_TRUE(row->crossing);
    EXPECT_NEAR(*row->crossing / rpm, 1198.43, 0.005);
    EXPECT_NEAR(*row->crossing, omega, 1e-6 * omega);
    EXPECT_NEAR(row->margin, omega / (1455 * rpm) - 1, 1e-6);
    EXPECT_FALSE(row->within);
    EXPECT_TRUE(study.margins.lines[row->line].in_scene);
  }
}

TEST(Margins, SayWhyAResponseIsNotAssessed) {
  const ModesStudy study = [] {
    const Scene scene = test::scene_file("tests/cases/reports/crossing_below_breakdown.toml");
    return find_modes(scene, scene.effects, {});
  }();
  const Margin* pulse = row_of(study.margins, 1, "1×");
  const Margin* twice = row_of(study.margins, 1, "2×");
  const Margin* mains = row_of(study.margins, 1, "2× mains");
  ASSERT_TRUE(pulse && twice && mains);
  EXPECT_EQ(pulse->not_assessed, "the machine cannot run continuously there");
  EXPECT_EQ(twice->not_assessed, "the scene as it is has no such torque");
  EXPECT_FALSE(mains->crossing);
  EXPECT_NEAR(mains->margin, std::sqrt(15750) / (200 * M_PI) - 1, 1e-6);
}

// Motor on a shaft k, wheel of 41 and pinion of 23 teeth, pump: ω² = k (1/J₁ + 1/(J₂ i²)), i = 41/23. An order r of the pump
// is r i of the motor, and crosses at ω/(r i).
std::string geared(const std::string& further) {
  return R"~(
line = ["motor", "shaft", "gear", "pump"]
motor = { kind = "inertia", inertia = "2 kg*m2" }
shaft = { kind = "shaft", stiffness = "60 kN*m/rad", damping = "20 N*m*s/rad" }
gear = { kind = "gearbox", stages = [{ teeth = [41, 23] }] }
pump = { kind = "load", torque = "0 N*m", inertia = "0.5 kg*m2", orders = [5] }
effects = { elasticity = true }
run = { start = { speed = "1250 rpm" } }
)~" + further;
}

TEST(Margins, HaveTheOrdersOfEveryShaft) {
  const double i = 41.0 / 23, omega = std::sqrt(60e3 * (1 / 2.0 + 1 / (0.5 * i * i)));
  const Scene scene =
      test::scene_from(geared("[operation]\nspeeds = [\"1200 rpm\", \"1300 rpm\"]\nmargin = \"12 %\"\n"));
  const Margins m = margins_of(scene);
  EXPECT_TRUE(m.speeds.said);
  const std::pair<const char*, double> orders[] = {{"1× motor", 1},    {"2× motor", 2},    {"1× pump", i},
                                                   {"2× pump", 2 * i}, {"5× pump", 5 * i}, {"mesh gear", 41}};
  for (const auto& [label, order] : orders) {
    SCOPED_TRACE(label);
    const Margin* row = row_of(m, 1, label);
    ASSERT_NE(row, nullptr);
    ASSERT_TRUE(row->crossing);
    const double crossing = omega / order / rpm;
    EXPECT_NEAR(*row->crossing / rpm, crossing, 1e-6 * crossing);
    const double margin = crossing > 1300 ? crossing / 1300 - 1 : crossing < 1200 ? crossing / 1200 - 1 : 0;
    EXPECT_NEAR(row->margin, margin, 1e-6);
    EXPECT_EQ(row->within, std::abs(margin) < 0.12);
  }
  EXPECT_EQ(m.rows.size(), m.modes.size() * m.lines.size());
}

// The range may be that of any shaft.
TEST(Margins, AreOfTheShaftWhoseSpeedsAreGiven) {
  const Margins of_pump = margins_of(test::scene_from(geared("[operation]\nspeeds = [\"2000 rpm\"]\non = \"pump\"\n")));
  EXPECT_NEAR(of_pump.speeds.fastest / rpm, 2000 * 23.0 / 41, 1e-9);
}

TEST(Margins, TakeWhatExcitesFromTheSceneAndItsResponse) {
  const Scene scene = test::scene_from(geared(
      "[pulse]\nkind = \"torque source\"\non = \"pump\"\ntable = { over = \"angle\", formula = \"5 [N*m]*sin(3*phi)\", "
      "period = \"120 deg\" }\n"));
  const ModesStudy study = find_modes(scene, scene.effects, {});
  const Margin* row = row_of(study.margins, 1, "3× pump");
  ASSERT_NE(row, nullptr);
  EXPECT_TRUE(study.margins.lines[row->line].in_scene);
  EXPECT_EQ(row->not_assessed, "");
  ASSERT_TRUE(row->response);
  EXPECT_EQ(row->response->joint, "shaft");
  ASSERT_EQ(study.critical.size(), 1u);
  EXPECT_EQ(row->response->amplitude, study.critical.front().amplitude);
  EXPECT_EQ(study.margins.modes.front().damping, "shaft 100 %");
}

// Two free masses under M sin 3φ: the torque of the spring is largest at s² = (√(1 + 8ζ²) − 1)/(4ζ²) of ω_n.
TEST(Margins, AreStatedAtTheLargestResponse) {
  const double reduced = 2 * 0.5 / 2.5, omega = std::sqrt(60e3 / reduced), operating = 0.9 * omega / 3;
  for (const double zeta : {0.005, 0.1, 0.25}) {
    SCOPED_TRACE(zeta);
    const Scene scene = test::scene_from(fmt::format(R"~(
line = ["motor", "shaft", "pump"]
motor = {{ kind = "inertia", inertia = "2 kg*m2" }}
shaft = {{ kind = "shaft", stiffness = "60 kN*m/rad", damping_ratio = {} }}
pump = {{ kind = "load", torque = "0 N*m", inertia = "0.5 kg*m2" }}
pulse = {{ kind = "torque source", on = "pump", table = {{ over = "angle", formula = "5 [N*m]*sin(3*phi)", period = "120 deg" }} }}
effects = {{ elasticity = true }}
operation = {{ speeds = ["{:.15g} rad/s"] }}
run = {{ start = {{ speed = "{:.15g} rad/s" }} }}
)~",
                                                     zeta, operating, operating));
    const ModesStudy study = find_modes(scene, scene.effects, {});
    const Margin* row = row_of(study.margins, 1, "3×");
    ASSERT_TRUE(row && row->crossing);
    EXPECT_EQ(row->not_assessed, "");
    EXPECT_NEAR(*row->crossing, omega / 3, 1e-6 * omega);
    EXPECT_NEAR(row->margin, 1 / 0.9 - 1, 1e-6);
    const double s = std::sqrt((std::sqrt(1 + 8 * zeta * zeta) - 1) / (4 * zeta * zeta));
    EXPECT_EQ(row->largest.has_value(), s < 1 - 5e-4);
    EXPECT_NEAR(row->at_largest, (row->largest ? s : 1) / 0.9 - 1, 1e-3 * zeta + 1e-6);
    if (!row->largest) continue;
    EXPECT_NEAR(*row->largest, s * omega / 3, 1e-3 * zeta * omega);
    const std::string claim = margin_claim(study.margins, study.speed_unit).value().text;
    for (const std::string& said :
         {"(at the largest response, " + study.speed_unit.text(*row->largest, 4), std::string("+11.11 % (at")})
      EXPECT_NE(claim.find(said), std::string::npos) << claim;
  }
}

TEST(Margins, OfAConverterHaveBothCrossingsOfADifference) {
  const Scene scene = test::scene_from(
      geared("[operation]\nspeeds = [\"900 rpm\", \"1100 rpm\"]\nmains = \"50 Hz\"\nmotor = \"motor\"\npole_pairs = 2\n"
             "converter = [\"6\", \"6 output - 6 mains\"]\n"));
  const Margins m = margins_of(scene);
  const ExcitationLine* six = line_of(m, "6× output");
  const ExcitationLine* difference = line_of(m, "6 output - 6 mains");
  ASSERT_TRUE(six && difference);
  EXPECT_NEAR(six->order, 12, 1e-12);
  EXPECT_NEAR(difference->at(1000 * rpm), std::abs(12 * 1000 * rpm - 600 * M_PI), 1e-9);
  const double omega = m.modes.front().omega;
  const std::vector<double> meets = crossings(omega, *difference);
  ASSERT_EQ(meets.size(), 2u);
  EXPECT_NEAR(meets[0], (600 * M_PI - omega) / 12, 1e-9);
  EXPECT_NEAR(meets[1], (600 * M_PI + omega) / 12, 1e-9);
  const Margin* row = row_of(m, 1, "6 output - 6 mains");
  ASSERT_TRUE(row && row->crossing && row->further_crossing);
  EXPECT_EQ(*row->crossing + *row->further_crossing, meets[0] + meets[1]);
  EXPECT_TRUE(line_of(m, "1× mains") && line_of(m, "2× mains"));
}

TEST(Margins, AreZeroBetweenTheEndsOfAnExcitation) {
  const OperatingSpeeds run{.slowest = 90, .fastest = 110};
  const ExcitationLine twice{.order = 2};
  EXPECT_EQ(margin_of(200, twice, run), 0);
  EXPECT_NEAR(margin_of(242, twice, run), 0.1, 1e-12);
  EXPECT_NEAR(margin_of(144, twice, run), -0.2, 1e-12);
  const ExcitationLine through{.order = 1, .fixed = -100};  // it passes 0 within the range
  EXPECT_EQ(margin_of(5, through, run), 0);
  EXPECT_NEAR(margin_of(20, through, run), 1, 1e-12);
}

// Of k alone, uniform within ± 10 %: ω = ω₀ √(k/k₀). 1× at n crosses at n_c = 1.12 n: the margin is 1.12 √κ − 1, kept where
// κ ≥ (1.1/1.12)².
TEST(Margins, OfATolerancedStiffnessAreThoseOfTheClosedForm) {
  const double omega = std::sqrt(1e4 * (1 / 1.0 + 1 / 4.0));
  const Scene scene = test::scene_from(fmt::format(R"~(
line = ["a", "shaft", "b"]
a = {{ kind = "inertia", inertia = "1 kg*m2" }}
b = {{ kind = "inertia", inertia = "4 kg*m2" }}
shaft = {{ kind = "shaft", stiffness = {{ value = "10 kN*m/rad", tolerance = "10 %", distribution = "uniform" }} }}
effects = {{ elasticity = true }}
operation = {{ speeds = ["{:.15g} rad/s"] }}
)~",
                                                   omega / 1.12));
  const Margins m = margins_of(scene);
  EXPECT_EQ(m.tolerances, std::vector<std::string>{"shaft.stiffness"});
  const Margin* row = row_of(m, 1, "1×");
  ASSERT_TRUE(row && row->kept);
  EXPECT_NEAR(row->margin, 0.12, 1e-9);
  EXPECT_NEAR(row->low, 1.12 * std::sqrt(0.905) - 1, 1e-4);
  EXPECT_NEAR(row->high, 1.12 * std::sqrt(1.095) - 1, 1e-4);
  const double kept = (1.1 - std::pow(1.1 / 1.12, 2)) / 0.2;
  EXPECT_NEAR(row->kept->value, kept, 2e-4);
  EXPECT_GT(*row->kept->error, 0);
}

// Two that act together: ω² = k/J₁ + k/J₂ with J₂ → ∞, both normal: ln ω has the deviation ½ √(σ_k² + σ_J²), nearly.
TEST(Margins, OfSeveralTolerancesAddUp) {
  const Scene scene = test::scene_from(R"~(
line = ["a", "shaft", "b"]
a = { kind = "inertia", inertia = { value = "1 kg*m2", tolerance = "6 %", distribution = "normal", k = 2 } }
b = { kind = "inertia", inertia = "1e6 kg*m2" }
shaft = { kind = "shaft", stiffness = { value = "10 kN*m/rad", tolerance = "8 %", distribution = "normal", k = 2 } }
effects = { elasticity = true }
operation = { speeds = ["80 rad/s"] }
)~");
  const Margin* row = nullptr;
  const Margins m = margins_of(scene);
  ASSERT_TRUE((row = row_of(m, 1, "1×")) && row->kept);
  const double spread = std::log((1 + row->high) / (1 + row->low));
  EXPECT_NEAR(spread, 2 * 1.95996 * 0.5 * std::hypot(0.03, 0.04), 0.02 * spread);
}

// Nothing excites it: the diagram has the orders, the mode and the range all the same, and the sentence the nearest.
TEST(Margins, StandInTheDiagramWithoutAnyExcitation) {
  const Scene scene = test::scene_from(geared("[operation]\nspeeds = [\"1200 rpm\", \"1300 rpm\"]\n"));
  const ModesStudy study = find_modes(scene, scene.effects, {});
  ASSERT_TRUE(study.excitations.by_order.empty());
  const Plot plot = modes::campbell_plot(study);
  for (const char* label : {"1× motor", "2× motor"})
    EXPECT_TRUE(std::any_of(plot.series.begin(), plot.series.end(), [&](const Series& s) {
      return s.text_at_end == label;
    })) << label;
  for (const char* band : {"operating range", "± 10 %"})
    EXPECT_TRUE(std::any_of(plot.bands.begin(), plot.bands.end(), [&](const Band& b) { return b.text == band; }))
        << band;
  EXPECT_NE(margin_claim(study.margins, study.speed_unit).value().text.find("± 10 %"), std::string::npos);
}

// A joint that turns unevenly excites by its twist alone: its order counts beside another's torque.
TEST(Margins, HaveTheOrdersOfUniversalJoints) {
  const Scene scene = test::scene_from(R"~(
line = ["motor", "joint", "shaft", "fan"]
motor = { kind = "dc shunt motor", stall_torque = "400 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2" }
joint = { kind = "universal joint", angle = "8 deg", stiffness = "50 kN*m/rad", damping_ratio = 0.02 }
shaft = { kind = "inertia", inertia = "0.2 kg*m2" }
fan = { kind = "torque source", inertia = "0.5 kg*m2", table = { over = "angle", formula = "5 [N*m]*sin(phi)", period = "360 deg" } }
effects = { elasticity = true }
run = { start = { speed = "90 rad/s" } }
)~");
  const ModesStudy study = find_modes(scene, scene.effects, {.fastest = 400});
  const ExcitationLine* twice = line_of(study.margins, "2×");
  ASSERT_NE(twice, nullptr);
  EXPECT_TRUE(twice->in_scene);
  EXPECT_TRUE(twice->harmonic);
}

}  // namespace
}  // namespace kurbel::margins_test
