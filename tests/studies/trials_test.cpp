// trials_test.cpp — a trial says what the run with the effect switched on by hand says, and nothing of the run changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "studies/run/run_findings.h"
#include "studies/trials/trials_findings.h"
#include "tests/support/scenes.h"

namespace kurbel::trials_test {
namespace {

SimulateOptions quick() { return {.measure_error = true, .method = {}, .accuracy = 1e-5, .until = {}}; }

WithTrials<Result> tried(const Scene& scene, const Effects& effects, const SimulateOptions& options = quick()) {
  return with_trials(simulate(scene, effects, "test", options), options);
}

// motor ── gearbox i = 4, η = 0.9 ── load M at constant torque; both run steadily.
//     without losses  M_motor = M/i;   with them  M_motor = M/(i η)
const char* const geared = R"(
  line = ["motor", "input", "gears", "drum"]
  motor = { kind = "dc shunt motor", stall_torque = "400 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2" }
  input = { kind = "coupling", stiffness = "50 kN*m/rad" }
  gears = { kind = "gearbox", stages = [{ teeth = [20, 80] }], efficiency = 0.9 }
  drum = { kind = "flywheel", inertia = "20 kg*m2" }
  work = { kind = "load", on = "drum", torque = "360 N*m" }
  effects = { gear_losses = LOSSES }
  run = { until = "6 s", accuracy = 1e-6, start = { speed = "19 rad/s" } }
)";
Scene geared_scene(bool losses) {
  std::string text = geared;
  text.replace(text.find("LOSSES"), 6, losses ? "true" : "false");
  return test::scene_from(text);
}
const Trial* trial_of(const Trials& trials, const std::string& effect) {
  for (const Trial& trial : trials.tried)
    if (trial.effect.name == effect) return &trial;
  return nullptr;
}

// A shunt motor's speed falls in proportion to its torque: ω = ω₀ (1 − M/M_s).
TEST(Trials, LossesOfAGearSlowAShuntMotorByWhatItGivesMore) {
  const auto found = tried(geared_scene(false), geared_scene(false).effects);
  const Trial* losses = trial_of(found.trials, "gear_losses");
  ASSERT_NE(losses, nullptr);
  ASSERT_TRUE(losses->failed.empty()) << losses->failed;
  const auto speed = [](double torque) { return 100 * (1 - torque / 400) / 4; };
  const double off = speed(360.0 / 4), on = speed(360.0 / (4 * 0.9));
  const double run = test::figure(found.study, "final_speed.drum"),
               trial = test::figure(losses->result, "final_speed.drum");
  EXPECT_NEAR(run, off, 1e-4 * off);
  EXPECT_NEAR(trial, on, 1e-4 * on);
}

// Behind an elastic run the rigid machine is the one of `compare`, to the last digit, and its curves stand behind.
TEST(Trials, TheRigidMachineIsTheOneOfCompare) {
  Scene scene = geared_scene(true);
  EXPECT_FALSE(tried(scene, scene.effects).trials.rigid);  // is rigid itself
  scene.effects.all_elastic = true;
  SimulateOptions drawn = quick();
  drawn.traces = true;
  const auto found = tried(scene, scene.effects, drawn);
  ASSERT_TRUE(found.trials.rigid);
  const Trial& rigid = *found.trials.rigid;
  ASSERT_TRUE(rigid.failed.empty()) << rigid.failed;
  const Comparison both = compare(scene, models_to_compare(scene, scene.effects), quick());
  ASSERT_FALSE(rigid.changes.empty());
  for (const TrialChange& c : rigid.changes) {
    if (c.gone) continue;
    EXPECT_EQ(c.change.without, test::figure(both.a, c.change.figure)) << c.change.figure;
    EXPECT_EQ(c.change.full, test::figure(both.b, c.change.figure)) << c.change.figure;
  }
  for (const Plot& plot : motion_plots({&rigid.result, &found.study})) {
    if (plot.series.size() != 2 || plot.title.find("Torque in") == std::string::npos) continue;
    EXPECT_EQ(plot.series[0].role, Role::rigid) << plot.title;
    EXPECT_EQ(plot.series[1].role, Role::elastic) << plot.title;
    return;
  }
  ADD_FAILURE() << "no torque of both";
}

TEST(Trials, NothingIsTriedWhereNothingIsOff) {
  Scene scene = geared_scene(true);
  scene.effects.all_elastic = true;
  const auto found = tried(scene, scene.effects);
  EXPECT_TRUE(found.trials.tried.empty());
  EXPECT_TRUE(found.trials.not_tried.empty());
  EXPECT_TRUE(words_of(found.trials, {}).empty());
  EXPECT_EQ(json_text(summary_of(findings_of(found))).find("\"trials\""), std::string::npos);
}

class TrialsOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, TrialsOf, testing::Values("crank_press", "worm_hoist", "gear_pair", "dc_hoist"),
                         [](const auto& info) { return info.param; });

// To the last digit, for each figure; and the run itself is what it is without them.
TEST_P(TrialsOf, ATrialIsTheRunWithTheEffectSetByHand) {
  Scene scene = test::scene_file("scenes/" + std::string(GetParam()) + ".toml");
  scene.run.until = std::min(scene.run.until, 0.3);
  Effects on = bare_machine(scene.effects);
  SimulateOptions options = quick();
  options.measure_error = false;
  const Result alone = simulate(scene, on, "test", options);
  const auto found = tried(scene, on, options);
  ASSERT_EQ(found.study.figures.size(), alone.figures.size());
  for (std::size_t k = 0; k < alone.figures.size(); ++k)
    EXPECT_EQ(found.study.figures[k].value, alone.figures[k].value) << alone.figures[k].name;
  ASSERT_FALSE(found.trials.tried.empty());
  for (const Trial& trial : found.trials.tried) {
    if (!trial.failed.empty()) continue;
    const Result by_hand = simulate(scene, trial.effect.effects, "by hand", options);
    for (const TrialChange& c : trial.changes) {
      if (c.gone) continue;
      const Figure* figure = like_in(by_hand, *alone.find(c.change.figure));
      ASSERT_NE(figure, nullptr) << c.change.figure;
      EXPECT_EQ(figure->value, c.change.without) << trial.effect.name << ": " << c.change.figure;
    }
  }
}

// What goes on from a state, was interrupted or took long has none, and says why.
TEST(Trials, WhatIsNotTriedIsNamedWithItsReason) {
  const Scene scene = geared_scene(false);
  Result run = simulate(scene, scene.effects, "test", quick());
  SimulateOptions options = quick();
  const std::atomic<bool> interrupted = true;
  options.watch.interrupted = &interrupted;
  const Trials stopped = try_effects(run, {"final_speed.drum"}, options);
  EXPECT_TRUE(stopped.tried.empty());
  ASSERT_EQ(stopped.not_tried.size(), 2u);
  EXPECT_EQ(stopped.not_tried[0].because, "interrupted");
  run.cpu_total = 2 * longest_run;
  const Trials late = try_effects(run, {"final_speed.drum"}, quick());
  EXPECT_TRUE(late.tried.empty());
  ASSERT_EQ(late.not_tried.size(), 2u);
  EXPECT_NE(late.not_tried[1].because.find("processor time"), std::string::npos);
}

}  // namespace
}  // namespace kurbel::trials_test
