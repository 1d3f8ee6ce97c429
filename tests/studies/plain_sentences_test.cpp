// plain_sentences_test.cpp — sentences and pages say what was found: which orders a fit compared, that a start falls short,
// which of two influences leads, what is drawn once.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "studies/claims/headline.h"
#include "studies/dictionary/dictionary.h"
#include "studies/difference/difference.h"
#include "studies/findings/output.h"
#include "studies/forces/forces_findings.h"
#include "studies/modes/modes.h"
#include "studies/modes/modes_plots.h"
#include "studies/run/run_findings.h"
#include "studies/size/size.h"
#include "studies/steady/steady.h"
#include "studies/steady/steady_words.h"
#include "studies/sweep/sweep_findings.h"
#include "tests/support/scenes.h"

namespace kurbel::plain_sentences_test {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
SimulateOptions once() { return {.measure_error = false, .traces = true, .method = {}, .accuracy = {}, .until = {}}; }

std::vector<std::string> titles(const std::vector<Plot>& plots) {
  std::vector<std::string> all;
  for (const Plot& plot : plots) all.push_back(plot.title);
  return all;
}

// Kloss: 68 N·m at standstill, 126 N·m at most. Against 100 N·m it goes on at speed, and does not start.
TEST(PlainSentences, AStartThatFallsShortIsConcluded) {
  const std::string machine =
      "line = [\"motor\", \"load\"]\n"
      "motor = { kind = \"induction motor\", rated_power = \"4 kW\", rated_speed = \"95 rad/s\", synchronous_speed = "
      "\"100 rad/s\", breakdown_ratio = 3, inertia = \"2 kg*m2\" }\n"
      "load = { kind = \"load\", torque = \"100 N*m\" }\n[run]\nstart = { speed = \"90 rad/s\" }\n";
  const SteadyStudy study = steady(test::scene_from(machine), {Effects{}}, {});
  ASSERT_TRUE(study.start && !study.start->reached) << study.diagnosis;
  EXPECT_TRUE(study.start->falls_short);
  EXPECT_TRUE(has(study.start->why, "it then stands still")) << study.start->why;
  EXPECT_TRUE(has(study.conclusion, "From rest \"motor\" does not reach")) << study.conclusion;
  const Report page = page_of(findings_of(study));
  std::set<std::string> drawn;
  for (const ReportSection& section : page.sections)
    for (const Card& card : section.cards)
      if (const Plot* plot = std::get_if<Plot>(&card)) drawn.insert(plot->title);
  EXPECT_TRUE(drawn.contains("Start from rest: it does not reach the steady speed"));
}

// y = 10 a + 9.9 b, z = 3 a + b on a complete grid.
SweepStudyResult study_of_a_square(const std::vector<std::string>& limits) {
  SweepIdentity identity;
  identity.meta = {{"design", "grid"}, {"of", "run"}, {"scene file", "x.toml"}, {"seed", "1"}};
  for (const char* given : {"a.x=0..1", "b.x=0..1"}) identity.parameters.push_back(parse_parameter(given));
  identity.figures = {{"y", ""}, {"z", ""}};
  identity.rows = 4;
  std::vector<SweepRow> rows;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto a = static_cast<double>(i / 2), b = static_cast<double>(i % 2);
    rows.push_back({.row = i, .parameters = {a, b}, .figures = {{{10 * a + 9.9 * b}, 0}, {{3 * a + b}, 1}}});
  }
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("kurbel_square_" + std::to_string(getpid()) + ".db");
  std::filesystem::remove(file);
  SweepStore(file, identity).write(rows);
  const SweepStudyResult study = study_of(SweepStore(file), limits);
  std::filesystem::remove(file);
  return study;
}

TEST(PlainSentences, AlikeInfluencesAreNotRankedAndTheLimitedFigureLeads) {
  const std::string alike = findings_of(study_of_a_square({})).conclusion();
  EXPECT_TRUE(has(alike, "y depends on a.x and b.x together")) << alike;
  const std::string limited = findings_of(study_of_a_square({"z <= 2"})).conclusion();
  EXPECT_TRUE(has(limited, "z ≤ 2 holds in 2 of 4")) << limited;
  EXPECT_TRUE(has(limited, "z depends most on a.x (90 % of its variance)")) << limited;
}

