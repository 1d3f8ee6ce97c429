// newton_test.cpp — Newton's method with damping: closed solutions, and what it promises to have evaluated last.
#include "engine/return_map/newton.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/matrices/linear_algebra.h"
#include "engine/return_map/family.h"

namespace kurbel::newton_test {
namespace {

// Whoever keeps what the last evaluation gave (an image of the return map) has that of the solution, with derivative, also
// where round-off stops the descent at a trial beside it.
TEST(Newton, EvaluatesLastAtTheSolutionWithDerivative) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int solved = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Index n = 1 + i % 4;
    Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return uniform(random); });
    a += 3 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd wanted = Eigen::VectorXd::NullaryExpr(n, [&] { return uniform(random); });
    const double noise = std::pow(10, -10.5 - 4 * (0.5 + 0.5 * uniform(random)));
    Eigen::VectorXd last;
    bool with_derivative = false;
    NewtonSystem system;
    system.magnitude = 2;
    system.evaluate = [&](const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* derivative) {
      last = x;
      with_derivative = derivative != nullptr;
      residual = a * (x - wanted) + (x - wanted).cwiseAbs2();
      for (double& r : residual) r += noise * uniform(random);
      if (derivative) *derivative = a + 2 * Eigen::MatrixXd((x - wanted).asDiagonal());
      return true;
    };
    const NewtonOutcome out = solve(system, Eigen::VectorXd::Zero(n), 1e-11);
    if (!out.found) continue;
    ++solved;
    EXPECT_TRUE(with_derivative);
    EXPECT_EQ(last, out.x);
    EXPECT_LT((out.x - wanted).norm(), 1e-8);
  }
  EXPECT_GT(solved, 150);
}

// Steps have a greatest length; a far solution is reached by several of them, each of which counts as progress.
TEST(Newton, ReachesAFarSolutionByLimitedSteps) {
  NewtonSystem system;
  system.evaluate = [](const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* derivative) {
    residual = Eigen::VectorXd::Constant(1, 2e-4 * (x[0] - 3));  // a machine that settles slowly
    if (derivative) *derivative = Eigen::MatrixXd::Constant(1, 1, 2e-4);
    return true;
  };
  const NewtonOutcome out = solve(system, Eigen::VectorXd::Zero(1), 1e-12);
  ASSERT_TRUE(out.found) << out.why;
  EXPECT_NEAR(out.x[0], 3, 1e-7);
}

// x ↦ x + r(x) keeps one, two or three quantities, whatever the noise of its derivative: so does the solution.
TEST(Newton, KeepsAllQuantitiesOfAFamily) {
  std::mt19937 random(41);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto some = [&](Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(random); }));
  };
  for (int i = 0; i < 60; ++i) {
    const Eigen::Index n = 4 + i % 3, kept = 1 + i % 3, rest = n - kept;
    const Eigen::MatrixXd quantities = some(n, kept);
    const Eigen::MatrixXd moves = full_basis(quantities).rightCols(rest);  // what no quantity sees
    Eigen::MatrixXd reads = moves.transpose() + 0.3 * some(rest, n);
    const double noise = 1e-10;
    NewtonSystem system;
    system.magnitude = 2;
    system.evaluate = [&](const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* derivative) {
      const Eigen::VectorXd u = reads * x - Eigen::VectorXd::Constant(rest, 0.2);
      residual = moves * (-0.5 * u - 0.1 * u.cwiseAbs2());
      for (double& r : residual) r += 1e-14 * uniform(random);
      if (derivative) *derivative = moves * (-0.5 - 0.2 * u.array()).matrix().asDiagonal() * reads + noise * some(n, n);
      return true;
    };
    const Eigen::VectorXd guess = 0.3 * some(n, 1);
    const NewtonOutcome out = solve_in_family(system, guess, 1e-11, [&] { return noise; });
    ASSERT_TRUE(out.found) << out.why;
    EXPECT_LT((quantities.transpose() * (out.x - guess)).norm(), 1e-9) << n << " " << kept;
  }
}

}  // namespace
}  // namespace kurbel::newton_test
