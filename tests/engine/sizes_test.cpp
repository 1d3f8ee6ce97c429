// sizes_test.cpp — values too large for arithmetic are refused where they stand; the largest that are not, run or
// fail in time; large machines compile in time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/numerics/deadline.h"
#include "studies/reduce/reduce.h"
#include "studies/run/simulate.h"
#include "studies/steady/steady.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace kurbel::sizes_test {
namespace {

using test::scene_from;

std::string said_of(const std::string& text) {
  try {
    const Scene scene = scene_from(text);
    compile(scene, scene.effects);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "sound";
}

// A motor, a coupling, a wheel.
std::string drive(const std::string& coupling, const std::string& wheel, const std::string& run) {
  return fmt::format(
      "line = [\"motor\", \"coupling\", \"wheel\"]\n"
      "motor = {{ kind = \"torque source\", torque = \"10 N*m\", inertia = \"0.5 kg*m2\" }}\n"
      "coupling = {{ kind = \"coupling\", {} }}\n"
      "wheel = {{ kind = \"flywheel\", inertia = \"{}\" }}\n"
      "effects = {{ elasticity = true }}\n"
      "run = {{ {}until = \"1 s\", budget = \"0.3 s\" }}\n",
      coupling, wheel, run);
}

TEST(Sizes, WhatWouldOverOrUnderflowIsRefusedWithItsLine) {
  EXPECT_EQ(said_of(drive("stiffness = \"1e308 N*m/rad\"", "2 kg*m2", "")),
            "test.toml:3:45: coupling \"coupling\": stiffness = 1e308 N·m/rad; must be within ± 1e+30 in SI units; "
            "check its unit and power of ten");
  EXPECT_EQ(said_of(drive("stiffness = \"1e-308 N*m/rad\"", "2 kg*m2", "")),
            "test.toml:3:45: coupling \"coupling\": stiffness = 1e-308 N·m/rad; must be of a size of 1e-30 or more "
            "in SI units; check its unit and power of ten");
  EXPECT_EQ(said_of(drive("stiffness = \"1 N*m/rad\", damping = \"1e-50 N*m*s/rad\"", "2 kg*m2", "")),
            "test.toml:3:68: coupling \"coupling\": damping = 1e-50 N·m·s/rad; must be 0 or of a size of 1e-30 or "
            "more in SI units; check its unit and power of ten");
  EXPECT_EQ(said_of(drive("stiffness = \"1 N*m/rad\"", "2 kg*m2", "start = { angle = \"1e19 deg\" }, ")),
            "test.toml:6:27: start: angle = 1e19 deg; must be within ± 1e+09 rad; check its unit and power of ten");
}

// A place on a turn, however small, is one.
TEST(Sizes, TinyAnglesAreAngles) {
  EXPECT_EQ(said_of(drive("stiffness = \"1 N*m/rad\"", "2 kg*m2", "start = { angle = \"5e-324 rad\" }, ")), "sound");
}

class AtTheEdge : public testing::TestWithParam<std::pair<const char*, const char*>> {};

// The ends of the limit make no good machine, but one that ends in time.
TEST_P(AtTheEdge, RunsOrFailsWithinItsBudget) {
  const auto& [coupling, wheel] = GetParam();
  const double begin = processor_time();
  const Result result =
      test::run(drive(coupling, wheel, "start = { angle = \"1e9 rad\", speed = \"7 rad/s\" }, "), false);
  EXPECT_LT(processor_time() - begin, 2.3 * test::slower);
  EXPECT_TRUE(result.complete || !result.diagnosis.empty());
}

INSTANTIATE_TEST_SUITE_P(Sizes, AtTheEdge,
                         testing::Values(std::pair{"stiffness = \"1e30 N*m/rad\"", "2 kg*m2"},
                                         std::pair{"stiffness = \"1e-30 N*m/rad\"", "2 kg*m2"},
                                         std::pair{"stiffness = \"1e30 N*m/rad\"", "1e-30 kg*m2"},
                                         std::pair{"stiffness = \"1e-30 N*m/rad\"", "1e30 kg*m2"},
                                         std::pair{"stiffness = \"1 N*m/rad\", damping = \"1e30 N*m*s/rad\"",
                                                   "1e-30 kg*m2"}));

TEST(Sizes, RatiosThatMultiplyBeyondReasonAreRefused) {
  std::string stages;
  for (int i = 0; i < 10; ++i) stages += "{ teeth = [5, 100000] }, ";
  const std::string said =
      said_of(fmt::format("line = [\"motor\", \"gearbox\", \"wheel\"]\n"
                          "motor = {{ kind = \"torque source\", torque = \"10 N*m\", inertia = \"0.5 kg*m2\" }}\n"
                          "gearbox = {{ kind = \"gearbox\", stages = [{}] }}\n"
                          "wheel = {{ kind = \"flywheel\", inertia = \"1 kg*m2\" }}\n",
                          stages));
  EXPECT_NE(said.find("test.toml:3:1: \"gearbox\" turns "), std::string::npos) << said;
  EXPECT_NE(said.find("must be within 1e-30 … 1e+30"), std::string::npos) << said;
}

TEST(Sizes, OneThousandMayBeWrittenWithAnExponent) {
  const Scene scene = scene_from(drive("stiffness = \"1 N*m/rad\"", "2 kg*m2", "samples = 1e3, "));
  EXPECT_EQ(scene.run.samples, 1000);
  EXPECT_NE(said_of(drive("stiffness = \"1 N*m/rad\"", "2 kg*m2", "samples = 1e-3, ")).find("must be a whole number"),
            std::string::npos);
}

// Rows that differ in the file and no more in SI.
TEST(Sizes, PointsTooNearForASlopeAreNamed) {
  const std::string said = said_of(
      "line = [\"s\"]\ns = { kind = \"torque source\", inertia = \"1 kg*m2\", table = { over = \"time\", "
      "unit = [\"s\", \"N*m\"], points = [[0, 1], [1e-40, 2], [1, 3]] } }\n");
  EXPECT_EQ(said.find("test.toml:2:"), 0u) << said;
  EXPECT_NE(said.find("x = 1e-40 lies so near to the point before it"), std::string::npos) << said;
}

// --- what a scene may leave empty ---

TEST(Empty, MethodThatDoesNotFitIsRefusedWhereItStands) {
  try {
    test::run(drive("stiffness = \"1 N*m/rad\"", "2 kg*m2", "method = \"work\", "), false);
    FAIL() << "the work equation ran an elastic machine";
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()).find("test.toml:6:"), 0u) << error.what();
    EXPECT_NE(std::string(error.what()).find("method \"work\": "), std::string::npos) << error.what();
  }
}

