// beyond_tables_test.cpp — what a motion takes from beyond the end of a table is reported, and has no error bar.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <tuple>

#include "engine/scene/messages.h"
#include "studies/forces/forces_findings.h"
#include "studies/modes/modes.h"
#include "studies/reduce/reduce.h"
#include "studies/report/render.h"
#include "studies/run/run_findings.h"
#include "studies/steady/steady.h"
#include "studies/validity/outside_data.h"
#include "tests/support/scenes.h"

namespace kurbel::test::beyond_tables_test {
namespace {

namespace fs = std::filesystem;
constexpr double rpm = std::numbers::pi / 30;

bool reports(const Result& r) {
  return std::any_of(r.claims.begin(), r.claims.end(), [](const Claim& c) {
    return c.predicate == Predicate::outside_data && c.text.find("outside its table") != std::string::npos;
  });
}

std::string refusal(const Scene& scene) {
  try {
    run(scene, false);
  } catch (const SceneError& error) {
    return fmt::format("{}: {}", error.messages.front().at.line, error.messages.front().text);
  }
  return "";
}

// The catalogue curve of the report with another word for what is beyond its end.
Scene motor_that_ends(const std::string& beyond, double until = 200) {
  Scene scene = scene_file("tests/cases/reports/motor_curve_ends.toml");
  std::string text = scene.text;
  if (!beyond.empty())
    text.replace(text.find("over = \"speed\""), 14, fmt::format("over = \"speed\", beyond = \"{}\"", beyond));
  scene = scene_from(text);
  scene.run.until = until;
  return scene;
}

// 31 N·m at 1796 rpm, falling by (255 − 31)/36 N·m a rpm: meets 0.05 N·m·s/rad at 1799.47 rpm. Held, 31/0.05 rad/s.
const double slope = (31.0 - 255) / (36 * rpm), end = 1796 * rpm;
const double on_line = (31 - slope * end) / (0.05 - slope), held = 31 / 0.05;

TEST(BeyondTables, AMotorsFallingCurveGoesOnAlongItsLastSlope) {
  const Scene scene = motor_that_ends("");
  EXPECT_NEAR(on_line / rpm, 1799.47, 0.005);
  const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
  ASSERT_TRUE(study.complete) << study.diagnosis;
  ASSERT_TRUE(study.diagram && study.diagram->working_point());
  EXPECT_NEAR(study.diagram->working_point()->speed.value, on_line, 1e-9 * on_line);
  EXPECT_TRUE(study.diagram->working_point()->beyond_data);
  const Figure* mean = study.cycles.front().find("mean_speed." + study.link);
  ASSERT_NE(mean, nullptr);
  EXPECT_NEAR(mean->value, on_line, 1e-9 * on_line);
  EXPECT_FALSE(mean->error);
  const StudyOutput output{findings_of(study)};
  EXPECT_NE(output.json().find("outside its table, which ends at 1796 rpm"), std::string::npos);

  const Result r = run(scene);
  EXPECT_TRUE(reports(r));
  EXPECT_NEAR(figure(r, "final_speed." + study.link), on_line, 1e-6 * on_line);
  EXPECT_FALSE(r.find("final_speed." + study.link)->error);
}

TEST(BeyondTables, WhatTheSceneSaysIsData) {
  for (const auto& [word, speed] : {std::pair("line", on_line), std::pair("hold", held)}) {
    const Scene scene = motor_that_ends(word);
    const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
    ASSERT_TRUE(study.complete) << study.diagnosis;
    const Figure* mean = study.cycles.front().find("mean_speed." + study.link);
    EXPECT_NEAR(mean->value, speed, 1e-9 * speed) << word;
    EXPECT_TRUE(mean->error) << word;
    EXPECT_FALSE(reports(run(scene, false))) << word;
  }
}

TEST(BeyondTables, AMotionThatMustNotLeaveItsTableIsRefused) {
  const std::string said = refusal(motor_that_ends("refuse"));
  EXPECT_EQ(said.substr(0, said.find(" from")),
            "5: \"motor\": its table of torque ends at 1796 rpm, and the motion is beyond it");
  EXPECT_EQ(refusal(motor_that_ends("refuse", 0.1)), "") << "it does not get there";
}

// A drive whose torque has not fallen at its last speed: nobody knows how it goes on.
TEST(BeyondTables, ADriveThatEndsAtFullTorqueIsRefusedBeyond) {
  const auto scene = [](double damping) {
    return scene_from(fmt::format(R"(
line = ["motor", "mill"]
motor = {{ kind = "motor", inertia = "1 kg*m2", torque = {{ over = "speed", unit = ["rad/s", "N*m"], points = [[0, 50], [100, 50]] }} }}
mill = {{ kind = "load", damping = "{} N*m*s/rad", inertia = "1 kg*m2" }}
run = {{ until = "60 s" }}
)",
                                  damping));
  };
  EXPECT_EQ(refusal(scene(0.6)), "");
  EXPECT_NE(refusal(scene(0.4)).find("\"motor\": its table of torque ends at"), std::string::npos);
}

// M = k (ω₀ − ω) from a table that ends at ω₀: a weight −M₀ overruns it to ω₀ + M₀/k, within 5 % without a word and with errors,
// further with both.
TEST(BeyondTables, ADriveThatEndsAtItsNoLoadSpeedBrakesBeyond) {
  const double k = 0.5, no_load = 100;
  for (const double over : {0.001, 0.04, 0.08})
    for (const int sense : {1, -1}) {
      const Scene scene =
          scene_from(fmt::format(R"(
line = ["motor", "drum"]
motor = {{ kind = "motor", inertia = "1 kg*m2", torque = {{ over = "speed", unit = ["rad/s", "N*m"], points = [[{}, {}], [{}, {}]] }} }}
drum = {{ kind = "load", acts = "always", torque = "{} N*m", inertia = "1 kg*m2" }}
run = {{ until = "200 s", start = {{ speed = "{} rad/s" }} }}
)",
                                 sense > 0 ? 0 : -no_load, sense > 0 ? k * no_load : 0, sense > 0 ? no_load : 0,
                                 sense > 0 ? 0 : -k * no_load, -sense * k * no_load * over, sense * 90));
      const Result r = run(scene);
      EXPECT_NEAR(figure(r, "final_speed.drum"), sense * no_load * (1 + over), 1e-6) << over;
      EXPECT_EQ(reports(r), over > 0.05) << over;
      EXPECT_EQ(bool(r.find("final_speed.drum")->error), over < 0.05) << over;
    }
}

