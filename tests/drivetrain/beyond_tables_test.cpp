// beyond_tables_test.cpp — what a motion takes from beyond the end of a table is told, and has no error bar.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

#include "engine/scene/messages.h"
#include "studies/report/render.h"
#include "studies/run/run_findings.h"
#include "studies/steady/steady.h"
#include "studies/validity/outside_data.h"
#include "tests/support/scenes.h"

namespace kurbel::test::beyond_tables_test {
namespace {

namespace fs = std::filesystem;
constexpr double rpm = std::numbers::pi / 30;

bool tells(const Result& r) {
  return std::any_of(r.answers.begin(), r.answers.end(), [](const Answer& a) {
    return a.topic == Topic::sure && a.sentence.find("outside its table") != std::string::npos;
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
  const StudyOutput output = rendered(findings_of(study));
  EXPECT_NE(output.json.find("outside its table, which ends at 1796 rpm"), std::string::npos);

  const Result r = run(scene);
  EXPECT_TRUE(tells(r));
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
    EXPECT_FALSE(tells(run(scene, false))) << word;
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
  EXPECT_FALSE(tells(whole));
  EXPECT_TRUE(whole.find("final_speed.mill")->error);
  const Result part = run(scene("points = [[0.5, 0.0019], [0.95, 0.0008], [1, 0]]"));
  EXPECT_TRUE(tells(part));
  EXPECT_FALSE(part.find("final_speed.mill")->error);
  EXPECT_FALSE(tells(run(scene("points = [[0.5, 0.0019], [0.95, 0.0008], [1, 0]], beyond = \"hold\""), false)));
}

// Random drives and loads by table over speed and time, against what the trajectory itself shows.
TEST(BeyondTables, OfRandomMachinesEachLeavingIsToldAndNoOther) {
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
    EXPECT_EQ(tells(r), beyond) << scene.text;
    EXPECT_EQ(r.find("final_speed.motor")->error.has_value(), !beyond) << scene.text;
    left += beyond;
  }
  EXPECT_GT(left, 5);
  EXPECT_LT(left, 28) << "or the test proves nothing";
}

// Every scene of the tree: a table that its trajectory leaves is told of.
TEST(BeyondTables, OfAllScenesEachLeavingIsTold) {
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
          beyond = beyond || (x < range.low - slack && range.below == Beyond::unsaid) ||
                   (x > range.high + slack && range.above == Beyond::unsaid);
        }
      }
    }
    EXPECT_TRUE(tells(r) || !beyond) << entry.path();
  }
  EXPECT_GT(watched, 5);
}

}  // namespace
}  // namespace kurbel::test::beyond_tables_test