// A torque source that is shaken has two accounts of driving work, and one torque.
TEST(PlainSentences, ADriveIsDrawnOnceAndAnAxleHasNoCrank) {
  Scene scene = test::scene_file("scenes/drive_axle.toml");
  scene.run.until = 1;
  const Result r = simulate(scene, scene.effects, "elastic", once());
  const std::vector<std::string> drives = titles(drive_plots({&r}));
  EXPECT_EQ(std::count(drives.begin(), drives.end(), "Torque of motor"), 1);
  EXPECT_EQ(angle_of_link(r), "angle of motor");
  for (const std::string& title : titles(motion_plots({&r}))) EXPECT_FALSE(has(title, "crank")) << title;
}

TEST(PlainSentences, APointThatALegMovesIsNoSlider) {
  Scene scene = test::scene_file("scenes/walking_leg.toml");
  scene.run.until = 0.1;
  const Result r = simulate(scene, scene.effects, "rigid", once());
  EXPECT_EQ(moved_part(*r.model, "leg"), "output");
  scene = test::scene_file("scenes/crank_press.toml");
  scene.run.until = 0.01;
  EXPECT_EQ(moved_part(*simulate(scene, scene.effects, "rigid", once()).model, "press"), "slider");
}

// What both have is mentioned on both sides; a tile gives the other value in its own unit.
TEST(PlainSentences, ModelsComparedMentionTheTorqueLagOnBothSides) {
  Scene scene = test::scene_file("scenes/crank_press.toml");
  scene.run.until = 1;
  const Comparison c = compare(scene, models_to_compare(scene), once());
  const Findings f = findings_of(c);
  EXPECT_TRUE(has(f.subtitle,
                  "rigid (torque lag) against elastic (elasticity of motor_coupling, main_coupling, with "
                  "torque lag)"))
      << f.subtitle;
  ASSERT_FALSE(f.figures.empty());
  EXPECT_TRUE(has(f.figures.front().note, " N·m · ratio ")) << f.figures.front().note;
}

TEST(PlainSentences, AFrequencyAboveTheUndampedOneHasItsReason) {
  const Scene scene = test::scene_file("scenes/crank_press.toml");
  const ModesStudy m = find_modes(scene, scene.effects, {});
  const std::string conclusion = findings_of(m).conclusion();
  EXPECT_TRUE(has(conclusion, "Hz, raised by ")) << conclusion;
}

// Shafts and joints stand along the axis as along the drive: in the first mode one node, in the second two.
TEST(PlainSentences, ModeShapesAreDrawnAlongTheDrive) {
  const Scene scene = test::scene_from(R"(
line = ["damper", "left", "long", "middle", "further", "right"]
left = { kind = "inertia", inertia = "20 kg*m2" }
damper = { kind = "viscous damper", ring_inertia = "2 kg*m2", damping = "50 N*m*s/rad" }
long = { kind = "shaft", length = "6 m", diameter = "100 mm", damping_ratio = 0.01 }
middle = { kind = "inertia", inertia = "5 kg*m2" }
further = { kind = "shaft", length = "4 m", diameter = "90 mm", damping_ratio = 0.01 }
right = { kind = "inertia", inertia = "30 kg*m2" }
effects = { elasticity = true }
run = { start = { speed = "100 rpm" } }
)");
  const ModesStudy m = find_modes(scene, scene.effects, {});
  const std::vector<Plot> plots = modes::mode_plots(m);
  const std::vector<std::string>& names = plots.at(0).x.names;
  ASSERT_GT(names.size(), 5u);
  EXPECT_EQ(names.back(), "right");
  const auto place = [&](const std::string& name) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.starts_with(name); });
    EXPECT_NE(found, names.end()) << name;
    return found - names.begin();
  };
  EXPECT_LT(place("left"), place("long, station at "));
  EXPECT_LT(place("long, station at "), place("middle"));
  EXPECT_LT(place("middle"), place("further, station at "));
  for (std::size_t k = 0; k < 2; ++k) {
    int nodes = 0;
    const std::vector<double>& y = plots[0].series.at(k).y;
    for (std::size_t i = 1; i < y.size(); ++i) nodes += (y[i] > 0) != (y[i - 1] > 0) ? 1 : 0;
    EXPECT_EQ(nodes, static_cast<int>(k) + 1) << k;
  }
}