// λ below its first speed ratio keeps its first value: a start from rest is taken from outside the data.
TEST(BeyondTables, AFluidCouplingBelowItsFirstSpeedRatio) {
  const auto scene = [](const std::string& lambda) {
    return scene_from(fmt::format(R"(
line = ["motor", "fluid", "mill"]
motor = {{ kind = "prescribed speed", speed = "1450 rpm" }}
fluid = {{ kind = "fluid coupling", diameter = "0.25 m", lambda = {{ over = "speed ratio", unit = ["1", "1"], {} }} }}
mill = {{ kind = "load", torque = "5 N*m", inertia = "0.1 kg*m2" }}
run = {{ until = "5 s", start = "rest" }}
)",
                                  lambda));
  };
  const Result whole = run(scene("points = [[0, 0.0021], [0.5, 0.0019], [0.95, 0.0008], [1, 0]]"));
  EXPECT_FALSE(reports(whole));
  EXPECT_TRUE(whole.find("final_speed.mill")->error);
  const Result part = run(scene("points = [[0.5, 0.0019], [0.95, 0.0008], [1, 0]]"));
  EXPECT_TRUE(reports(part));
  EXPECT_FALSE(part.find("final_speed.mill")->error);
  EXPECT_FALSE(reports(run(scene("points = [[0.5, 0.0019], [0.95, 0.0008], [1, 0]], beyond = \"hold\""), false)));
}

// A press whose load is known over `covered` of its 100 mm of travel.
Scene press_known_over(const std::string& covered, const std::string& motor, const std::string& more = "") {
  return scene_from(fmt::format(R"(
line = ["motor", "press"]
motor = {{ kind = {} }}
press = {{ kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "1 kg*m2", slider_mass = "5 kg", load = [{{ kind = "opposing", force = "100 N" }}, {{ kind = "table", force = {{ over = "travel", unit = ["mm", "N"], points = {} }} }}] }}
run = {{ until = "5 s", start = {{ speed = "9 rad/s" }} }}
{})",
                                motor, covered, more));
}
const std::string shunt =
    R"("dc shunt motor", stall_torque = "200 N*m", no_load_speed = "10 rad/s", inertia = "20 kg*m2")";
