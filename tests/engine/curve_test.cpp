// curve_test.cpp — characteristics by points: linear, smooth, periodic.
#include "engine/numerics/curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace kurbel::curve_test {
namespace {

using Form = Curve::Form;

double slope_in(const Curve& c, int piece, double x) {
  const double h = 1e-6;
  return (c.value_in(piece, x + h) - c.value_in(piece, x - h)) / (2 * h);
}

TEST(Curve, LinearRunsStraightBetweenPointsAndConstantOutside) {
  const Curve c({0, 1, 3}, {0, 2, -2}, Form::linear);
  EXPECT_DOUBLE_EQ(c.value(0.25), 0.5);
  EXPECT_DOUBLE_EQ(c.value(2.0), 0);
  EXPECT_DOUBLE_EQ(c.value(-5.0), 0);
  EXPECT_DOUBLE_EQ(c.value(5.0), -2);
  EXPECT_DOUBLE_EQ(c.max_abs(), 2);
}

// Laws are simplified and their speeds scaled by it, whichever side of zero they lie on.
TEST(Curve, GreatestMagnitudeIsWithoutItsSign) {
  EXPECT_EQ(Curve({0, 1, 2}, {-5, -1, -3}, Form::linear).max_abs(), 5);
  EXPECT_EQ(Curve({0, 1, 2}, {2, -4, 3}, Form::linear).max_abs(), 4);
}

TEST(Curve, PiecesAreNumberedFromMinusOneToTheLastPoint) {
  const Curve c({0, 1, 3}, {0, 2, -2}, Form::linear);
  EXPECT_EQ(c.piece(-0.1), -1);
  EXPECT_EQ(c.piece(0), 0);
  EXPECT_EQ(c.piece(0.999), 0);
  EXPECT_EQ(c.piece(1), 1);
  EXPECT_EQ(c.piece(3), 2);
  EXPECT_EQ(c.piece_begin(-1), -HUGE_VAL);
  EXPECT_EQ(c.piece_end(-1), 0);
  EXPECT_EQ(c.piece_begin(1), 1);
  EXPECT_EQ(c.piece_end(2), HUGE_VAL);
}

TEST(Curve, SmoothPassesThroughItsPointsWithContinuousSlope) {
  const Curve c({0, 1, 3, 4}, {0, 2, 3, 3.5}, Form::smooth);
  for (std::size_t i = 1; i + 1 < 4; ++i) {
    const double x = c.x()[i];
    const int right = c.piece(x);
    EXPECT_NEAR(c.value_in(right - 1, x), c.y()[i], 1e-14);
    EXPECT_NEAR(c.value_in(right, x), c.y()[i], 1e-14);
    EXPECT_NEAR(slope_in(c, right - 1, x), slope_in(c, right, x), 1e-8);
  }
}

// Monotone data make a monotone curve, and no curve overshoots the points on either side.
TEST(Curve, SmoothNeverOvershootsItsPoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> step(0.01, 1), height(-5, 5);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> x = {0}, y = {height(random)};
    for (int i = 0; i < 8; ++i) {
      x.push_back(x.back() + step(random));
      y.push_back(trial % 2 ? y.back() + step(random) * step(random) : height(random));
    }
    const Curve c(x, y, Form::smooth);
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      double last = y[i];
      const double sign = y[i + 1] >= y[i] ? 1 : -1;
      for (int k = 1; k <= 50; ++k) {
        const double value = c.value_in(static_cast<int>(i), x[i] + (x[i + 1] - x[i]) * k / 50);
        EXPECT_GE(sign * (value - last), -1e-12);
        last = value;
      }
    }
  }
}

TEST(Curve, PeriodicRepeatsAndClosesItself) {
  for (const Form form : {Form::linear, Form::smooth}) {
    const Curve c({0, 1, 2}, {0, 3, 1}, form, 4);  // the point (4, 0) is added
    EXPECT_EQ(c.x().size(), 4u);
    for (const double x : {-7.3, -0.1, 0.4, 3.9})
      for (const int turns : {-3, 1, 10}) EXPECT_NEAR(c.value(x + 4.0 * turns), c.value(x), 1e-12);
    EXPECT_NEAR(c.value(4 - 1e-12), c.value(0.0), 1e-11);
    EXPECT_EQ(c.within(9.0), 1);
    EXPECT_EQ(c.within(-0.5), 3.5);
  }
}

TEST(Curve, SmoothPeriodicHasTheSameSlopeAtBothEnds) {
  const Curve c({0, 1, 2, 3}, {0, 1, 3, 2}, Form::smooth, 3.5);
  const int last = static_cast<int>(c.x().size()) - 2;
  EXPECT_NEAR(slope_in(c, 0, 0), slope_in(c, last, 3.5), 1e-8);
}

TEST(Curve, ClosingPointOfEqualValueIsTheFirstPoint) {
  const Curve c({0, 1, 4}, {2, 3, 2}, Form::linear, 4);
  EXPECT_EQ(c.x().size(), 3u);
  EXPECT_NEAR(c.value(5.0), 3, 1e-14);
}

