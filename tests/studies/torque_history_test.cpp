// torque_history_test.cpp — kurbel modes --torque: the history is that of the run, and what is read off it has its
// error.
#include "studies/history/torque_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "studies/modes/modes.h"
#include "tests/published/published.h"
#include "tests/support/scenes.h"

namespace kurbel::torque_history_test {
namespace {

constexpr double pi = std::numbers::pi;

// --- the run's own history ---

// A motor with a load is engaged by a clutch after a while, and stopped again by a brake.
const char* const switched = R"(
line = ["motor", "clutch", "shaft", "drum"]
[motor]
kind = "dc shunt motor"
stall_torque = "200 N*m"
no_load_speed = "50 rad/s"
inertia = "0.4 kg*m2"
[clutch]
kind = "clutch"
torque = "120 N*m"
inertia_in = "0.05 kg*m2"
inertia_out = "0.05 kg*m2"
[shaft]
kind = "coupling"
stiffness = "3 kN*m/rad"
damping = "2 N*m*s/rad"
[drum]
kind = "load"
quadratic = "0.01 N*m*s2/rad2"
inertia = "0.6 kg*m2"
[brake]
kind = "brake"
torque = "150 N*m"
on = "drum"
[sequence]
steps = [
  { at = "0 s", set = ["clutch", "brake"], to = 0 },
  { at = "0.2 s", set = "clutch", to = 1 },
  { at = "0.9 s", set = "clutch", to = 0 },
  { at = "1 s", set = "brake", to = 1 },
]
[effects]
elasticity = true
[run]
start = { speed = "0 rad/s", motor = { speed = "45 rad/s" }, clutch = {} }
until = "1.4 s"
accuracy = 1e-6
)";

const char* const rattling = R"(
line = ["source", "k1", "disc", "k2", "end"]
[source]
kind = "torque source"
torque = "2 N*m"
amplitude = "25 N*m"
frequency = "7 Hz"
inertia = "0.5 kg*m2"
[k1]
kind = "coupling"
stiffness = "2 kN*m/rad"
damping = "5 N*m*s/rad"
backlash = "0.5 deg"
[disc]
kind = "inertia"
inertia = "1.5 kg*m2"
[k2]
kind = "coupling"
stiffness = "5 kN*m/rad"
damping = "3 N*m*s/rad"
[end]
kind = "load"
damping = "1 N*m*s/rad"
inertia = "0.8 kg*m2"
[effects]
elasticity = true
backlash = true
[run]
start = { speed = "2 rad/s" }
until = "1.5 s"
accuracy = 1e-6
)";

TorqueHistory history_of(const Scene& scene, const std::string& torque) {
  return *find_modes(scene, scene.effects, {.torque = torque}).history;
}

void expect_history_of_the_run(Scene scene, const std::string& torque) {
  const TorqueHistory h = history_of(scene, torque);
  scene.run.samples = static_cast<int>(h.time.size());
  const Result r = test::run(scene);
  EXPECT_EQ(test::series(r, "torque." + torque), h.value);  // to the last bit
  ASSERT_TRUE(h.complete) << h.diagnosis;
  const double peak = test::figure(r, "peak_torque." + torque);
  EXPECT_DOUBLE_EQ(peak > 0 ? h.greatest.value : h.least.value, peak);
  EXPECT_GE(h.greatest.value, h.least.value);
  EXPECT_LE(std::max(h.greatest.value, -h.least.value), std::abs(peak) * (1 + 1e-12));
}

TEST(SimulatedTorque, OfAnOperatingSequenceHasThePeakOfTheRun) {
  expect_history_of_the_run(test::scene_from(switched), "shaft");
}
TEST(SimulatedTorque, AcrossBacklashHasThePeakOfTheRun) { expect_history_of_the_run(test::scene_from(rattling), "k1"); }
TEST(SimulatedTorque, OfAStartFromRestHasThePeakOfTheRun) {
  expect_history_of_the_run(test::scene_file("scenes/six_inertia_chain.toml"), "c1");
}

// Between the run's peak and what a run of another method and tolerance has there lies no more than the stated error.
TEST(SimulatedTorque, ErrorsOfItsExtremesCoverATighterRun) {
  for (const auto& [text, torque] : {std::pair{switched, "shaft"}, {rattling, "k1"}}) {
    Scene scene = test::scene_from(text);
    const TorqueHistory h = history_of(scene, torque);
    ASSERT_TRUE(h.greatest.error && h.least.error && h.equivalent_amplitude.error);
    scene.run.accuracy = 1e-9;
    scene.run.method = "verner6";
    scene.run.samples = 131072;
    const Result run = test::run(scene, false);
    const std::vector<double> tight = test::series(run, std::string("torque.") + torque);
    EXPECT_NEAR(h.greatest.value, test::figure(run, std::string("peak_torque.") + torque), *h.greatest.error + 1e-8);
    EXPECT_NEAR(h.least.value, *std::min_element(tight.begin(), tight.end()), *h.least.error) << torque;
    EXPECT_LT(*h.greatest.error, 2e-3 * h.greatest.value) << torque;
    EXPECT_NEAR(h.equivalent_amplitude.value, equivalent_amplitude(rainflow(tight, h.resolution), load_exponent),
                *h.equivalent_amplitude.error)
        << torque;
  }
}

