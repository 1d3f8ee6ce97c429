// fit_cycles_test.cpp — records of few cycles: scatters, intervals that hold as often as they say, what stands first where
// the machine does not show what was measured.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>

#include "studies/fit/fit.h"
#include "studies/history/spectrum.h"
#include "tests/support/files.h"

namespace kurbel::fit_cycles_test {
namespace {

// A rotor that drag slows down: ω = ω₀ e^{−bt/J}, ω₀ = 100 rad/s, J = 0.5 kg·m², b = 0.2 N·m·s/rad.
constexpr double damping = 0.2, inertia = 0.5, omega0 = 100;
double coasted(double t) { return omega0 * std::exp(-damping * t / inertia); }
std::string coasting(double rotor = inertia) {
  return fmt::format(
      "line = [\"rotor\", \"drag\"]\nrotor = {{ kind = \"flywheel\", inertia = \"{} kg*m2\" }}\ndrag = {{ kind = "
      "\"bearing drag\", damping = \"0.3 N*m*s/rad\" }}\n[run]\nstart = {{ speed = \"100 rad/s\" }}\nuntil = \"4 s\"\n"
      "accuracy = 1e-8\n",
      rotor);
}

class FitCycles : public testing::Test {
 protected:
  std::string file(const std::string& text) const {
    const std::string path = folder_ / "record.csv";
    std::ofstream(path) << text;
    return path;
  }
  // Every point with noise of its own, every cycle with a level of its own.
  std::string cycles(int count, double noise, double level, std::uint64_t seed, int points = 61) const {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0, 1);
    std::vector<double> levels;
    std::string text = "t [s]";
    for (int k = 0; k < count; ++k) {
      text += fmt::format(",c{} [rad/s]", k + 1);
      levels.push_back(level * normal(random));
    }
    for (int i = 0; i < points; ++i) {
      const double t = 3.0 * i / (points - 1);
      text += fmt::format("\n{}", t);
      for (int k = 0; k < count; ++k)
        text += fmt::format(",{}", coasted(t) + levels[static_cast<std::size_t>(k)] + noise * normal(random));
    }
    return file(text + "\n");
  }
  static FitStudy fitted(const std::string& scene, const std::string& record, std::vector<std::string> maps,
                         std::vector<std::string> free) {
    FitOptions options;
    RecordRequest& r = options.records.emplace_back();
    r.name = "test", r.file = record, r.over = Over::time, r.maps = std::move(maps);
    r.scene.text = scene, r.scene.file = "test.toml";
    options.free = std::move(free), options.checks = false;
    return fit_machine(options);
  }
  const test::ScratchFolder folder_;
};

// Of 2, 3 and 12 cycles, each point scattering by itself or with its cycle: of 40 records, whose two intervals hold together
// or not, fewer than 34 hold once in a thousand times (binomial, 95 %). Points that scatter by themselves give the error of all
// of them, σ/√n times that of a line of one cycle; a cycle's level is one value, and its intervals Student's of n − 1.
TEST_F(FitCycles, IntervalsHold) {
  constexpr int trials = 40;
  for (const int count : {2, 3, 12})
    for (const double level : {0.0, 2.0}) {
      int held[] = {0, 0};
      double squares = 0, error = 0;
      for (int k = 0; k < trials; ++k) {
        const FitStudy found =
            fitted(coasting(), cycles(count, 1, level, static_cast<std::uint64_t>(100 * count + k)), {"c*=speed.rotor"},
                   {"drag.damping=0.05..0.6 N*m*s/rad", "run.start.speed=50..150 rad/s"});
        const double truth[] = {damping, omega0};
        for (int u = 0; u < 2; ++u) {
          const FittedUnknown& one = found.unknowns.at(static_cast<std::size_t>(u));
          ASSERT_TRUE(one.low && one.high) << one.remark;
          held[u] += *one.low <= truth[u] && truth[u] <= *one.high;
        }
        squares += std::pow(found.unknowns[0].value - damping, 2) / trials;
        error += *found.unknowns[0].error / trials;
        EXPECT_EQ(found.conclusion.find("times the scatter"), std::string::npos) << found.conclusion;
      }
      const std::string what = fmt::format("{} cycles, level {}", count, level);
      EXPECT_GE(held[0], 34) << what;
      EXPECT_GE(held[1], 34) << what;
      if (level > 0) continue;
      EXPECT_NEAR(std::sqrt(squares) / error, 1, 0.35) << what << ", z";
      // 61 points of ω₀ e^{−bt/J}, b and ω₀ free: by the normal equations.
      double bb = 0, bw = 0, ww = 0;
      for (int i = 0; i < 61; ++i) {
        const double t = 0.05 * i, by_b = -t / inertia * coasted(t), by_w = coasted(t) / omega0;
        bb += by_b * by_b, bw += by_b * by_w, ww += by_w * by_w;
      }
      EXPECT_NEAR(error * std::sqrt(count) / std::sqrt(ww / (bb * ww - bw * bw)), 1, 0.2) << what;
    }
}

// Three cycles: no point has the scatter of its own three values; what differs over the record, as twelve cycles show, stays.
TEST_F(FitCycles, AWeightIsThatOfNeighbours) {
  RecordRequest request;
  request.name = "test", request.over = Over::time, request.maps = {"c*=speed.rotor"};
  request.scene.text = coasting(), request.scene.file = "test.toml";
  request.file = cycles(3, 1, 0, 5, 401);
  const FitRecord few = read_record(request);
  for (const double s : few.channels.at(0).scatter) EXPECT_NEAR(s, 1, 0.5);

  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0, 1);
  std::string text = "t [s]";
  for (int k = 0; k < 12; ++k) text += fmt::format(",c{} [rad/s]", k + 1);
  for (int i = 0; i < 400; ++i) {
    text += fmt::format("\n{}", 0.01 * i);
    for (int k = 0; k < 12; ++k) text += fmt::format(",{}", coasted(0.01 * i) + (i < 200 ? 1 : 10) * normal(random));
  }
  request.file = file(text + "\n");
  const FitRecord record = read_record(request);
  double early = 0, late = 0;
  for (std::size_t i = 0; i < 190; ++i)
    early += record.channels[0].scatter[i] / 190, late += record.channels[0].scatter[i + 210] / 190;
  EXPECT_NEAR(early, 1, 0.05);
  EXPECT_NEAR(late, 10, 0.5);
}