// A limit that a case exceeds is said before those that hold.
TEST(PlainSentences, WhatACaseExceedsComesBeforeWhatHolds) {
  Claims claims;
  add(claims, claimed(Predicate::limit_held, "all limits hold", "shaft", {.value = 1, .limit = 2}));
  add(claims, claimed(Predicate::limit_exceeded, "in the case \"broken\" a limit is exceeded", "shaft",
                      {.value = 3, .limit = 2}));
  ASSERT_EQ(claims.size(), 2u);
  claims.back().variant = "broken";
  EXPECT_TRUE(has(concluded(claims).front(), "exceeded"));
}

TEST(PlainSentences, AFrequencyLoweredByADamperHasItsReason) {
  const Scene scene = test::scene_file("docs/tasks/ship_shaft_line.toml");
  ModesOptions options;
  options.modes_alone = true;
  const std::string conclusion = findings_of(find_modes(scene, scene.effects, options)).conclusion();
  EXPECT_TRUE(has(conclusion, "lowered by the inertia that \"damper\" couples by damping alone")) << conclusion;
}

// The speed of a load that drives the machine backwards changes its sign: a percentage says nothing of it.
TEST(PlainSentences, AChangeOfSignDoesNotLead) {
  MachineDifference d;
  d.a.file = "a.toml", d.b.file = "b.toml";
  d.figures = {{.name = "turned", .unit = "N", .a = Estimate{1}, .b = Estimate{-3}},
               {.name = "small", .unit = "N", .a = Estimate{1}, .b = Estimate{1.1}},
               {.name = "large", .unit = "N", .a = Estimate{1}, .b = Estimate{1.5}}};
  const Findings f = findings_of(d);
  ASSERT_FALSE(f.figures.empty());
  EXPECT_NE(f.figures.front().name, "turned");
  const Report page = page_of(f);
  std::vector<std::string> drawn;
  for (const ReportSection& section : page.sections)
    for (const Card& card : section.cards)
      if (const Plot* plot = std::get_if<Plot>(&card); plot && plot->bars) drawn = plot->x.names;
  EXPECT_EQ(drawn, (std::vector<std::string>{"large", "small"}));
}

TEST(PlainSentences, ASizedFlywheelIsSaidOnce) {
  SizeOptions options;
  options.delta = 0.05;
  const std::string said =
      findings_of(size_flywheel(test::scene_file("scenes/crank_press.toml"), options)).conclusion();
  const std::size_t first = said.find("δ is 0.0570");
  ASSERT_NE(first, std::string::npos) << said;
  EXPECT_EQ(said.find("δ is 0.0570", first + 1), std::string::npos) << said;
  EXPECT_FALSE(has(said, "meets δ")) << said;
}

TEST(PlainSentences, WordsOfPagesAreExplained) {
  for (const char* words : {"thermal load", "load edge", "folded dead centre", "Floquet multipliers", "angle of motor",
                            "UR M68", "spot checks", "internal states", "resonance passed", "severity"})
    EXPECT_NE(meant_by(words), nullptr) << words;
}

// A four-bar as a pendulum: it falls to the end of its crank's arc, where the run stops between two checks of its balance.
const char* const pendulum = R"(
line = ["rocker"]
[rocker]
kind = "four-bar"
crank = "100 mm"
coupler = "150 mm"
rocker = "90 mm"
ground = "220 mm"
crank_mass = "4 kg"
crank_com = "60 mm"
crank_inertia = "0.02 kg*m2"
coupler_mass = "2 kg"
coupler_inertia = "0.004 kg*m2"
rocker_mass = "3 kg"
rocker_com = "40 mm"
rocker_inertia = "0.008 kg*m2"
gravity = "9.81 m/s2"
[run]
start = { angle = "-20 deg" }
until = "3 s"
)";

// Weights alone do work: it is the kinetic energy, in the figures and in the balance.
TEST(PlainSentences, WorksOfAnIncompleteRunAreThoseUpToItsEnd) {
  const Result r = test::run(test::scene_from(pendulum), false);
  ASSERT_FALSE(r.complete);
  ASSERT_GT(r.energy.kinetic_end, 1);
  EXPECT_NEAR(test::figure(r, "work.weight"), r.energy.kinetic_end - r.energy.kinetic_start,
              1e-4 * r.energy.kinetic_end);
  const Figure* const weight = r.find("work.weight");
  ASSERT_TRUE(weight && weight->at);
  EXPECT_LT(*weight->at, 0.5);
  EXPECT_TRUE(has(terminal_text(findings_of(r, nullptr), true), "work: weight 4.88")) << r.diagnosis;
}

