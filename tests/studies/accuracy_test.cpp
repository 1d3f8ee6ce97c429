// accuracy_test.cpp — what accuracy costs: errors fall with the tolerance, references are right, answers hold.
#include "studies/accuracy/accuracy.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "studies/accuracy/known_accuracy.h"
#include "studies/report/render.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"
#include "tests/support/thorough.h"

namespace kurbel::accuracy_test {
namespace {

TEST(ParetoFront, KeepsWhatNothingBeatsInErrorAndTime) {
  //                                   slow and exact, beaten, cheap, no answer, hardly better than the first
  const std::vector<double> error = {1e-6, 1e-3, 1e-2, std::nan(""), 0.95e-6}, seconds = {3, 2, 1, 0.5, 4};
  EXPECT_EQ(pareto_front(error, seconds), (std::vector<std::size_t>{2, 1, 0}));
  EXPECT_EQ(pareto_front({1e-3, 1e-4}, {1, 1}), (std::vector<std::size_t>{1}));
}

AccuracyOptions coarse() {
  AccuracyOptions options;
  options.tolerances = {1e-4, 1e-6, 1e-8, 1e-10};
  options.methods = {"dop853", "verner6"};
  options.multibody = false;
  options.most_repetitions = 1;
  options.time = 60;
  return options;
}

// Up to the floor, which is what the references agree to. Where no step may turn a mechanism by more than a quarter,
// loose tolerances take the very same steps, and the error stays; luck within a rung may double it, no more.
class ErrorFalls : public testing::TestWithParam<std::string> {};

TEST_P(ErrorFalls, WithTheToleranceOnEveryLevel) {
  Scene scene = test::scene_file("scenes/" + GetParam() + ".toml");
  scene.run.until = std::min(scene.run.until, GetParam().find("engine") == std::string::npos ? 2.0 : 0.4);
  static const std::map<std::string, double> short_form = {{"gear_test_rig", 0.25},  {"hydraulic_winch", 0.7},
                                                           {"air_motor_mixer", 0.7}, {"ship_propulsion", 0.7},
                                                           {"planetary_brake", 1},   {"diesel_generator", 0.7}};
  if (const auto dear = short_form.find(GetParam()); dear != short_form.end() && !test::thorough())
    scene.run.until = dear->second;
  if (scene.effects.joint_clearance || scene.effects.flexible_rod) scene.run.until *= 0.3;
  const AccuracyStudy study = measure_accuracy(scene, coarse());
  ASSERT_TRUE(study.complete) << study.diagnosis;
  ASSERT_FALSE(study.settings.empty());
  for (std::size_t level = 0; level < study.levels.size(); ++level) {
    const double floor = study.levels[level].agreement;
    EXPECT_LT(floor, 1e-7) << study.levels[level].name;
    if (study.levels[level].name == "energy method") continue;  // has no tolerance
    for (const char* method : {"dop853", "verner6"}) {
      double first = 0, before = HUGE_VAL;
      for (const MeasuredSetting& s : study.settings) {
        if (s.level != level || s.method != method) continue;
        EXPECT_GE(s.trajectory_error, floor) << study.name_of(s);
        EXPECT_LE(s.trajectory_error, std::max(2 * before, 10 * floor)) << study.name_of(s);
        if (first == 0) first = s.trajectory_error;
        before = s.trajectory_error;
      }
      // 1e-4 → 1e-10: to a hundredth at least, unless it was within 100 × the tightest tolerance all along.
      EXPECT_LE(before, std::max({0.01 * first, 10 * floor, 1e-8})) << study.levels[level].name << " " << method;
    }
  }
}
std::vector<std::string> example_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_path("scenes")))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}
INSTANTIATE_TEST_SUITE_P(Accuracy, ErrorFalls, testing::ValuesIn(example_scenes()),
                         [](const auto& info) { return info.param; });