// A speed in rpm that is read as one in Hz.
TEST_F(FitCycles, WhatTheMachineDoesNotShowStandsFirst) {
  std::string text = "t [s],n\n";
  for (int i = 0; i < 61; ++i) text += fmt::format("{},{}\n", 0.05 * i, coasted(0.05 * i) * 30 / std::numbers::pi);
  const std::string record = file(text);
  const std::vector<std::string> free = {"drag.damping=0.05..0.6 N*m*s/rad"};
  const FitStudy wrong = fitted(coasting(), record, {"n=speed.rotor [Hz]"}, free);
  EXPECT_TRUE(wrong.conclusion.starts_with("The machine does not show what was measured")) << wrong.conclusion;
  EXPECT_NE(wrong.conclusion.find("a unit or a fixed value is wrong"), std::string::npos) << wrong.conclusion;
  EXPECT_EQ(wrong.conclusion.find("±"), std::string::npos) << wrong.conclusion;
  EXPECT_FALSE(wrong.unknowns.at(0).low || wrong.unknowns[0].error);
  const FitStudy right = fitted(coasting(), record, {"n=speed.rotor [rpm]"}, free);
  EXPECT_TRUE(right.conclusion.starts_with("drag.damping = 0.2")) << right.conclusion;
  EXPECT_TRUE(right.unknowns.at(0).low);
}

// Bands of a record of 801 points, no power of two: their mean squares are together that of the record about its mean.
TEST_F(FitCycles, BandsAreOfTheWholeRecord) {
  std::string text = "t [s],n [rad/s]\n";
  double mean = 0, squares = 0;
  for (int i = 0; i < 801; ++i) {
    const double t = 0.004 * i, speed = coasted(t) + (i < 200 ? 3 * std::sin(2 * std::numbers::pi * 40 * t) : 0);
    mean += speed / 801, squares += speed * speed / 801;
    text += fmt::format("{},{}\n", t, speed);
  }
  const FitStudy found = fitted(coasting(), file(text), {"n=speed.rotor"}, {"drag.damping=0.05..0.6 N*m*s/rad"});
  double measured = 0, at_40 = 0;
  for (const BandResidual& band : found.bands) {
    measured += band.measured * band.measured;
    if (band.from < 40 && band.to >= 40) at_40 = band.left;
  }
  EXPECT_NEAR(measured, squares - mean * mean, 1e-4 * squares);
  EXPECT_NEAR(at_40, 3 / std::sqrt(2.0) * std::sqrt(200.0 / 801), 0.03) << "a vibration at the beginning counts, too";
}

// Of any number of values, also a prime one: Σ p_k is their mean square; n half waves are the n-th line alone.
TEST(Powers, AddUpToTheMeanSquare) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(2, 1);
  for (const std::size_t n : {1u, 2u, 17u, 512u, 801u, 1009u}) {
    std::vector<double> values(n), waves(n);
    double square = 0, sum = 0;
    const std::size_t line = n / 3;
    for (std::size_t i = 0; i < n; ++i) {
      values[i] = normal(random);
      square += values[i] * values[i] / static_cast<double>(n);
      waves[i] = 3 * std::cos(std::numbers::pi * static_cast<double>(line) * (static_cast<double>(i) + 0.5) /
                              static_cast<double>(n));
    }
    for (const double p : powers_of(values)) sum += p;
    EXPECT_NEAR(sum, square, 1e-12 * square) << n;
    const std::vector<double> powers = powers_of(waves);
    for (std::size_t k = 0; k < n; ++k)
      EXPECT_NEAR(powers[k], k != line ? 0 : k == 0 ? 9 : 4.5, 1e-10) << n << ", " << k;
  }
}

}  // namespace
}  // namespace kurbel::fit_cycles_test