// No drive, at rest: the speed of the first problem is nobody's, and the sentence says so.
TEST(PlainSentences, ForcesNameASpeedThatTheSceneDoesNotState) {
  const Scene scene = test::scene_from(pendulum);
  const std::string words = "(reference speed, which the scene does not state)";
  const std::string assumed = findings_of(find_forces(scene, {})).conclusion();
  EXPECT_TRUE(has(assumed, words)) << assumed;
  ForcesOptions at_speed;
  at_speed.speed = 10;
  const std::string asked = findings_of(find_forces(scene, at_speed)).conclusion();
  EXPECT_FALSE(has(asked, words)) << asked;
}

// To and fro on a torsion spring: half the sum of the extreme speeds is no reference, and there is no run-up to it.
TEST(PlainSentences, ALinkThatReversesHasNoFluctuation) {
  const Scene scene = test::scene_from(R"(
line = ["drive", "rocker"]
[drive]
kind = "torque source"
amplitude = "3 N*m"
frequency = "2 Hz"
inertia = "0.01 kg*m2"
[rocker]
kind = "linkage"
unit = "mm"
points = { O = [0, 0], A = [100, 0], B = [178.18, 128.02], C = [220, 0] }
frame = "O C"
lengths = { AB = "150 mm" }
[rocker.links]
crank = { points = "O A", mass = "4 kg", inertia = "0.02 kg*m2" }
coupler = { points = "A B", mass = "2 kg", inertia = "0.004 kg*m2" }
arm = { points = "C B", mass = "3 kg", inertia = "0.008 kg*m2" }
[rocker.couples]
bar = { between = "frame crank", stiffness = "40 N*m/rad", damping = "0.4 N*m*s/rad" }
[run]
until = "10 s"
)");
  const Result r = test::run(scene, false);
  ASSERT_TRUE(r.complete && reverses_within_cycle(r)) << r.diagnosis;
  const Findings f = findings_of(r, nullptr);
  const std::string text = terminal_text(f, true), json = json_text(summary_of(f));
  EXPECT_TRUE(has(text, "moves to and fro with a period of 0.5 s")) << text;
  for (const char* figure : {"delta.rocker", "cycle_fluctuation", "run_up_time"})
    EXPECT_FALSE(has(text, figure) || has(json, figure)) << figure;
  EXPECT_TRUE(has(text, "period"));
}

// A prescribed speed neither changes nor deviates: that it does not is nothing that was found.
TEST(PlainSentences, APrescribedSpeedIsNotJudged) {
  const Scene scene = test::scene_from(R"(
line = ["drive", "press"]
[drive]
kind = "prescribed speed"
speed = "90 rpm"
[press]
kind = "slider-crank"
radius = "100 mm"
rod = "400 mm"
slider_mass = "20 kg"
[run]
until = "2 s"
)");
  const std::string run = findings_of(test::run(scene, false), nullptr).conclusion();
  EXPECT_TRUE(has(run, "90 rpm")) << run;
  EXPECT_FALSE(has(run, "whose steadiness")) << run;
  const SteadyStudy study = steady(scene, {Effects{}}, {});
  EXPECT_TRUE(has(study.conclusion, "its speed is prescribed")) << study.conclusion;
  EXPECT_FALSE(has(study.conclusion, "stable")) << study.conclusion;
}

// Another ratio gives another steady speed: what was compared is the time to the present one.
TEST(PlainSentences, TheFastestRatioIsSaidWithItsCriterion) {
  SteadyStudy study;
  study.ratios = {{"g1", 2.5, 1.793, 3.1, 2.951, {}, {}, false}};
  const std::vector<std::string> words = words_of_start(study);
  ASSERT_EQ(words.size(), 1U);
  EXPECT_EQ(words.front(),
            "The driven side of \"g1\" has 95 % of its present steady speed soonest with ratio 1.793: 2.951 s; its "
            "ratio is 2.5: 3.1 s");
}

}  // namespace
}  // namespace kurbel::plain_sentences_test
