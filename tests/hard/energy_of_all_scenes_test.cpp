// energy_of_all_scenes_test.cpp — in every scene that comes with the program the energy balance closes: what is stored
// plus what moves is what was put in less what was taken out. The bodies' energy is Simbody's, not that from I_r.
#include <filesystem>

#include "tests/published/published.h"

namespace kurbel::energy_of_all_scenes_test {
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
  EXPECT_LE(r.energy.relative, scene.run.accuracy);
  EXPECT_LE(r.energy.reduction_residual, 1e-11);
  EXPECT_LE(r.energy.free_bodies, 1e-9);
}

TEST_P(EnergyBalance, ClosesForTheRigidMachineToo) {
  const Scene scene = test::scene_file("scenes/" + GetParam() + ".toml");
  const Result r = simulate(scene, {}, "rigid", {});
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_LE(r.energy.relative, scene.run.accuracy);
  EXPECT_LE(r.energy.free_bodies, 1e-9);
}

// A blow of 20 µs falls into two steps at any tolerance, so that runs agree in the work that they get wrong
// (conservation law: the work of the blow is what moves afterwards).
TEST(EnergyBalance, IsPartOfTheAccuracyWhereEdgesHoldTheSteps) {
  const Scene scene = test::scene_from(R"(
line = ["a", "c", "b"]
a = { kind = "inertia", inertia = "0.5 kg*m2" }
b = { kind = "inertia", inertia = "2 kg*m2" }
c = { kind = "coupling", stiffness = "20000 N*m/rad" }
effects = { elasticity = true }
run = { until = "0.3 s" }
[blow]
on = "a"
kind = "torque source"
table = { over = "time", unit = ["s", "N*m"], points = [[0, 0], [0.1, 0], [0.10001, 1e6], [0.10002, 0]] }
)");
  for (const char* method : {"esdirk3", "esdirk", "esdirk5", "bdf", "adams"}) {
    SimulateOptions options;
    options.method = method;
    options.accuracy = 1e-7;
    const Result r = simulate(scene, scene.effects, method, options);
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_LE(r.energy.relative, r.accuracy_confirmed ? 1e-7 : r.measured_accuracy) << method;
  }
}

INSTANTIATE_TEST_SUITE_P(OfScenes, EnergyBalance, ::testing::ValuesIn(all_scenes()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace kurbel::energy_of_all_scenes_test