const std::string part = "[[0, 500], [60, 100]]", held_on = "[[0, 500], [60, 100]], beyond = \"hold\"";

std::string conclusion(const StudyOutput& output) { return output.conclusion(); }
bool says_outside(const std::string& text) { return text.find("outside its table") != std::string::npos; }

// Forces and balancing torque under a load from outside of its table are stated without an error, what the given motion
// alone makes with it; both problems.
TEST(BeyondTables, ForcesUnderALoadFromOutsideHaveNoErrors) {
  for (const auto& [points, outside] : {std::pair(part, true), std::pair(held_on, false)}) {
    const Forces f = find_forces(press_known_over(points, shunt), {});
    ASSERT_TRUE(f.prescribed && f.simulated);
    for (const ForceCycle* cycle : {&*f.prescribed, &*f.simulated}) {
      for (const NamedPeak& reaction : cycle->reactions) EXPECT_EQ(reaction.peak.error.has_value(), !outside) << points;
      for (const Estimate* figure : {static_cast<const Estimate*>(&cycle->torque), &cycle->torque_mean, &cycle->input})
        EXPECT_EQ(figure->error.has_value(), !outside) << points;
    }
    EXPECT_TRUE(f.prescribed->mean_speed.error && f.prescribed->shaking_force.error);
    EXPECT_EQ(f.simulated->mean_speed.error.has_value(), !outside);
    EXPECT_EQ(f.simulated->shaking_force.error.has_value(), !outside);
    const StudyOutput output = output_of(f);
    EXPECT_EQ(says_outside(conclusion(output)), outside) << conclusion(output);
    if (!outside) continue;
    EXPECT_NE(conclusion(output).find("which ends at 0.06 m, and the motion goes to 0.1 m"), std::string::npos)
        << conclusion(output);
    EXPECT_EQ(f.outside_data.size(), 1u) << "once, though both problems leave it";
  }
}

// `modes` names the table outside of which it would linearise, and its end.
TEST(BeyondTables, ASpeedOutsideATableNamesIt) {
  const Scene scene = scene_from(R"(
    line = ["motor", "shaft", "mill"]
    shaft = { kind = "shaft", stiffness = "1 kN*m/rad" }
    mill = { kind = "load", damping = "0.05 N*m*s/rad", inertia = "6 kg*m2" }
    effects = { elasticity = true }
    [motor]
    kind = "motor"
    inertia = "0.4 kg*m2"
    [motor.torque]
    over = "speed"
    unit = ["rpm", "N*m"]
    points = [[0, 600], [1600, 650], [1760, 255], [1796, 31]]
  )");
  EXPECT_EQ(
      find_modes(scene, scene.effects, {.speed = 1800 * rpm}).outside_data,
      std::vector<std::string>{"this speed lies outside the table of torque of \"motor\", which ends at 1796 rpm; "
                               "its slope there is not known"});
  EXPECT_TRUE(find_modes(scene, scene.effects, {.speed = 1700 * rpm}).outside_data.empty());
}

TEST(BeyondTables, ForcesInOtherMechanismsLikewise) {
  for (const char* beyond : {"", ", beyond = \"hold\""}) {
    const Scene scene = scene_from(fmt::format(R"(
line = ["motor", "saw"]
motor = {{ kind = {} }}
saw = {{ kind = "four-bar", crank = "0.1 m", coupler = "0.4 m", rocker = "0.3 m", ground = "0.45 m", crank_inertia = "1 kg*m2", coupler_mass = "1 kg", load = {{ kind = "table", torque = {{ over = "swing", unit = ["deg", "N*m"], points = [[0, 20], [5, 10]]{} }} }} }}
run = {{ until = "5 s", start = {{ speed = "9 rad/s" }} }}
)",
                                               shunt, beyond));
    const Forces f = find_forces(scene, {});
    ASSERT_TRUE(f.prescribed && f.simulated);
    const bool outside = *beyond == 0;
    for (const ForceCycle* cycle : {&*f.prescribed, &*f.simulated}) {
      EXPECT_EQ(cycle->reactions.front().peak.error.has_value(), !outside);
      EXPECT_EQ(cycle->torque.error.has_value(), !outside);
    }
    EXPECT_TRUE(f.prescribed->links.front().inertia_force.error);
    EXPECT_EQ(f.simulated->links.back().inertia_force.error.has_value(), !outside);
    EXPECT_EQ(says_outside(conclusion(output_of(f))), outside);
  }
}

