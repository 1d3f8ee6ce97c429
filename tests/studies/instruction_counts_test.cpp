// instruction_counts_test.cpp — what is off costs nothing: to the instruction, as callgrind counts them.
#include <gtest/gtest.h>

#include "bench/instruction_counts.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace kurbel::instruction_counts_test {
namespace {

struct Pair {
  const char *scene, *effect;
};

class EffectOffCosts : public testing::TestWithParam<Pair> {};
INSTANTIATE_TEST_SUITE_P(Each, EffectOffCosts,
                         testing::Values(Pair{"bench/scenes/press_with_everything.toml", "backlash"},
                                         Pair{"bench/scenes/press_with_everything.toml", "joint_friction"},
                                         Pair{"bench/scenes/press_with_everything.toml", "transients"},
                                         Pair{"bench/scenes/press_with_everything.toml", "gear_losses"},
                                         Pair{"scenes/diesel_generator.toml", "relaxation"},
                                         Pair{"scenes/gear_test_rig.toml", "mesh_variation"}),
                         [](const auto& info) { return std::string(info.param.effect); });

// Right-hand side and Jacobian with the effect off take as many instructions as those of the scene that never had it.
TEST_P(EffectOffCosts, NotOneInstruction) {
  if (test::sanitized) GTEST_SKIP() << "valgrind does not run instrumented programs";
  if (!bench::callgrind_is_installed()) GTEST_SKIP() << "valgrind is not installed";
  const std::string scene = test::source_path(GetParam().scene), effect = GetParam().effect;
  const auto off = bench::counted_instructions(KURBEL_COUNTER, scene, effect, "off"),
             without = bench::counted_instructions(KURBEL_COUNTER, scene, effect, "without");
  ASSERT_TRUE(off && without);
  EXPECT_GT(*off, 10000);
  EXPECT_EQ(*off, *without);
}

}  // namespace
}  // namespace kurbel::instruction_counts_test
