// facade_test.cpp — <kurbel/kurbel.h> as its users have it: faults with places, settings, motions, sweeps of functions.
// Elements of one's own are tested by the examples, each in a process of its own.
#include <gtest/gtest.h>
#include <kurbel/kurbel.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace kurbel {
namespace {

const char* const two_masses = R"(
title    = "Step torque on two masses"
line     = ["rotor", "coupling", "fan"]
rotor    = { kind = "inertia", inertia = "0.2 kg*m2" }
motor    = { kind = "torque source", torque = "50 N*m", on = "rotor" }
coupling = { kind = "coupling", stiffness = "4 kN*m/rad", damping = "0 N*m*s/rad" }
fan      = { kind = "inertia", inertia = "1.5 kg*m2" }
effects  = { elasticity = true }
run      = { until = "0.3 s" }
)";
// The undamped step: τ = M J₂/(J₁ + J₂) (1 − cos ω t), ω² = k (1/J₁ + 1/J₂).
double torque_at(double t, double stiffness = 4000) {
  return 50 * 1.5 / 1.7 * (1 - std::cos(std::sqrt(stiffness * (1 / 0.2 + 1 / 1.5)) * t));
}

std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(Facade, AFaultOfASceneHasItsPlace) {
  std::string text = two_masses;
  text.replace(text.find("1.5 kg"), 3, "-15");
  try {
    Machine::from_text(text, "two.toml");
    FAIL() << "was read";
  } catch (const BadScene& bad) {
    ASSERT_EQ(bad.faults().size(), 1u);
    EXPECT_EQ(bad.faults()[0].file, "two.toml");
    EXPECT_EQ(bad.faults()[0].line, 7);
    EXPECT_EQ(std::string(bad.what()).substr(0, 11), "two.toml:7:");
  }
  // Of a setting it is told in the setting.
  EXPECT_NE(message_of([] {
              Machine::from_text(two_masses).with({{"fan.inertia", "-1 kg*m2"}});
            }).find("fan.inertia"),
            std::string::npos);
}

TEST(Facade, TheLaterSettingOfAPathHolds) {
  const Machine machine = Machine::from_text(two_masses, "two.toml", {{"coupling.stiffness", "1 kN*m/rad"}});
  const Machine stiff = machine.with({{"coupling.stiffness", "9 kN*m/rad"}});
  Motion soft_motion(machine), stiff_motion(stiff);
  soft_motion.go_to(0.05), stiff_motion.go_to(0.05);
  EXPECT_NEAR(soft_motion["torque.coupling"], torque_at(0.05, 1000), 1e-6);
  EXPECT_NEAR(stiff_motion["torque.coupling"], torque_at(0.05, 9000), 1e-6);
}

TEST(Facade, AColumnOutlivesItsRun) {
  TimeSeries torque, time;
  {
    const kurbel::Run run = kurbel::run(Machine::from_text(two_masses), {.errors = false, .plots = false});
    torque = run.trajectory()["torque.coupling"], time = run.trajectory().time();
  }
  ASSERT_GT(torque.size(), 900u);
  for (std::size_t i = 0; i < torque.size(); i += 7) ASSERT_NEAR(torque[i], torque_at(time[i]), 1e-4);
}

// 100 runs before, so that pools and tables are filled.
TEST(Facade, AThousandLoadsRunsAndFreesLeakNothing) {
  const auto resident = [] {  // [MB]
    long pages = 0, all = 0;
    std::ifstream("/proc/self/statm") >> all >> pages;
    return static_cast<double>(pages) * 4096e-6;
  };
  const auto cycle = [] {
    const Machine machine =
        Machine::from_text(two_masses, "two.toml", {{"run.until", "20 ms"}, {"run.samples", "100"}});
    const kurbel::Run run = kurbel::run(machine, {.errors = false, .plots = false});
    EXPECT_GE(run.trajectory().rows(), 100u);  // and rows at peaks
    EXPECT_FALSE(run.study().json().empty());
  };
  for (int i = 0; i < 100; ++i) cycle();
  const double before = resident();
  for (int i = 0; i < 1000; ++i) cycle();
  EXPECT_LT(resident() - before, 2);
}

TEST(Facade, AMotionGoesBackAndOnToTheLastBit) {
  const Machine machine = Machine::from_text(two_masses);
  Motion motion(machine);
  motion.go_to(0.1);
  EXPECT_NEAR(motion["torque.coupling"], torque_at(0.1), 1e-6);
  const SavedState kept = motion.state();
  motion.go_to(0.2);
  const SavedState end = motion.state();
  EXPECT_FALSE(kept == end);
  Motion other(machine);
  other.restore(other.state_from(kept.text()));
  EXPECT_EQ(other.time(), 0.1);
  EXPECT_NEAR(other["torque.coupling"], torque_at(0.1), 1e-6);
  other.go_to(0.2);
  EXPECT_TRUE(other.state() == end);
  EXPECT_THROW(other.go_to(0.1), std::invalid_argument);
  // The text of another machine is none of this one.
  EXPECT_THROW(Motion(machine, "none").restore(kept), std::invalid_argument);
}

TEST(Facade, WhatAStudyDoesNotAskForIsRefusedWithWhatItHas) {
  const Machine machine = Machine::from_text(two_masses);
  EXPECT_NE(message_of([&] {
              steady(machine, {{"mid_sped", "60 rpm"}});
            }).find("did you mean \"mid_speed\""),
            std::string::npos);
  EXPECT_NE(message_of([&] { study("stedy", machine); }).find("did you mean \"steady\""), std::string::npos);
  EXPECT_NE(message_of([&] {
              kurbel::run(machine, {.errors = false}).figures()["peak_torque.couplin"];
            }).find("did you mean \"peak_torque.coupling\""),
            std::string::npos);
  for (const std::string& name : study_names()) EXPECT_NO_THROW(option_names(name)) << name;
  EXPECT_FALSE(modes(machine).conclusion().empty());
}

TEST(Facade, ASweepOfAFunctionKeepsItsRowsAndSaysWhatFailed) {
  const std::string file = testing::TempDir() + "facade_sweep.db";
  std::filesystem::remove(file);
  const Variation variation{.vary = {"x=1..5", "y=10,20"}, .design = "grid:5x2"};
  std::atomic<int> calls{0};
  const auto product = [&](const std::vector<double>& at) {
    ++calls;
    if (at[0] == 3) throw std::runtime_error("three is not computed");
    return std::vector<double>{at[0] * at[1]};
  };
  const SweepRows rows = sweep(variation, "product", {{"product", ""}}, product, {.into = file, .jobs = 2});
  ASSERT_EQ(rows.lines.size(), 10u);
  EXPECT_TRUE(rows.complete);
  for (const SweepLine& line : rows.lines) {
    if (line.parameters[0] == 3) {
      EXPECT_EQ(line.state, "failed");
      EXPECT_EQ(line.diagnosis, "three is not computed");
      EXPECT_FALSE(line.figures[0].has_value());
    } else {
      EXPECT_EQ(line.figures[0], line.parameters[0] * line.parameters[1]);
    }
  }
  EXPECT_EQ(sweep(variation, "product", {{"product", ""}}, product, {.into = file}).computed, 0u);
  EXPECT_EQ(calls, 10);
  // A file holds the rows of one question.
  EXPECT_THROW(sweep(variation, "sum", {{"product", ""}}, product, {.into = file}), std::invalid_argument);
  std::filesystem::remove(file);
}

}  // namespace kurbel