// Its heat is that of no step at all.
TEST(Empty, SlippingJointOfARunThatFailsBeforeItsFirstStep) {
  Scene scene = scene_from(
      "line = [\"motor\", \"clutch\", \"middle\", \"coupling\", \"wheel\"]\n"
      "motor = { kind = \"torque source\", torque = \"10 N*m\", inertia = \"0.5 kg*m2\" }\n"
      "clutch = { kind = \"clutch\", torque = \"5 N*m\" }\n"
      "middle = { kind = \"flywheel\", inertia = \"1 kg*m2\" }\n"
      "coupling = { kind = \"coupling\", stiffness = \"1 N*m/rad\" }\n"
      "wheel = { kind = \"flywheel\", inertia = \"1 kg*m2\" }\n"
      "effects = { elasticity = true }\n"
      "run = { start = { coupling = { twist = \"1 rad\" } } }\n");
  for (Section& section : scene.components)
    for (Setting& setting : section.settings)
      if (setting.key == "stiffness") setting.number = 1e308;  // which no file may say
  const Result result = test::run(scene, false);
  EXPECT_FALSE(result.complete);
  EXPECT_FALSE(result.diagnosis.empty());
}

TEST(Empty, SteadyCycleOfAGearboxWithoutAnIdealStage) {
  const Scene scene = scene_from(
      "line = [\"motor\", \"gearbox\", \"wheel\"]\n"
      "motor = { kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = \"40 rad/s\", inertia = \"0.1 "
      "kg*m2\" }\n"
      "gearbox = { kind = \"gearbox\", stages = [{ teeth = [20, 40], efficiency = 0.95 }] }\n"
      "wheel = { kind = \"flywheel\", inertia = \"2 kg*m2\" }\n"
      "load = { kind = \"load\", torque = \"15 N*m\", on = \"wheel\" }\n");
  const SteadyStudy study = steady(scene, {Effects{}}, {});  // without losses, but the stage is none whose ratio is set
  EXPECT_TRUE(study.ratios.empty());
}

// The housing stands in the usual motion, so its inertia counts nothing on the motor; its own it is all the same.
TEST(Empty, ReducedInertiaOfAHousingThatStands) {
  const Scene scene = scene_from(
      "line = [\"motor\", \"gearbox\", \"wheel\"]\n"
      "motor = { kind = \"torque source\", torque = \"10 N*m\", inertia = \"0.5 kg*m2\" }\n"
      "gearbox = { kind = \"gearbox\", stages = [{ teeth = [20, 40], inertia = [\"0.02 kg*m2\", \"0 kg*m2\"] }], "
      "support_stiffness = \"1 kN*m/rad\" }\n"
      "wheel = { kind = \"flywheel\", inertia = \"2 kg*m2\" }\n");
  const auto model = compile(scene, {});
  for (const ChainInertia& part : elastic_chain(*model, model->reduction_node).inertias) {
    EXPECT_TRUE(std::isfinite(part.own) && std::isfinite(part.reduced)) << part.name;
    EXPECT_NEAR(part.own * part.ratio * part.ratio, part.reduced, 1e-15) << part.name;
  }
}