// tests/cases/reference.toml, R1 and E1: twelve digits by other means.
TEST(Accuracy, ReferencesAgreeWithPublishedDigitsAndStateAnHonestAgreement) {
  AccuracyOptions options = coarse();
  options.figures = {"final_angle.crank"};
  const AccuracyStudy crank = measure_accuracy(test::scene_file("scenes/free_slider_crank.toml"), options);
  const double turned = 294.719373652657;
  EXPECT_NEAR(crank.levels[0].value[0], turned, 1e-11 * turned);
  // The energy method's motion is that of the rigid model.
  bool seen = false;
  for (const MeasuredSetting& s : crank.settings)
    if (s.method == "work diagram") {
      seen = true;
      EXPECT_LT(s.trajectory_error, 1e-9);
    }
  EXPECT_TRUE(seen);

  options.figures = {"peak_spring_torque.c1"};
  const AccuracyStudy chain = measure_accuracy(test::scene_file("scenes/six_inertia_chain.toml"), options);
  EXPECT_NEAR(std::abs(chain.levels[chain.fullest].value[0]), 290.808843395416, 1e-10 * 290.8);
}

TEST(Accuracy, AnswersHoldAndTheModelsErrorIsReported) {
  AccuracyOptions options = coarse();
  options.within = 0.03;
  options.budget = 1e3;
  Scene scene = test::scene_file("scenes/crank_press.toml");
  scene.run.until = 2;
  const AccuracyStudy study = measure_accuracy(scene, options);
  ASSERT_EQ(study.answers.size(), 2u);
  // Above the scene's own effects stands what it has parameters for and leaves off; by that all are judged.
  EXPECT_EQ(study.levels[study.own].name, "elastic");
  EXPECT_EQ(study.levels[study.own].effects, scene.effects.describe());
  EXPECT_EQ(study.levels[study.fullest].name, "with joint friction");
  EXPECT_GT(study.levels[study.own].model_error[study.key], 1e-3);
  EXPECT_LT(study.levels[study.own].model_error[study.key], 3e-2);
  for (std::size_t level = 0; level <= study.fullest; ++level) EXPECT_GT(study.levels[level].seconds, 0);
  EXPECT_TRUE(study.answers[0].starts_with("Cheapest within 3 % of peak_torque.main_coupling: elastic, "))
      << study.answers[0];
  // Unlimited time buys the setting with the least error of all.
  double least = HUGE_VAL;
  std::string best;
  for (const MeasuredSetting& s : study.settings)
    if (s.total_error[study.key] < least) least = s.total_error[study.key], best = study.name_of(s);
  EXPECT_NE(study.answers[1].find(best), std::string::npos) << study.answers[1] << " but " << best;
  // The rigid model knows no ringing: tightening its tolerance cannot help.
  ASSERT_EQ(study.levels[0].name, "rigid");
  EXPECT_GT(study.levels[0].model_error[study.key], 0.09);
  for (const MeasuredSetting& s : study.settings)
    EXPECT_TRUE(s.level > 0 || s.total_error[study.key] > 0.09) << study.name_of(s);
  EXPECT_TRUE(std::any_of(study.findings.begin(), study.findings.end(),
                          [](const std::string& f) { return f.find("whatever its tolerance") != std::string::npos; }));
  // What is printed, written and drawn holds every setting.
  const StudyOutput output = output_of(study);
  const auto json = nlohmann::json::parse(output.json());
  EXPECT_EQ(json["settings"].size(), study.settings.size());
  // Programs get every answer; on a terminal the conclusion is not said again.
  EXPECT_EQ(json["answers"].size(), study.answers.size());
  const std::string text = output.text();
  for (const std::string& sentence : study.answers) {
    const std::string whole = readable(sentence), begin = whole.substr(0, whole.find(':'));
    const std::size_t said = text.find(begin);
    EXPECT_NE(said, std::string::npos) << begin;
    EXPECT_EQ(text.find(begin, said + 1), std::string::npos) << begin << " is said twice";
  }
  EXPECT_EQ(json["models"].size(), study.levels.size());
  const std::string page = html_of(output.report());
  EXPECT_NE(page.find("Total error and processor time"), std::string::npos);
  EXPECT_NE(page.find("verner6 at 1e-08"), std::string::npos);
}