// The motor's table ends below the speed that the machine keeps: the crank's given motion does not ask it.
TEST(BeyondTables, ForcesOfAGivenMotionDependOnNoMotor) {
  const Scene scene = press_known_over(
      held_on,
      R"("motor", inertia = "20 kg*m2", torque = { over = "speed", unit = ["rad/s", "N*m"], points = [[0, 200], [8, 100]] })");
  const Forces f = find_forces(scene, {});
  ASSERT_TRUE(f.prescribed && f.simulated);
  EXPECT_TRUE(f.prescribed->torque.error);
  EXPECT_GT(f.simulated->mean_speed.value, 8);
  EXPECT_FALSE(f.simulated->torque.error);
  EXPECT_TRUE(says_outside(conclusion(output_of(f))));
}

// A load that the operating sequence leaves off needs nothing.
TEST(BeyondTables, ALoadThatIsOffIsTakenFromNowhere) {
  const Scene off =
      press_known_over(part, shunt, R"(sequence = { steps = [{ at = "0 s", set = "press.load2", to = 0 }] })");
  const Forces f = find_forces(off, {});
  ASSERT_TRUE(f.prescribed && f.simulated);
  EXPECT_TRUE(f.outside_data.empty()) << f.outside_data.front();
  EXPECT_TRUE(f.prescribed->torque.error && f.simulated->torque.error);
  EXPECT_FALSE(reports(run(off)));
  EXPECT_TRUE(reports(run(press_known_over(part, shunt))));
}

TEST(BeyondTables, ReducedTorquesFromOutsideHaveNoErrors) {
  for (const auto& [points, outside] : {std::pair(part, true), std::pair(held_on, false)}) {
    const MachineReduction r = reduce(press_known_over(points, shunt), {});
    EXPECT_EQ(r.basis, CycleBasis::classical);
    EXPECT_EQ(r.mean_load.error.has_value(), !outside);
    EXPECT_EQ(r.load_error.has_value(), !outside);
    EXPECT_TRUE(r.inertia_error) << "no torque is in it";
    EXPECT_TRUE(r.spectra.front().harmonics.front().amplitude.error);
    EXPECT_EQ(r.spectra.back().harmonics.front().amplitude.error.has_value(), !outside);
    EXPECT_EQ(says_outside(conclusion(output_of(r))), outside) << conclusion(output_of(r));
  }
  ReduceOptions options;
  options.basis = CycleBasis::steady;
  const MachineReduction r = reduce(press_known_over(part, shunt), options);
  EXPECT_FALSE(r.mean_load.error || r.inertia_error);
  EXPECT_TRUE(says_outside(conclusion(output_of(r))));
  // At a speed that is given beyond a motor's table.
  const std::string table =
      R"("motor", inertia = "20 kg*m2", torque = { over = "speed", unit = ["rad/s", "N*m"], points = [[0, 200], [12, 100]] })";
  for (const double speed : {11.0, 13.0}) {
    ReduceOptions given;
    given.speed = speed;
    EXPECT_EQ(reduce(press_known_over(held_on, table), given).outside_data.empty(), speed < 12) << speed;
  }
}

// A law of the operating sequence that has ended, as the brake that gives way along it, is taken from outside: by the run from
// there on, and by the steady motion that follows. One that is followed by another step is not.
TEST(BeyondTables, ALawOfTheSequenceThatHasEndedIsReported) {
  const auto scene = [](const std::string& how, const std::string& more = "") {
    return scene_from(fmt::format(R"(
line = ["motor", "brake"]
motor = {{ kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", inertia = "0.5 kg*m2" }}
brake = {{ kind = "brake", torque = "100 N*m" }}
run = {{ until = "4 s" }}
[sequence]
steps = [{{ at = "0.5 s", set = "brake", law = {{ over = "time", unit = ["s", "1"], points = [[0, 1], [1, 0.2]]{} }} }}{}]
)",
                                  how, more));
  };
  const std::string released = R"(, { at = "1.5 s", set = "brake", to = 0.2 })";
  for (const auto& [how, more, outside] : {std::tuple("", "", true), std::tuple(", beyond = \"hold\"", "", false),
                                           std::tuple("", released.c_str(), false)}) {
    const Scene one = scene(how, more);
    const Result r = run(one);
    EXPECT_EQ(reports(r), outside) << how << more;
    EXPECT_EQ(r.find("final_speed.motor")->error.has_value(), !outside) << how << more;
    const SteadyStudy study = steady(one, {one.effects}, {.start_search = false});
    ASSERT_TRUE(study.complete) << study.diagnosis;
    const Figure* mean = study.cycles.front().find("mean_speed." + study.link);
    ASSERT_NE(mean, nullptr);
    EXPECT_NEAR(mean->value, 40 * (1 - 20 / 60.0), 1e-8);
    EXPECT_EQ(mean->error.has_value(), !outside) << how << more;
  }
  EXPECT_EQ(refusal(scene(", beyond = \"refuse\"")).substr(0, 36), "7: \"brake\": its table of law ends at");
  Scene brief = scene("");
  brief.run.until = 1.4;
  EXPECT_FALSE(reports(run(brief)));
  try {
    scene(", beyond = \"line\"");
    FAIL() << "read";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("would leave −1 … 10"), std::string::npos) << error.what();
  }
}

