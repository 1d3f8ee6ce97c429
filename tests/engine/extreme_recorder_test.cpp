// extreme_recorder_test.cpp — extremes within steps: which are found, and by how few evaluations.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/run/recorders.h"
#include "engine/steppers/stepper.h"
#include "tests/support/scenes.h"

namespace kurbel::extreme_recorder_test {
namespace {

using std::numbers::pi;
using test::scene_from;

// A step of the given length.
class OneStep final : public Stepper {
 public:
  using Stepper::interpolate;
  OneStep(double from, double to, std::vector<double> y) : from_(from), to_(to), y_(std::move(y)) {}
  void start(double, std::span<const double>) override {}
  void step(double) override {}
  void retake(double) override {}
  void interpolate(double, std::span<double> y) override { std::copy(y_.begin(), y_.end(), y.begin()); }
  double t() const override { return to_; }
  double t_previous() const override { return from_; }
  std::span<const double> y() const override { return y_; }
  std::span<const double> y_previous() const override { return y_; }
  std::span<const double> ydot() const override { return y_; }
  std::span<const double> ydot_previous() const override { return y_; }

 private:
  double from_, to_;
  std::vector<double> y_;
};

// x³ − 0.9 x over −1 … 1, its ends and its middle on one line: the peak between them, 2 (0.3)^{3/2}, is found.
TEST(ExtremeRecorder, FindsAPeakThatThreeSamplesOnALineHide) {
  const Scene scene = scene_from("line = [\"a\"]\na = { kind = \"inertia\", inertia = \"1 kg*m2\" }\n");
  Equations equations(compile(scene, scene.effects), false);
  const std::vector<double> y = equations.start(0);
  for (const double sign : {1.0, -1.0}) {
    const auto value = [sign](const Snapshot& s) { return sign * (std::pow(s.now.t, 3) - 0.9 * s.now.t); };
    ExtremeRecorder recorder({{.name = {quantities::other, "", "cubic"},
                               .unit = "1",
                               .functional = Functional::greatest,
                               .value = value,
                               .rate = {}}});
    recorder.begin(-1, y, equations);
    OneStep step(-1, 1, y);
    StepView view(equations);
    view.watch(step);
    recorder.step(view);
    EXPECT_NEAR(recorder.found()[0].value, 2 * std::pow(0.3, 1.5), 1e-6);
    EXPECT_NEAR(recorder.found()[0].time, -sign * std::sqrt(0.3), 1e-3);
  }
}

// A recorder over equal steps of a function of time, and when it last requested a value within a step.
struct Watched {
  ExtremeRecorder::Found found;
  double asked = -HUGE_VAL;
};
Watched watch(ExtremeOf wanted, double from, double length, int steps) {
  const Scene scene = scene_from("line = [\"a\"]\na = { kind = \"inertia\", inertia = \"1 kg*m2\" }\n");
  Equations equations(compile(scene, scene.effects), false);
  const std::vector<double> y = equations.start(0);
  Watched watched;
  wanted.value = [&, value = wanted.value](const Snapshot& s) {
    const double place = (s.now.t - from) / length;
    if (std::abs(place - std::round(place)) > 1e-9) watched.asked = s.now.t;
    return value(s);
  };
  ExtremeRecorder recorder({wanted});
  recorder.begin(from, y, equations);
  StepView view(equations);
  for (int k = 0; k < steps; ++k) {
    OneStep step(from + k * length, from + (k + 1) * length, y);
    view.watch(step);
    view.set_anew(k == 0);
    recorder.step(view);
  }
  watched.found = recorder.found()[0];
  return watched;
}

// 1 − e^{−t}: its greatest value is the last one, and no step has a turn.
TEST(ExtremeRecorder, NeedsNothingWithinStepsOfWhatRunsStraight) {
  const auto slope = [](const Snapshot& s) { return std::exp(-s.now.t); };
  const Watched w = watch({.name = {quantities::other, "", "rise"},
                           .unit = "1",
                           .functional = Functional::greatest,
                           .value = [](const Snapshot& s) { return -std::expm1(-s.now.t); },
                           .rate = slope,
                           .slope = slope},
                          0, 0.2, 20);
  EXPECT_EQ(w.asked, -HUGE_VAL);
  EXPECT_DOUBLE_EQ(w.found.value, -std::expm1(-20 * 0.2));
}

// Kloss' torque 2 M_b/(s/s_b + s_b/s) of a motor that runs up evenly, s = 1 − t: the breakdown torque at s_b = 0.2 lies
// within a step.
TEST(ExtremeRecorder, FindsTheBreakdownTorqueOfALawOfSpeedWithinAStep) {
  for (const double length : {0.15, 0.06, 0.015}) {
    const Watched w = watch({.name = {quantities::other, "", "torque"},
                             .unit = "N*m",
                             .value =
                                 [](const Snapshot& s) {
                                   const double part = (1 - s.now.t) / 0.2;
                                   return 100 / (part + 1 / part);
                                 },
                             .rate = {},
                             .slope = [](const Snapshot&) { return 1.0; },
                             .argument = [](const Snapshot& s) { return s.now.t; }},
                            0, length, static_cast<int>(0.95 / length));
    EXPECT_NEAR(w.found.value, 50, 1e-6);
    EXPECT_NEAR(w.found.time, 0.8, 1e-4);
  }
}

// A linear law of a speed whose vibration decays: its peak is found with steps of any part of the period, and lower ones are
// not sought.
TEST(ExtremeRecorder, FindsThePeakOfALawOfAVibratingSpeed) {
  const auto swing = [](double t) { return std::exp(-0.2 * t) * std::sin(t); };
  const auto slope = [&](double t) { return std::exp(-0.2 * t) * (std::cos(t) - 0.2 * std::sin(t)); };
  const double at = std::atan(5.0);
  for (const double length : {0.1, 0.5, 1.0, 2.0, 3.0, 4.0}) {
    const int steps = static_cast<int>(60 / length);
    const Watched w = watch({.name = {quantities::other, "", "torque"},
                             .unit = "N*m",
                             .value = [&](const Snapshot& s) { return 7 - 3 * swing(s.now.t); },
                             .rate = {},
                             .slope = [&](const Snapshot& s) { return slope(s.now.t); },
                             .argument = [&](const Snapshot& s) { return swing(s.now.t); }},
                            0, length, steps);
    EXPECT_NEAR(w.found.value, 7 - 3 * swing(at + pi), 1e-6) << length;
    EXPECT_LT(w.asked, 30) << length;
  }
}

// A growing wave of the fourth order, met by all steps at one phase as by steps of a quarter turn each: its last peak counts.
TEST(ExtremeRecorder, FindsTheLastPeakOfAGrowingWaveMetAtOnePhase) {
  for (const double phase : {0.3, 0.5, 2.0}) {
    const auto value = [&](double t) { return (1 + 0.01 * t) * std::sin(4 * t + phase); };
    const Watched w = watch({.name = {quantities::other, "", "wave"},
                             .unit = "1",
                             .functional = Functional::greatest,
                             .value = [&](const Snapshot& s) { return value(s.now.t); },
                             .rate = {}},
                            0, pi / 2, 40);
    const double last = 20 * pi - std::fmod(phase + 1.5 * pi, 2 * pi) / 4;  // of sin(4 t + phase) = 1
    EXPECT_NEAR(w.found.value, value(last), 1e-5) << phase;
    EXPECT_NEAR(w.found.time, last, 1e-3) << phase;
  }
}

// 100 N·m that fall to nothing within a second: what is left is rounding, and the least value is of the time at which it
// was reached first, however rounding goes on.
TEST(ExtremeRecorder, OfExtremesThatDifferByRoundingTheFirstCounts) {
  for (const double falls : {0.0, -1e-15, -1e-14}) {  // of later values from step to step [N·m]
    const auto value = [&](const Snapshot& s) { return s.now.t < 1 ? 100 * (1 - s.now.t) : falls * (s.now.t - 1); };
    const Watched w = watch({.name = {quantities::other, "", "torque"},
                             .unit = "N*m",
                             .functional = Functional::least,
                             .value = value,
                             .rate = {},
                             .slope = [](const Snapshot& s) { return s.now.t < 1 ? 100.0 : 0.0; }},
                            0, 0.25, 40);
    EXPECT_DOUBLE_EQ(w.found.time, 1) << falls;
    EXPECT_NEAR(w.found.value, 0, 1e-12);
  }
  // What differs by more than rounding is another extreme.
  const Watched apart =
      watch({.name = {quantities::other, "", "torque"},
             .unit = "N*m",
             .functional = Functional::least,
             .value = [](const Snapshot& s) { return s.now.t < 1 ? 1 - s.now.t : 1e-6 * (1 - s.now.t); },
             .rate = {},
             .slope = [](const Snapshot& s) { return s.now.t < 1 ? 1.0 : 1e-6; }},
            0, 0.25, 40);
  EXPECT_DOUBLE_EQ(apart.found.time, 10);
}

}  // namespace
}  // namespace kurbel::extreme_recorder_test