// --- how large a machine may be ---

std::string chain(int couplings) {
  std::string line = "line = [", tables;
  for (int i = 0; i < couplings; ++i) {
    line += fmt::format("\"i{0}\", \"k{0}\", ", i);
    tables += fmt::format(
        "i{0} = {{ kind = \"inertia\", inertia = \"1 kg*m2\" }}\nk{0} = {{ kind = \"coupling\", stiffness = \"1 "
        "N*m/rad\" }}\n",
        i);
  }
  return line + "\"end\"]\n" + tables +
         "end = { kind = \"inertia\", inertia = \"1 kg*m2\" }\neffects = { elasticity = true }\n";
}

TEST(Bounds, AChainOfAHundredThousandComponentsCompilesInSeconds) {
  const double begin = processor_time();
  const Scene scene = scene_from(chain(50'000));
  const auto model = compile(scene, scene.effects);
  EXPECT_EQ(model->elastic.size(), 50'000u);
  EXPECT_LT(processor_time() - begin, 30 * test::slower);
}

TEST(Bounds, MoreRelationsThanCanBeSolvedAreRefused) {
  std::string line = "line = [", tables;
  for (int i = 0; i < 1001; ++i) {
    line += fmt::format("\"i{0}\", \"g{0}\", ", i);
    tables += fmt::format(
        "i{0} = {{ kind = \"inertia\", inertia = \"1 kg*m2\" }}\ng{0} = {{ kind = \"gearbox\", stages = [{{ teeth = "
        "[20, 20], efficiency = 0.99 }}] }}\n",
        i);
  }
  const std::string said =
      said_of(line + "\"end\"]\n" + tables + "end = { kind = \"inertia\", inertia = \"1 kg*m2\" }\n");
  EXPECT_EQ(said.find("test.toml:2003:1: the machine has 1001 gears with losses"), 0u) << said;
}

// 10⁶ rows of 100 components would not fit: refused before a step, with what would.
TEST(Bounds, TrajectoryThatMemoryCannotHoldIsRefused) {
  std::string line = "line = [\"w0\"", output = "\"w0\"";
  std::string tables = "w0 = { kind = \"flywheel\", inertia = \"1 kg*m2\" }\n";
  for (int i = 1; i < 50; ++i) {
    line += fmt::format(", \"c{0}\", \"w{0}\"", i);
    output += fmt::format(", \"c{0}\", \"w{0}\"", i);
    tables += fmt::format("w{0} = {{ kind = \"flywheel\", inertia = \"1 kg*m2\" }}\n", i) +
              fmt::format("c{0} = {{ kind = \"coupling\", stiffness = \"1 kN*m/rad\" }}\n", i);
  }
  const auto said = [&](const std::string& samples) -> std::string {
    const Scene scene = scene_from(line + "]\n" + tables +
                                   "effects = { elasticity = true }\nrun = { until = \"1e-6 s\", samples = " + samples +
                                   ", output = [" + output + "] }\n");
    SimulateOptions options;
    options.measure_error = false;
    try {
      return simulate(scene, scene.effects, "test", options).diagnosis;
    } catch (const SceneError& error) {
      return error.what();
    }
  };
  const std::string refused = said("1000000");
  EXPECT_EQ(refused.find("test.toml:102:"), 0u) << refused;
  EXPECT_NE(refused.find("samples = 1000000 of "), std::string::npos) << refused;
  EXPECT_NE(refused.find("must be at most 2 GB"), std::string::npos) << refused;
  EXPECT_EQ(said("1000"), "");
}

// As many names that are none: each is said, but not compared with all others.
TEST(Bounds, TenThousandMissingComponentsAreNamedInSeconds) {
  std::string line = "line = [", tables;
  for (int i = 0; i < 10'000; ++i) {
    line += fmt::format("\"j{}\", ", i);
    tables += fmt::format("i{} = {{ kind = \"inertia\", inertia = \"1 kg*m2\" }}\n", i);
  }
  const double begin = processor_time();
  EXPECT_NE(said_of(line + "]\n" + tables), "sound");
  EXPECT_LT(processor_time() - begin, 5 * test::slower);
}

}  // namespace
}  // namespace kurbel::sizes_test
