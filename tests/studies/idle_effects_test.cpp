// idle_effects_test.cpp — what goes along with variable inertia is reported, and in no advice.
#include <gtest/gtest.h>

#include <algorithm>

#include "studies/advise/advise.h"
#include "studies/effects/effect_study.h"
#include "studies/validity/substitutes.h"
#include "tests/support/scenes.h"

namespace kurbel::idle_effects_test {
namespace {

Scene worn_pin() {
  Scene scene = test::scene_file("tests/agreement/worn_pin_small.toml");
  scene.run.until = 0.3;
  return scene;
}

bool reports(const std::vector<std::string>& notes) {
  return std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("variable inertia is off") != std::string::npos &&
           note.find("joint clearance goes with it") != std::string::npos;
  });
}

TEST(IdleEffects, clearance_without_variable_inertia_is_reported) {
  const Scene scene = worn_pin();
  Effects effects = scene.effects;
  EXPECT_TRUE(idle_effects(*compile(scene, effects)).empty());
  effects.variable_inertia = false;
  EXPECT_TRUE(reports(idle_effects(*compile(scene, effects))));
  SimulateOptions brief;
  brief.measure_error = false;
  EXPECT_TRUE(reports(simulate(scene, effects, "", brief).notes));
  effects.joint_clearance = false;
  EXPECT_TRUE(idle_effects(*compile(scene, effects)).empty());
}

TEST(IdleEffects, the_study_of_effects_says_what_its_row_of_variable_inertia_took_along) {
  SimulateOptions brief;
  brief.measure_error = false;
  const EffectStudy study = study_effects(worn_pin(), brief);
  EXPECT_TRUE(reports(study.notes));
  EXPECT_NE(output_of(study).text().find("variable inertia is off"), std::string::npos);
}

TEST(IdleEffects, no_set_that_names_what_does_nothing_is_advised) {
  AdviseOptions options;
  options.within = 0.9;
  options.held_out = false;
  options.simulate.measure_error = false;
  const Advice advice = advise(worn_pin(), options);
  const auto place = [&](const std::string& name) {
    return static_cast<std::size_t>(
        std::find_if(advice.units.begin(), advice.units.end(), [&](const EffectUnit& u) { return u.name == name; }) -
        advice.units.begin());
  };
  const std::size_t inertia = place("variable_inertia"), clearance = place("joint_clearance");
  ASSERT_LT(std::max(inertia, clearance), advice.units.size());
  int refused = 0;
  for (const TriedSet& set : advice.tried)
    if (set.on[clearance] && !set.on[inertia]) {
      ++refused;
      EXPECT_FALSE(set.within);
      EXPECT_FALSE(set.refused.empty());
    }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace kurbel::idle_effects_test