// --- lines of a spectrum ---

std::vector<double> sines(const std::vector<std::pair<double, double>>& amplitude_at, double step, int count,
                          double decay = 0) {
  std::vector<double> x;
  for (int k = 0; k < count; ++k) {
    double sum = 3;
    for (const auto& [frequency, amplitude] : amplitude_at)
      sum += amplitude * std::exp(-decay * k * step) * std::sin(2 * pi * frequency * k * step + 0.4);
    x.push_back(sum);
  }
  return x;
}

// A sine halfway between two lines lacks 15 % in the higher of them; located it lacks nothing.
TEST(SpectralLines, SineBetweenTwoLinesHasItsAmplitudeAndFrequency) {
  const double step = 1.0 / 1024;
  for (const double offset : {0.0, 0.1, 0.37, 0.5, 0.83}) {
    const double f = (240 + offset) / 4;
    const std::vector<double> x = sines({{f, 5}}, step, 4096);
    const std::vector<SpectralLine> lines = strongest_lines(x, step, 1);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NEAR(lines[0].amplitude.value, 5, 2e-5) << offset;
    EXPECT_NEAR(lines[0].frequency.value, f, 1e-6) << offset;
    EXPECT_NEAR(lines[0].amplitude.value, 5, *lines[0].amplitude.error + 1e-9) << offset;
    EXPECT_NEAR(lines[0].frequency.value, f, *lines[0].frequency.error + 1e-9) << offset;
    EXPECT_LT(*lines[0].amplitude.error, 1e-3) << offset;
  }
}

TEST(SpectralLines, ErrorsCoverWhatNeighbouringSinesDoToEachOther) {
  const double step = 1.0 / 1024;
  double worst = 0;
  for (int gap = 4; gap < 20; ++gap) {  // in lines of the whole window
    const double f = 60.03, g = f + gap / 4.0;
    for (const SpectralLine& line : strongest_lines(sines({{f, 5}, {g, 3}}, step, 4096), step, 2)) {
      const bool first = std::abs(line.frequency.value - f) < std::abs(line.frequency.value - g);
      EXPECT_NEAR(line.amplitude.value, first ? 5 : 3, *line.amplitude.error) << gap;
      EXPECT_NEAR(line.frequency.value, first ? f : g, *line.frequency.error) << gap;
      worst = std::max(worst, std::abs(line.amplitude.value - (first ? 5 : 3)));
    }
  }
  EXPECT_GT(worst, 1e-3);  // they do
}

TEST(SpectralLines, DecayingSineSaysThatItHasNoAmplitude) {
  const double step = 1.0 / 1024;
  const std::vector<SpectralLine> lines = strongest_lines(sines({{60.2, 5}}, step, 4096, 1.5), step, 1);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_GT(*lines[0].amplitude.error, 0.5 * lines[0].amplitude.value);
}

TEST(SpectralLines, WhatAnotherSpectrumHasNotIsInErrorByAllItsAmplitude) {
  const double step = 1.0 / 1024;
  std::vector<SpectralLine> lines = strongest_lines(sines({{400.1, 5}}, step, 4096), step, 1);
  ASSERT_EQ(lines.size(), 1u);
  widen_errors(lines, spectrum_of(sines({{60, 1}}, step, 4096), step));
  EXPECT_EQ(*lines[0].amplitude.error, lines[0].amplitude.value);
}

// --- load cycles ---

// A load that has settled but for the ripple of rounding: the ripple is no load cycle, however finely it is sampled.
TEST(Rainflow, RippleBelowWhatIsResolvedCountsForNothing) {
  std::vector<double> loads = {0, 10, -4, 6};
  const auto count = [](const std::vector<LoadCycle>& cycles) {
    double sum = 0;
    for (const LoadCycle& c : cycles) sum += c.count;
    return sum;
  };
  const std::vector<LoadCycle> bare = rainflow(loads);
  for (int i = 0; i < 1000; ++i) loads.push_back(6 + (i % 2 ? 1e-9 : -1e-9));
  EXPECT_GT(count(rainflow(loads)), 400);
  const std::vector<LoadCycle> kept = rainflow(loads, 1e-6);
  ASSERT_EQ(kept.size(), bare.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_NEAR(kept[i].range, bare[i].range, 2e-9);
    EXPECT_EQ(kept[i].count, bare[i].count);
  }
}

}  // namespace
}  // namespace kurbel::torque_history_test