// Random drives and loads by table over speed and time, against what the trajectory itself shows.
TEST(BeyondTables, OfRandomMachinesEachLeavingIsReportedAndNoOther) {
  std::mt19937 random(41);
  std::uniform_real_distribution<double> part(0.2, 1);
  int left = 0;
  for (int i = 0; i < 30; ++i) {
    const double last = 100 * part(random), torque = 60 * part(random), rest = 30 * (part(random) - 0.2);
    const double ends = 8 * part(random);
    const Scene scene = scene_from(fmt::format(R"(
line = ["motor", "mill"]
motor = {{ kind = "motor", inertia = "1 kg*m2", torque = {{ over = "speed", unit = ["rad/s", "N*m"], points = [[0, {}], [{}, {}]] }} }}
mill = {{ kind = "load", damping = "{} N*m*s/rad", inertia = "1 kg*m2", table = {{ over = "time", unit = ["s", "N*m"], points = [[0, 0], [{}, 2]] }} }}
run = {{ until = "5 s", accuracy = 1e-6 }}
)",
                                               torque + rest, last, rest, part(random), ends));
    const Result r = run(scene);
    ASSERT_TRUE(r.complete) << r.diagnosis;
    const double greatest = figure(r, "max_speed.motor");
    const bool beyond = greatest > last * (1 + 1e-6) || ends < 5;
    EXPECT_EQ(reports(r), beyond) << scene.text;
    EXPECT_EQ(r.find("final_speed.motor")->error.has_value(), !beyond) << scene.text;
    left += beyond;
  }
  EXPECT_GT(left, 5);
  EXPECT_LT(left, 28) << "or the test proves nothing";
}

// Every scene of the tree: a table that its trajectory leaves is reported.
TEST(BeyondTables, OfAllScenesEachLeavingIsReported) {
  int watched = 0;
  for (const auto& entry : fs::directory_iterator(source_path("scenes"))) {
    if (entry.path().extension() != ".toml") continue;
    Scene scene = read_scene(entry.path().string(), all_kinds());
    scene.run.until = std::min(scene.run.until, 3.0);
    const auto model = compile(scene, scene.effects);
    if (model->network.ranges.empty()) continue;
    SimulateOptions bare;
    bare.measure_error = false;
    const Result r = simulate(model, "test", bare);
    bool beyond = false;
    for (const Network::DataRange& range : model->network.ranges) {
      const std::string channel =
          range.over == Network::DataRange::Over::channel ? range.channel : "speed." + range.component;
      for (std::size_t c = 0; c < r.trajectory->channels().size(); ++c) {
        if (r.trajectory->channels()[c].name.text != channel) continue;
        ++watched;
        for (std::size_t row = 0; row < r.trajectory->time().size(); ++row) {
          const double value = r.trajectory->value(row, c);
          const double x = range.over == Network::DataRange::Over::channel ? range.offset + range.sign * value : value;
          const double slack = 1e-6 * (range.high - range.low);
          beyond = beyond || (x < range.low - slack && range.below == Beyond::unspecified) ||
                   (x > range.high + slack && range.above == Beyond::unspecified);
        }
      }
    }
    EXPECT_TRUE(reports(r) || !beyond) << entry.path();
  }
  EXPECT_GT(watched, 5);
}

}  // namespace
}  // namespace kurbel::test::beyond_tables_test
