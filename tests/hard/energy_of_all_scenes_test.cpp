// energy_of_all_scenes_test.cpp — in every scene that comes with the program the energy balance closes: what is stored
// plus what moves is what was put in less what was taken out. The bodies' energy is Simbody's, not that from I_r.
#include <filesystem>

#include "tests/published/published.h"

namespace kurbel {
namespace {

std::vector<std::string> all_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_path("scenes")))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class EnergyBalance : public ::testing::TestWithParam<std::string> {};

TEST_P(EnergyBalance, ClosesWithinTheAccuracyAskedFor) {
  const Scene scene = test::scene_file("scenes/" + GetParam() + ".toml");
  const Result r = test::run(scene);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_TRUE(r.accuracy_confirmed) << r.measured_accuracy;
  EXPECT_GT(r.energy.checks, 10);
  EXPECT_LE(r.energy.relative, 10 * scene.run.accuracy);
  EXPECT_LE(r.energy.reduction_residual, 1e-11);
}

TEST_P(EnergyBalance, ClosesForTheRigidMachineToo) {
  const Scene scene = test::scene_file("scenes/" + GetParam() + ".toml");
  const Result r = simulate(scene, {}, "rigid", {});
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_LE(r.energy.relative, 10 * scene.run.accuracy);
}

INSTANTIATE_TEST_SUITE_P(OfScenes, EnergyBalance, ::testing::ValuesIn(all_scenes()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace kurbel