TEST(Curve, UnfitPointsAreRefused) {
  EXPECT_THROW(Curve({0}, {1}, Form::linear), std::invalid_argument);
  EXPECT_THROW(Curve({}, {}, Form::smooth), std::invalid_argument);
  EXPECT_THROW(Curve({0, 1}, {1}, Form::linear), std::invalid_argument);
  EXPECT_THROW(Curve({0, 0}, {1, 2}, Form::linear), std::invalid_argument);
  EXPECT_THROW(Curve({0, 2, 1}, {1, 2, 3}, Form::linear), std::invalid_argument);
  EXPECT_THROW(Curve({0, std::nan("")}, {1, 2}, Form::linear), std::invalid_argument);
  EXPECT_THROW(Curve({0, 5}, {1, 2}, Form::linear, 4), std::invalid_argument);
  EXPECT_THROW(Curve({0, 4}, {1, 2}, Form::linear, 4), std::invalid_argument);
}

// --- fewer pieces ---

// Two humps, a jump and a kink: what fewer pieces are off by at many places.
double most_off(const Curve& a, const Curve& b) {
  double most = 0;
  for (int k = 0; k < 40000; ++k) {
    const double x = a.x().front() + (a.x().back() - a.x().front()) * (k + 0.5) / 40000;
    most = std::max(most, std::abs(a.value(x) - b.value(x)));
  }
  return most;
}

// A piece of more than three quarters of two turns becomes two; periods are distinguished within two turns.
TEST(Curve, OverAnAngleIsTheSameLawInPiecesThatAreToldApart) {
  const double turns[] = {4 * M_PI, 2 * M_PI, M_PI / 3};
  for (const Curve::Form form : {Curve::Form::linear, Curve::Form::smooth})
    for (const double period : turns) {
      const Curve given({0.1, 0.1 + 0.02 * period, 0.1 + 0.05 * period}, {3, -2, 5}, form, period);
      const Curve made = given.over_angle();
      EXPECT_EQ(made.pieces(), period > 10 ? 4 : 3);
      EXPECT_NEAR(made.periods() * period, 4 * M_PI, 1e-12);
      for (double x = -7; x < 20; x += 0.37) EXPECT_NEAR(made.value(x), given.value(x), 1e-12) << x;
    }
}

TEST(Curve, FewerPiecesAreNoFartherOffThanTheyMay) {
  std::vector<double> x, y;
  for (int k = 0; k <= 3000; ++k) {
    x.push_back(k * 1e-3);
    y.push_back(std::sin(3 * x.back()) + std::exp(-20 * (x.back() - 1) * (x.back() - 1)));
  }
  for (const Form form : {Form::linear, Form::smooth})
    for (const double period : {0.0, 4.0})
      for (const double within : {1e-3, 1e-5, 1e-6}) {
        const Curve all(x, y, form, period), fewer = all.by_fewer_pieces(within);
        // Corners of the straight pieces are 5e-6 high: within less than that each is a place of its own where it bends most.
        EXPECT_LT(fewer.x().size(), form == Form::linear && within < 5e-6 ? 1000u : 300u);
        EXPECT_LE(most_off(all, fewer), 1.02 * within);
        EXPECT_FALSE(fewer.jumps() && period == 0 && fewer.before() == fewer.y().front());
        EXPECT_EQ(fewer.x().front(), all.x().front());
        EXPECT_EQ(fewer.x().back(), all.x().back());
        EXPECT_EQ(fewer.y().front(), all.y().front());
        EXPECT_EQ(fewer.y().back(), all.y().back());
        EXPECT_EQ(fewer.period(), period);
        double area = 0;
        for (std::size_t i = 0; i + 1 < fewer.x().size(); ++i)
          area += fewer.area(static_cast<int>(i), fewer.x()[i], fewer.x()[i + 1]);
        for (std::size_t i = 0; i + 1 < all.x().size(); ++i)
          area -= all.area(static_cast<int>(i), all.x()[i], all.x()[i + 1]);
        EXPECT_LT(std::abs(area), 0.3 * within);
      }
}

TEST(Curve, FewerPiecesKeepJumpsAndKinksAndWhatIsRough) {
  std::vector<double> x, y;
  for (int k = 0; k <= 1000; ++k) {
    x.push_back(k * 1e-3), y.push_back(k <= 500 ? 2 * x.back() : 1.5 - x.back());
    if (k == 300) x.push_back(x.back()), y.push_back(y.back() + 0.25);
  }
  const Curve all(x, y, Form::linear), fewer = all.by_fewer_pieces(1e-9);
  EXPECT_TRUE(fewer.jumps());
  EXPECT_EQ(std::count(fewer.x().begin(), fewer.x().end(), 0.3), 1);
  EXPECT_EQ(std::count(fewer.x().begin(), fewer.x().end(), 0.5), 1);
  EXPECT_LT(fewer.x().size(), 12u);
  EXPECT_LE(most_off(all, fewer), 1e-9);
  std::mt19937 random(3);
  for (double& v : y) v = std::uniform_real_distribution<>(-1, 1)(random);
  const Curve rough(x, y, Form::linear);
  EXPECT_EQ(rough.by_fewer_pieces(1e-6).x().size(), rough.x().size());
}

}  // namespace
}  // namespace kurbel::curve_test
