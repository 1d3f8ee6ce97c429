// periodic_modes_test.cpp — vibrations where coefficients or contacts change within the cycle: `modes` against pushes
// of the settled run, each of a kind that the mean of the coefficients gets wrong.
#include <gtest/gtest.h>

#include <algorithm>

#include "studies/modes/modes.h"
#include "tests/agreement/agreement.h"
#include "tests/support/scenes.h"

namespace kurbel::periodic_modes_test {
namespace {

ModesStudy modes_of(const std::string& file) {
  const Scene scene = test::scene_file(file);
  Effects effects = scene.effects;
  if (effects.elastic.empty() && !effects.all_elastic) effects.all_elastic = true;
  return find_modes(scene, effects, {});
}

// Frequencies and damping ratios of all vibrations that the pushes show, and of none that they do not.
void expect_vibrations_of_the_run(const std::string& file) {
  SCOPED_TRACE(file);
  const agreement::Row row = agreement::compare_modes(test::scene_file(file));
  int compared = 0;
  for (const agreement::Compared& figure : row.figures) {
    if (figure.topic != agreement::Topic::frequencies && figure.topic != agreement::Topic::damping) continue;
    ++compared;
    EXPECT_EQ(figure.verdict, agreement::Verdict::agrees) << figure.figure << ": " << figure.run << " " << figure.study;
  }
  EXPECT_GT(compared, 0);
}

// A governor's slow vibration: 0.2402 Hz, ζ = 0.691; its mode has little of the states beside those of the coupling.
TEST(PeriodicOscillations, SlowOscillationOfAGovernorIsNotTakenForOneOfTheCoupling) {
  expect_vibrations_of_the_run("tests/agreement/governor_crank.toml");
}

// A limiter that slips once a cycle: both multipliers of the vibration are real, of two signs, and their turns in a
// cycle are a matter of counting.
TEST(PeriodicOscillations, OscillationBehindALimiterIsLockedToTheCycle) {
  expect_vibrations_of_the_run("tests/agreement/vibrations/limiter_slips_with_shaft.toml");
  const ModesStudy study = modes_of("tests/agreement/vibrations/limiter_slips_with_shaft.toml");
  ASSERT_EQ(study.modes.front().periodic.size(), 2u);
  for (const PeriodicMode& vibration : study.modes.front().periodic) {
    EXPECT_TRUE(vibration.branch_by_mean);
    EXPECT_GT(vibration.error, 0);
  }
}

// The pin lies on its bush at every angle; at the mean of its place it floats in the gap and would vibrate at 0.9 Hz.
TEST(PeriodicOscillations, RodThatFloatsInTheGapOfTheMeanDoesNotOscillate) {
  expect_vibrations_of_the_run("tests/agreement/vibrations/worn_pin_shaft.toml");
  const ModesStudy study = modes_of("tests/agreement/vibrations/worn_pin_shaft.toml");
  EXPECT_TRUE(std::any_of(study.modes.begin(), study.modes.end(), [](const Mode& mode) { return mode.only_of_mean; }));
}

// A table that sticks once a cycle has forgotten how it vibrated before: its multiplier is 0.
TEST(PeriodicOscillations, WhatSticksOnceACycleDoesNotOscillateOn) {
  const ModesStudy study = modes_of("tests/agreement/slow_stick_slip.toml");
  ASSERT_EQ(study.modes.size(), 1u);
  EXPECT_TRUE(study.modes.front().only_of_mean);
  EXPECT_TRUE(study.modes.front().periodic.empty());
  EXPECT_TRUE(std::any_of(study.notes.begin(), study.notes.end(), [](const std::string& note) {
    return note.find("remains after a cycle") != std::string::npos;
  }));
}

}  // namespace
}  // namespace kurbel::periodic_modes_test
