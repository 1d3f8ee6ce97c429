// static_curve_test.cpp — a static torque-speed curve holds for slow changes; where a drive oscillates faster, it lags
// by the fluxes, which every study says, and one that may not lag is said to be too fast.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "studies/accuracy/accuracy.h"
#include "studies/advise/advise.h"
#include "studies/effects/effect_study.h"
#include "studies/run/compare.h"
#include "studies/run/run_findings.h"
#include "studies/size/size.h"
#include "studies/steady/steady.h"
#include "tests/support/scenes.h"

namespace kurbel::static_curve_test {
namespace {

// The crank press, with keys put into its motor; its torque lags.
Scene lagging_press_with(const std::string& motor_keys) {
  const std::string place = "breakdown_ratio   = 3.0";
  std::string text = test::scene_file("scenes/crank_press.toml").text;
  const std::size_t at = text.find(place);
  EXPECT_NE(at, std::string::npos);
  Scene scene = test::scene_from(text.replace(at, place.size(), place + "\n" + motor_keys));
  scene.run.until = 2;
  return scene;
}

// On its curve alone.
Scene press_with(const std::string& motor_keys) {
  Scene scene = lagging_press_with(motor_keys);
  scene.effects.torque_lag = false;
  return scene;
}

std::string note_of(const Result& result) {
  const auto found = std::find_if(result.notes.begin(), result.notes.end(), [](const std::string& note) {
    return note.find("static torque-speed curve") != std::string::npos;
  });
  return found == result.notes.end() ? "" : *found;
}

double peak_ratio(const Scene& scene) {
  const ModelPair pair = models_to_compare(scene);
  SimulateOptions options;
  options.measure_error = false;
  const Comparison c = compare(scene, pair, options);
  return test::figure(c.b, "peak_torque.main_coupling") / test::figure(c.a, "peak_torque.main_coupling");
}

TEST(StaticCurve, ringing_at_a_third_of_the_mains_frequency_is_reported_to_be_too_fast) {
  const std::string note = note_of(test::run(press_with(""), false));
  EXPECT_NE(note.find("% of the mains' 50 Hz"), std::string::npos) << note;
  EXPECT_NE(note.find("frequency = \"50 Hz\""), std::string::npos) << note;
}

TEST(StaticCurve, a_scene_with_the_data_of_two_axes_is_reported_to_switch_them_on) {
  Scene scene = press_with("frequency = \"50 Hz\"\nresistance_ratio = 1");
  scene.effects.transients = false;
  const std::string note = note_of(test::run(scene, false));
  EXPECT_NE(note.find("--effects with transients"), std::string::npos) << note;
}

TEST(StaticCurve, the_two_axis_motor_needs_no_warning) {
  Scene scene = press_with("frequency = \"50 Hz\"\nresistance_ratio = 1");
  scene.effects.transients = true;
  EXPECT_EQ(note_of(test::run(scene, false)), "");
}

TEST(StaticCurve, with_the_lag_of_the_fluxes_needs_no_warning) {
  EXPECT_EQ(note_of(test::run(lagging_press_with(""), false)), "");
}

TEST(StaticCurve, a_start_without_swings_needs_no_warning) {
  const char* fan = R"(
line  = ["motor", "fan"]
motor = { kind = "induction motor", rated_power = "15 kW", rated_speed = "1460 rpm", synchronous_speed = "1500 rpm", breakdown_ratio = 3, inertia = "0.1 kg*m2" }
fan   = { kind = "flywheel", inertia = "2 kg*m2" }
run   = { until = "5 s" }
)";
  EXPECT_EQ(note_of(test::run(fan, false)), "");
}

// One sentence, whoever says it; people, page and programs get it.
void expect_reported(const char* verb, const StudyOutput& output) {
  const std::string begin = "the drive \"motor\" oscillates at about", end = "too fast for the curve";
  for (const std::string& text : {output.text(), output.json()}) {
    // In JSON its quotation marks are escaped.
    EXPECT_NE(text.find("oscillates at about"), std::string::npos) << verb;
    EXPECT_NE(text.find("static torque-speed curve makes its torque oscillate"), std::string::npos) << verb;
    EXPECT_NE(text.find(end), std::string::npos) << verb;
  }
  EXPECT_NE(output.text().find(begin), std::string::npos) << verb;
}

// Which model the motor has, and why.
void expect_lag_reported(const char* verb, const StudyOutput& output) {
  for (const std::string& text : {output.text(), output.json()})
    EXPECT_NE(text.find("lag of the fluxes"), std::string::npos) << verb;
}

SimulateOptions quick() {
  SimulateOptions options;
  options.measure_error = false;
  return options;
}

TEST(StaticCurve, is_judged_in_the_steady_motion) {
  const Scene scene = press_with("");
  SteadyOptions options;
  options.start_search = false;
  expect_reported("steady", output_of(steady(scene, {scene.effects}, options)));
  const Scene lagging = lagging_press_with("");
  expect_lag_reported("steady", output_of(steady(lagging, {lagging.effects}, options)));
  Scene two_axes = press_with("frequency = \"50 Hz\"\nresistance_ratio = 1");
  two_axes.effects.transients = true;
  for (const std::string& note : steady(two_axes, {two_axes.effects}, options).notes)
    EXPECT_EQ(note.find("static torque-speed curve"), std::string::npos);
}

TEST(StaticCurve, is_judged_in_the_motion_of_the_sized_machine) {
  SizeOptions options;
  options.delta = 0.05;
  expect_reported("size", output_of(size_flywheel(press_with(""), options)));
  expect_lag_reported("size", output_of(size_flywheel(lagging_press_with(""), options)));
}

TEST(StaticCurve, is_judged_where_models_are_compared) {
  const Scene scene = press_with("");
  expect_reported("compare", output_of(compare(scene, models_to_compare(scene), quick())));
  const Scene lagging = lagging_press_with("");
  expect_lag_reported("compare", output_of(compare(lagging, models_to_compare(lagging), quick())));
}

// The full model has the lag, whatever the scene has.
TEST(StaticCurve, lags_in_the_full_model_of_effects_and_advice) {
  const Scene scene = press_with("");
  expect_lag_reported("effects", output_of(study_effects(scene, quick())));
  AdviseOptions options;
  options.simulate = quick();
  options.within = 0.05;
  options.held_out = false;
  expect_lag_reported("advise", output_of(advise(scene, options)));
}

TEST(StaticCurve, lags_on_the_fullest_level_of_accuracy) {
  AccuracyOptions options;
  options.time = 10;
  options.tolerances = {1e-5};
  options.multibody = false;
  Scene scene = press_with("");
  scene.run.until = 1;
  expect_lag_reported("accuracy", output_of(measure_accuracy(scene, options)));
}

// What docs/how_it_works.md says of the motor's models.
TEST(StaticCurve, the_press_amplifies_as_its_motors_fluxes_let_it) {
  EXPECT_NEAR(peak_ratio(press_with("")), 3.05, 0.005);
  EXPECT_NEAR(peak_ratio(press_with("starting_ratio = 2.5")), 1.98, 0.005);
  EXPECT_NEAR(peak_ratio(lagging_press_with("")), 1.129, 0.005);
  EXPECT_NEAR(peak_ratio(lagging_press_with("starting_ratio = 2.5")), 1.26, 0.005);
  Scene two_axes = press_with("frequency = \"50 Hz\"\nresistance_ratio = 1");
  two_axes.effects.transients = true;
  EXPECT_NEAR(peak_ratio(two_axes), 1.86, 0.005);
}

}  // namespace
}  // namespace kurbel::static_curve_test
