// bounded_fit_test.cpp — bounds, directions that the data do not see, and what each value determines.
#include "studies/fit/bounded_fit.h"

#include <gtest/gtest.h>

namespace kurbel::bounded_fit_test {
namespace {

// min (x − 2)² + (y − 1/4)² in the unit square: x presses against 1.
TEST(BoundedFit, HoldsWhatPressesAgainstABound) {
  const BoundedProblem problem{
      .residuals = [](const Eigen::VectorXd& u) -> std::optional<Eigen::VectorXd> {
        return Eigen::Vector2d(u[0] - 2, u[1] - 0.25);
      },
      .derivative = [](const Eigen::VectorXd&, const Eigen::VectorXd&) -> std::optional<Eigen::MatrixXd> {
        return Eigen::MatrixXd::Identity(2, 2);
      }};
  const BoundedFit fit = fit_within_bounds(problem, Eigen::Vector2d(0.1, 0.9));
  EXPECT_NEAR(fit.u[0], 1, 1e-12);
  EXPECT_NEAR(fit.u[1], 0.25, 1e-6);
  EXPECT_EQ(fit.on_bound, (std::vector<int>{1, 0}));
}

// min (x + 1)² + (y − 1/2)² from the corner 0, 0: x presses against it, y wants away.
TEST(BoundedFit, OfTwoOnTheirLowerBoundTheOneThatPressesIsHeld) {
  const BoundedProblem problem{
      .residuals = [](const Eigen::VectorXd& u) -> std::optional<Eigen::VectorXd> {
        return Eigen::Vector2d(u[0] + 1, u[1] - 0.5);
      },
      .derivative = [](const Eigen::VectorXd&, const Eigen::VectorXd&) -> std::optional<Eigen::MatrixXd> {
        return Eigen::MatrixXd::Identity(2, 2);
      }};
  const BoundedFit fit = fit_within_bounds(problem, Eigen::Vector2d::Zero());
  EXPECT_EQ(fit.u[0], 0);
  EXPECT_NEAR(fit.u[1], 0.5, 1e-6);
  EXPECT_EQ(fit.on_bound, (std::vector<int>{-1, 0}));
}

// Two columns in the ratio 3: the direction (1, −1) of columns of equal length is not seen; the third is known.
TEST(BoundedFit, NamesTheDirectionThatColumnsShare) {
  Eigen::MatrixXd j(4, 3);
  j << 1, 3, 0, 2, 6, 1, 0, 0, 1, 1, 3, -1;
  const Determination d = determined_by(j, {0, 0, 0}, 1e-4);
  ASSERT_EQ(d.undetermined.size(), 1u);
  ASSERT_EQ(d.undetermined[0].unknowns.size(), 2u);
  EXPECT_NEAR(d.undetermined[0].parts[0] / d.undetermined[0].parts[1], -1, 1e-9);
  EXPECT_EQ(d.known, (std::vector<bool>{false, false, true}));
  // Cov of the third: 1/(|c|² − (c·a)²/|a|²), a = (1, 2, 0, 1), c = (0, 1, 1, −1).
  EXPECT_NEAR(d.covariance(2, 2), 1 / (3.0 - 1.0 / 6), 1e-9);
  // Nor is it where one of the two ends on its bound.
  const Determination bound = determined_by(j, {0, 1, 0}, 1e-4);
  ASSERT_EQ(bound.undetermined.size(), 1u);
  EXPECT_EQ(bound.known, (std::vector<bool>{false, false, true}));
}

// A straight line through x = 0, 1, 2, 5: h_i = 1/4 + (x_i − 2)²/14. A slope on its bound is not determined, and of two
// equal columns one unknown alone.
TEST(BoundedFit, SaysHowMuchEachValueDetermines) {
  Eigen::MatrixXd j(4, 3);
  j << 1, 0, 1, 1, 1, 1, 1, 2, 1, 1, 5, 1;
  const Eigen::Vector4d line(1 / 4.0 + 4 / 14.0, 1 / 4.0 + 1 / 14.0, 1 / 4.0, 1 / 4.0 + 9 / 14.0);
  EXPECT_LT((leverage(j, {0, 0, 0}, 1e-4) - line).norm(), 1e-12);
  EXPECT_LT((leverage(j, {0, 1, 0}, 1e-4) - Eigen::Vector4d::Constant(0.25)).norm(), 1e-12);
  EXPECT_EQ(leverage(j, {1, 1, -1}, 1e-4), Eigen::Vector4d::Zero());
}

}  // namespace
}  // namespace kurbel::bounded_fit_test
