// fuzz_test.cpp — the short part of the attack that scripts/fuzz goes on with: the same targets and inputs, from a
// fixed number on.
#include <gtest/gtest.h>

#include "engine/scene/scene.h"
#include "studies/scenes/kinds.h"
#include "tests/fuzz/mutator.h"
#include "tests/fuzz/seeds.h"
#include "tests/fuzz/targets.h"
#include "tests/fuzz/toml_text.h"

namespace kurbel::fuzz {
namespace {

class Attack {
 public:
  explicit Attack(const char* target) : target_(target_named(target)) {}
  void expect_no_fault(std::uint64_t from, std::uint64_t count) const {
    for (std::uint64_t number = from; number < from + count; ++number) {
      const std::string input = input_of(*target_, number);
      EXPECT_EQ(target_->judge(input), "") << "kurbel_fuzz " << target_->name << " --from " << number << " --count 1";
    }
  }

 private:
  const Target* target_;
};

TEST(Fuzz, EveryTextIsReadOrRefusedWithAPlace) { Attack("reader").expect_no_fault(1, 1200); }

TEST(Fuzz, EveryTableIsReadOrRefusedWithAPlace) { Attack("csv").expect_no_fault(1, 3000); }

TEST(Fuzz, EveryFormulaIsComputedOrRefusedWithAColumn) { Attack("formula").expect_no_fault(1, 2000); }

TEST(Fuzz, EverySceneThatCanBeReadIsCompiledOrRefusedWithAPlace) { Attack("compile").expect_no_fault(1, 1200); }

TEST(Fuzz, EveryMachineRunsOrSaysWhyNot) { Attack("run").expect_no_fault(1, 25); }

TEST(Fuzz, EveryOtherVerbAnswersOrRefuses) { Attack("study").expect_no_fault(1, 10); }

// The mutator writes trees as TOML: of every example the same machine.
TEST(Fuzz, ASceneWrittenFromItsTreeIsTheSameScene) {
  for (const Seed& seed : good_scenes()) {
    const std::string again = toml_document(parse_toml(seed.text, "seed"));
    EXPECT_EQ(toml_document(parse_toml(again, "again")), again) << seed.name;
    EXPECT_EQ(judge_reader(again), "") << seed.name;
    EXPECT_NO_THROW(parse_scene(again, scene_path(), all_kinds())) << seed.name;
  }
}

// Mutations neither leave all scenes sound nor break all of them: both paths are taken.
TEST(Fuzz, SomeInputsAreSoundAndSomeAreNot) {
  int sound = 0;
  constexpr int n = 200;
  for (std::uint64_t number = 1; number <= n; ++number) try {
      parse_scene(input_of(*target_named("run"), number), scene_path(), all_kinds());
      ++sound;
    } catch (const SceneError&) {
    }
  EXPECT_GT(sound, n / 10);
  EXPECT_LT(sound, n * 9 / 10);
}

// What the judges must not let pass.
TEST(Fuzz, AMessageBehindTheEndOfItsLineIsAFault) {
  EXPECT_EQ(judge_reader(""), "");
  EXPECT_EQ(judge_reader("line = [\"\xBF"), "");
  EXPECT_EQ(judge_csv("\"1,2\n"), "");
}

}  // namespace
}  // namespace kurbel::fuzz
