// deadline_test.cpp — what takes long is ended by its budget and by the user, wherever it is.
#include "engine/numerics/deadline.h"

#include <gtest/gtest.h>

#include <optional>

#include "engine/linear/eigen_modes.h"
#include "studies/forces/forces.h"
#include "studies/modes/modes.h"
#include "studies/reduce/reduce.h"
#include "studies/size/size.h"
#include "studies/steady/steady.h"
#include "tests/support/scenes.h"

namespace kurbel::deadline_test {
namespace {

void work_until_reported() {
  for (;;) Deadline::check();
}

TEST(Deadline, WithoutOneNothingIsEnded) {
  for (int i = 0; i < 1000; ++i) Deadline::check();
}

TEST(Deadline, EndsWorkWhenItsProcessorTimeIsSpent) {
  const double begin = processor_time();
  try {
    const Deadline deadline(0.02);
    work_until_reported();
  } catch (const OutOfTime& over) {
    EXPECT_FALSE(over.interrupted());
    EXPECT_EQ(std::string(over.what()), "the budget of 0.02 s of processor time is spent");
  }
  EXPECT_NEAR(processor_time() - begin, 0.02, 0.02);
  Deadline::check();  // it is no longer in force
}

// Libraries take an exception for a step that failed, and try a shorter one: that must not buy them time.
TEST(Deadline, OnceSpentEveryLookEndsTheWork) {
  const Deadline deadline(0.005);
  EXPECT_THROW(work_until_reported(), OutOfTime);
  for (int i = 0; i < 1000; ++i) EXPECT_THROW(Deadline::check(), OutOfTime);
}

TEST(Deadline, OfTwoTheSoonerHolds) {
  for (const auto& [outer, inner] : {std::pair{0.01, 100.0}, std::pair{100.0, 0.01}}) {
    const Deadline first(outer);
    const Deadline second(inner);
    EXPECT_THROW(work_until_reported(), OutOfTime);
  }
}

TEST(Deadline, AnInterruptEndsWorkAtOnce) {
  std::atomic<bool> interrupted = true;
  const Deadline outer(100, &interrupted);
  const Deadline inner(100);
  try {
    work_until_reported();
  } catch (const OutOfTime& over) {
    EXPECT_TRUE(over.interrupted());
    EXPECT_EQ(std::string(over.what()), "interrupted");
  }
}

// What fails is often tried another way; an interrupt is none of that.
TEST(Deadline, IsNoFailureThatMayBeSwallowed) {
  static_assert(!std::is_base_of_v<std::runtime_error, OutOfTime>);
  static_assert(!std::is_base_of_v<std::logic_error, OutOfTime>);
}

TEST(Deadline, ASpentBudgetEndsARunWithADiagnosis) {
  Scene scene = test::scene_file("scenes/crank_press.toml");
  scene.run.budget = 1e-3;
  const Result result = test::run(scene, false);
  EXPECT_FALSE(result.complete);
  EXPECT_NE(result.diagnosis.find("the budget of 0.001 s of processor time is spent"), std::string::npos)
      << result.diagnosis;
}

TEST(Deadline, ASpentBudgetEndsAMultibodyRunWithADiagnosis) {
  Scene scene = test::scene_file("scenes/free_slider_crank.toml");
  scene.run.model = "multibody";
  scene.run.budget = 1e-3;
  const Result result = simulate(scene, {}, "multibody", {});
  EXPECT_FALSE(result.complete);
  EXPECT_NE(result.diagnosis.find("budget"), std::string::npos) << result.diagnosis;
}

// Bodies in the loop cost a thousand times what tables do, before the first step as well.
TEST(Deadline, ASpentBudgetEndsTheWorkOfBodiesOverTheAngle) {
  Scene scene = test::scene_file("scenes/free_slider_crank.toml");
  scene.run.budget = 0.01;
  scene.effects = parse_effects("multibody", scene);
  const double begin = processor_time();
  const Result result = test::run(scene, false);
  EXPECT_LT(processor_time() - begin, 1);  // 4 s to the end
  EXPECT_FALSE(result.complete);
  EXPECT_NE(result.diagnosis.find("budget"), std::string::npos) << result.diagnosis;
}

TEST(Deadline, ASpentBudgetEndsEveryStudy) {
  Scene scene = test::scene_file("scenes/crank_press.toml");
  scene.run.budget = 1e-9;
  SizeOptions flywheel;
  flywheel.delta = 0.05;
  ForcesOptions many;
  many.positions = 3600;
  EXPECT_THROW(steady(scene, {scene.effects}, {}), OutOfTime);
  EXPECT_THROW(find_forces(scene, many), OutOfTime);
  EXPECT_THROW(reduce(scene, {}), OutOfTime);
  EXPECT_THROW(size_flywheel(scene, flywheel), OutOfTime);
}

// The modes at the scene's state cost milliseconds, the steady motion of the press a hundred times as much. Checks of the
// budget are rationed: the smallest budget may do for them.
TEST(Deadline, ModesAtTheScenesStateAreKeptWhenTheBudgetEndsLater) {
  Scene scene = test::scene_file("scenes/crank_press.toml");
  std::optional<ModesStudy> modes;
  for (scene.run.budget = 1e-9; !modes; scene.run.budget *= 2) {
    try {
      modes = find_modes(scene, scene.effects, {});
    } catch (const OutOfTime&) {
      ASSERT_LT(scene.run.budget, 10);
    }
  }
  EXPECT_FALSE(modes->complete);
  EXPECT_FALSE(modes->modes.empty());
  EXPECT_NE(modes->diagnosis.find("budget"), std::string::npos) << modes->diagnosis;
}

TEST(Deadline, AnInterruptEndsTheExtractionOfAMechanism) {
  std::atomic<bool> interrupted = true;
  const Deadline deadline(100, &interrupted);
  const std::string text =
      "line = [\"crank\"]\ncrank = { kind = \"slider-crank\", radius = \"101.7 mm\", rod = \"350 mm\", crank_inertia = "
      "\"0.5 kg*m2\", slider_mass = \"3 kg\" }\n";
  EXPECT_THROW(compile(test::scene_from(text), {}), OutOfTime);
}

}  // namespace
}  // namespace kurbel::deadline_test
