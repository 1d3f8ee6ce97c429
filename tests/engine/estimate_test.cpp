// estimate_test.cpp — errors of sums, products and functions against closed forms and against the worst of what they cover.
#include "engine/base/estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace kurbel::estimate_test {
namespace {

TEST(Estimate, SumsAddErrorsAndFactorsScaleThem) {
  const Estimate a{3, 0.25}, b{-5, 0.5};
  EXPECT_EQ((a + b).value, -2);
  EXPECT_EQ(*(a + b).error, 0.75);
  EXPECT_EQ((a - b).value, 8);
  EXPECT_EQ(*(a - b).error, 0.75);
  EXPECT_EQ(*(-2.0 * b).error, 1);
  EXPECT_EQ(*(b / -2.0).error, 0.25);
  EXPECT_EQ((-b).value, 5);
  EXPECT_EQ(abs(b).value, 5);
  EXPECT_EQ(*abs(b).error, 0.5);
}

TEST(Estimate, ProductsAndQuotientsHaveTheirDerivatives) {
  const Estimate a{3, 0.25}, b{-5, 0.5};
  EXPECT_EQ((a * b).value, -15);
  EXPECT_DOUBLE_EQ(*(a * b).error, 5 * 0.25 + 3 * 0.5);
  EXPECT_EQ((a / b).value, -0.6);
  EXPECT_DOUBLE_EQ(*(a / b).error, 0.25 / 5 + 3 * 0.5 / 25);
  EXPECT_DOUBLE_EQ(*function_of(a, std::log(3), 1.0 / 3).error, 0.25 / 3);
}

// Of small errors: no values within them make more than is stated, but for second order. Of a product and a quotient some
// make just that; where a number comes in twice it may be less.
TEST(Estimate, StatedIsWhatTheWorstMakes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> size(1, 4), part(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const Estimate a{std::copysign(size(random), part(random)), 1e-6},
        b{std::copysign(size(random), part(random)), 2e-6};
    const auto worst = [&](auto&& of) {
      double most = 0;
      for (const int left : {-1, 1})
        for (const int right : {-1, 1}) {
          const double x = a.value + left * *a.error, y = b.value + right * *b.error;
          most = std::max(most, std::abs(of(x, y) - of(a.value, b.value)));
        }
      return most;
    };
    const double product = worst([](double x, double y) { return x * y; }),
                 quotient = worst([](double x, double y) { return x / y; });
    EXPECT_NEAR(product, *(a * b).error, 1e-11);
    EXPECT_NEAR(quotient, *(a / b).error, 1e-4 * quotient);
    const Estimate made = abs(a * b) / (a * a + b * b);
    EXPECT_LE(worst([](double x, double y) { return std::abs(x * y) / (x * x + y * y); }), *made.error * 1.001);
  }
}

TEST(Estimate, UnknownStaysUnknownButForWhatIsAdded) {
  const Estimate unknown{2}, known{3, 0.1};
  EXPECT_FALSE((unknown + known).error);
  EXPECT_FALSE((unknown * known).error);
  EXPECT_FALSE((known / unknown).error);
  EXPECT_FALSE((2.0 * unknown).error);
  EXPECT_FALSE(function_of(unknown, 4, 4).error);
  EXPECT_FALSE(larger_error(unknown, known));
  EXPECT_EQ(*larger_error(known, {1, 0.3}), 0.3);
  Estimate widened = unknown;
  widened.widen(0.5);
  EXPECT_EQ(*widened.error, 0.5);
}

TEST(Estimate, RunsAreComparedByTheirDifference) {
  Estimate e = estimate_from(2, 2.25, 0.125);
  EXPECT_EQ(e.value, 2);
  EXPECT_EQ(*e.error, 0.375);
  e.widen_to({1.5}, 3);
  EXPECT_EQ(*e.error, 0.375 + 3 * 0.5);
}

}  // namespace
}  // namespace kurbel::estimate_test
