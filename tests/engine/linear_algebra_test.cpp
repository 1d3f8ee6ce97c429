// linear_algebra_test.cpp — full real matrices whose eigenvalues are known; what cannot be found is refused.
#include "engine/matrices/linear_algebra.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace kurbel::linear_algebra_test {
namespace {

// [[0, 1], [−ω², −2ζω]]: λ = −ζω ± i ω √(1 − ζ²).
TEST(Eigenpairs, OfADampedOscillationAreItsClosedForm) {
  const double omega = 7, zeta = 0.2;
  Eigen::MatrixXd a(2, 2);
  a << 0, 1, -omega * omega, -2 * zeta * omega;
  const auto [values, vectors] = eigenpairs(a);
  for (Eigen::Index i = 0; i < 2; ++i) {
    EXPECT_NEAR(values[i].real(), -zeta * omega, 1e-13);
    EXPECT_NEAR(std::abs(values[i].imag()), omega * std::sqrt(1 - zeta * zeta), 1e-13);
    EXPECT_LT((a * vectors.col(i) - values[i] * vectors.col(i)).norm(), 1e-13);
  }
  EXPECT_NEAR((eigenvalues(a) - values).norm(), 0, 1e-13);
}

TEST(Eigenpairs, WhatIsNoNumberIsRefused) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(3, 3);
  a(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(eigenpairs(a), std::runtime_error);
  EXPECT_THROW(eigenvalues(a), std::runtime_error);
  EXPECT_EQ(eigenvalues(Eigen::MatrixXd()).size(), 0);
}

}  // namespace
}  // namespace kurbel::linear_algebra_test
