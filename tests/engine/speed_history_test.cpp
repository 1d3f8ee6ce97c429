// speed_history_test.cpp — the last time outside a band that is known only at the end.
#include "engine/run/speed_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "tests/support/scenes.h"

namespace kurbel::speed_history_test {
namespace {

using Curve = std::function<double(double)>;

BandHistory::Stretch stretch(const Curve& f, double a, double b) {
  BandHistory::Stretch s{.begin = a, .end = b};
  for (std::size_t k = 0; k < BandHistory::points; ++k) s.value[k] = f(s.time(k));
  s.find_extremes();
  return s;
}

BandHistory history(const Curve& f, double end, int steps) {
  BandHistory h;
  for (int k = 0; k < steps; ++k) h.add(stretch(f, end * k / steps, end * (k + 1) / steps));
  return h;
}

TEST(BandHistory, FindsWhereAnApproachEntersItsBand) {
  const Curve f = [](double t) { return 80 * (1 - std::exp(-t / 2)); };
  const BandHistory h = history(f, 20, 25);
  for (const double level : {1.0, 30.0, 79.2, 79.9})
    EXPECT_NEAR(*h.last_outside(level, 100), -2 * std::log(1 - level / 80), 1e-9) << level;
  EXPECT_FALSE(h.last_outside(-1, 100));
  EXPECT_EQ(*h.last_outside(90, 100), h.end()) << "never came in";
}

TEST(BandHistory, SteadyMotionTakesNoMemory) {
  const Curve f = [](double t) { return 10 + std::sin(t); };
  const BandHistory h = history(f, 2000 * M_PI, 12345);
  EXPECT_LT(h.size(), 40u);
  EXPECT_NEAR(*h.last_outside(9.5, 12), 2000 * M_PI - M_PI / 6, 1e-6);
}

// Sums of sines on a drift, in steps of any length: the last time outside a band found by looking at 200 000 points.
TEST(BandHistory, AgreesWithAThoroughLookAtAnyBandOfAnyCurve) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(0, 1);
  for (int round = 0; round < 40; ++round) {
    const double a = u(random), w = 3 + 5 * u(random), p = 6 * u(random), drift = u(random) - 0.5, decay = u(random);
    const Curve f = [=](double t) {
      return drift * t + std::exp(-decay * t) * (std::sin(w * t) + a * std::cos(2.3 * w * t + p));
    };
    BandHistory h;
    for (double t = 0; t < 10;) {
      const double next = std::min(10.0, t + 0.02 + 0.1 * u(random));
      h.add(stretch(f, t, next));
      t = next;
    }
    const double middle = f(10 * u(random)), half = 0.8 * u(random);
    double last = -1;
    constexpr int looks = 200000;
    for (int k = looks; k >= 0 && last < 0; --k)
      if (const double x = f(10.0 * k / looks); x < middle - half || x > middle + half) last = 10.0 * k / looks;
    const std::optional<double> found = h.last_outside(middle - half, middle + half);
    ASSERT_EQ(found.has_value(), last >= 0) << round;
    if (found) {
      EXPECT_NEAR(*found, last, 1e-4) << round;
    }
  }
}

// A jump, such as an impact's: in at the time of the jump.
TEST(BandHistory, AJumpEntersAtItsTime) {
  BandHistory h;
  h.add(stretch([](double t) { return t; }, 0, 1));
  h.add(stretch([](double t) { return 4 + 0.01 * t; }, 1, 2));
  EXPECT_EQ(*h.last_outside(3, 5), 1);
}

TEST(BandHistory, WhatIsAppendedCountsAsIfItHadBeenAddedStepByStep) {
  const Curve f = [](double t) { return std::exp(-0.2 * t) * std::sin(3 * t); };
  BandHistory whole = history(f, 10, 100), first = history(f, 5, 50), second;
  for (int k = 50; k < 100; ++k) second.add(stretch(f, 0.1 * k, 0.1 * (k + 1)));
  first.append(second);
  for (const double level : {0.1, 0.3, 0.5, 0.7})
    EXPECT_NEAR(*first.last_outside(-level, level), *whole.last_outside(-level, level), 1e-9) << level;
}

struct Watched {
  SpeedRecorder speed;
  std::int64_t evaluations = 0;
};

Watched watched(const std::shared_ptr<const Model>& model, const SpeedRecorder* before) {
  Watched w{SpeedRecorder(4, before)};
  Equations equations(model, true);
  RunOptions options;
  options.tolerance = 1e-8;
  options.until = 4;
  const RunOutcome outcome = integrate(equations, options, {&w.speed});
  EXPECT_TRUE(outcome.complete) << outcome.diagnosis;
  w.evaluations = outcome.statistics.stepper.flow_calls;
  return w;
}

// The run repeated looks between the ends of the few steps that pass the levels requested in the first one, and finds
// the same bits; what lies elsewhere it does not claim to know.
TEST(SpeedRecorder, ARunRepeatedLooksCloselyWhereItWillBeAsked) {
  const Scene scene = test::scene_file("scenes/crank_press.toml");
  const auto model = compile(scene, scene.effects);
  const Watched first = watched(model, nullptr);
  const auto last_outside = [](const Watched& w, double low, double high) {
    return w.speed.driven().last_outside(low, high);
  };
  const std::vector<std::pair<double, double>> bands = {{2, 9}, {5.9, 6.6}, {-3, 3}};
  for (const auto& [low, high] : bands) last_outside(first, low, high);
  const Watched again = watched(model, &first.speed);
  for (const auto& [low, high] : bands) {
    const std::optional<double> time = last_outside(first, low, high);
    ASSERT_TRUE(time) << low;
    EXPECT_EQ(last_outside(again, low, high), time) << low;
    EXPECT_EQ(again.speed.works_at(*time), first.speed.works_at(*time)) << low;
  }
  EXPECT_TRUE(again.speed.answered());
  EXPECT_LT(again.evaluations, 0.9 * static_cast<double>(first.evaluations));
  last_outside(again, 4, 9);
  EXPECT_FALSE(again.speed.answered());
}

}  // namespace
}  // namespace kurbel::speed_history_test