// A run that is set to do so takes the cheapest setting that the study found exact enough, and refuses what is of
// another text or model.
TEST(KnownAccuracy, PicksTheCheapestSettingThatIsExactEnough) {
  Scene scene = test::scene_file("scenes/six_inertia_chain.toml");
  const AccuracyStudy study = measure_accuracy(scene, coarse());
  ASSERT_TRUE(study.complete) << study.diagnosis;
  const test::ScratchFolder folder;
  const auto summary = folder / "summary.json";
  std::ofstream(summary) << output_of(study).json();
  double last = 0;
  for (const double accuracy : {1e-3, 1e-5, 1e-6}) {
    const KnownSetting known = known_setting(summary, scene, scene.effects, accuracy);
    EXPECT_LE(known.error, accuracy);
    EXPECT_GE(known.seconds, last);
    last = known.seconds;
    for (const MeasuredSetting& s : study.settings) {
      if (study.levels[s.level].effects != scene.effects.describe()) continue;
      double error = s.trajectory_error;
      for (std::size_t i = 0; i < s.numerical_error.size(); ++i)
        if (s.numerical_error[i] > study.levels[s.level].floor[i]) error = std::max(error, s.numerical_error[i]);
      EXPECT_TRUE(error > accuracy || s.seconds >= known.seconds) << study.name_of(s);
    }
    SimulateOptions options{.method = known.method, .accuracy = accuracy, .until = {}};
    options.first_tolerance = known.tolerance;
    options.chosen_because = known.describe();
    const Result r = simulate(scene, scene.effects, "known", options);
    EXPECT_TRUE(r.accuracy_confirmed);
    EXPECT_NE(std::find(r.notes.begin(), r.notes.end(), known.describe()), r.notes.end());
  }
  const auto refused = [&](const std::filesystem::path& file, double accuracy, const std::string& because) {
    try {
      known_setting(file, scene, scene.effects, accuracy);
      ADD_FAILURE() << "took " << file;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(because), std::string::npos) << error.what();
      EXPECT_TRUE(std::string(error.what()).starts_with(file.string())) << error.what();
    }
  };
  refused(summary, 1e-16, "no setting had an error of 1.0e-16 or less, the least was ");
  refused(folder / "absent.json", 1e-3, "no such file");
  refused(folder, 1e-3, "is a folder");
  std::ofstream(folder / "torn.json") << "{\n  \"fingerprint\": \"12\",\n  \"settings\" [\n";
  refused(folder / "torn.json", 1e-3, "torn.json:3:14: --setting: is no JSON here");
  std::ofstream(folder / "foreign.json") << "{\"figures\": []}";
  refused(folder / "foreign.json", 1e-3, "is no summary of kurbel accuracy");
  std::string method = output_of(study).json();
  for (std::size_t at = 0; (at = method.find("\"dop853\"", at)) != std::string::npos;)
    method.replace(at, 8, "\"dop835\"");
  for (std::size_t at = 0; (at = method.find("\"verner6\"", at)) != std::string::npos;)
    method.replace(at, 9, "\"dop835\"");
  std::ofstream(folder / "edited.json") << method;
  refused(folder / "edited.json", 1e-3, "did you mean \"dop853\"");
  scene.text += "\n# changed";
  refused(summary, 1e-3, "was measured of another scene");
}

TEST(Accuracy, WhatDoesNotApplyIsNamedWithItsReason) {
  AccuracyOptions options = coarse();
  options.methods = {"work", "fehlberg8", "dop853"};
  Scene scene = test::scene_file("scenes/crank_press.toml");
  scene.run.until = 0.5;
  const AccuracyStudy press = measure_accuracy(scene, options);
  EXPECT_TRUE(std::any_of(press.omissions.begin(), press.omissions.end(), [](const Omission& o) {
    return o.what == "energy method" && o.why.find("depends on the speed") != std::string::npos;
  }));
  const AccuracyStudy driven = measure_accuracy(test::scene_from(R"(
line = ["motor", "disc"]
motor = { kind = "torque source", torque = "3 N*m", amplitude = "10 N*m", frequency = "2 Hz" }
disc = { kind = "flywheel", inertia = "1 kg*m2" }
run = { until = "1 s" }
)"),
                                                options);
  EXPECT_TRUE(std::any_of(driven.omissions.begin(), driven.omissions.end(), [](const Omission& o) {
    return o.what == "rigid, fehlberg8" && o.why.find("misses") != std::string::npos;
  }));
  EXPECT_THROW(
      {
        options.figures = {"peak_torque.nothing"};
        measure_accuracy(scene, options);
      },
      std::invalid_argument);
}

}  // namespace
}  // namespace kurbel::accuracy_test
