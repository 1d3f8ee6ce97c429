// Eigenvalues of a product of matrices by a periodic QR iteration: against what the product is made of, and against the
// product in extended precision where that can hold it.
#include "engine/matrices/periodic_schur.h"
#include "tests/support/eigen_solutions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace kurbel::periodic_schur_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Complex = std::complex<double>;

MatrixXd random_matrix(std::mt19937& random, Index n) {
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
}

// A_k = X_{k+1} D_k X_k⁻¹ with bases X of a condition below 10: eigenvalues are those of Π D_k.
std::vector<MatrixXd> in_turning_bases(std::mt19937& random, const std::vector<MatrixXd>& diagonal) {
  const std::size_t count = diagonal.size();
  const Index n = diagonal.front().rows();
  std::vector<MatrixXd> basis, factors;
  for (std::size_t k = 0; k < count; ++k) basis.push_back(MatrixXd::Identity(n, n) + 0.15 * random_matrix(random, n));
  for (std::size_t k = 0; k < count; ++k)
    factors.push_back(basis[(k + 1) % count] * diagonal[k] * test::inverse(basis[k]));
  return factors;
}

double turned(double difference) { return std::remainder(difference, 2 * std::numbers::pi); }

TEST(PeriodicSchur, EigenvaluesSpreadOver200OrdersComeOutToTheirLastDigits) {
  std::mt19937 random(1);
  const std::vector<double> ln = {0, -0.01, -40, -150, -300, -460};  // of the product
  for (const std::size_t count : {40u, 97u}) {
    MatrixXd d = MatrixXd::Zero(6, 6);
    for (Index i = 0; i < 6; ++i) d(i, i) = std::exp(ln[static_cast<std::size_t>(i)] / static_cast<double>(count));
    const std::vector<MatrixXd> factors = in_turning_bases(random, std::vector<MatrixXd>(count, d));
    const PeriodicSchur schur(factors);
    MatrixXd product = MatrixXd::Identity(6, 6);
    for (const MatrixXd& factor : factors) product = factor * product;
    Eigen::VectorXd naive = test::eigen_solution(product).values.cwiseAbs();
    std::sort(naive.begin(), naive.end(), std::greater<>());
    for (std::size_t j = 0; j < ln.size(); ++j) {
      const PeriodicEigenvalue& found = schur.eigenvalues()[j];
      EXPECT_NEAR(found.log_magnitude, ln[j], 1e-10) << j;
      EXPECT_NEAR(found.phase, 0, 1e-11) << j;
      EXPECT_LE(std::abs(found.log_magnitude - ln[j]), found.error) << j;
      EXPECT_LT(found.error, 1e-7) << j;
      const double by_product = std::log(naive[static_cast<Index>(j)]);
      EXPECT_EQ(std::abs(by_product - ln[j]) > 1, j >= 2) << j;  // which has lost it
    }
  }
}

TEST(PeriodicSchur, PairsThatTurnKeepTheirPhaseWhereTheyHaveAllButVanished) {
  std::mt19937 random(2);
  constexpr std::size_t count = 60;
  const double a = 0.037, b = 0.4, small = std::exp(-280.0 / count);
  MatrixXd d = MatrixXd::Zero(5, 5);
  d.block<2, 2>(0, 0) << std::cos(a), -std::sin(a), std::sin(a), std::cos(a);
  d.block<2, 2>(2, 2) << small * std::cos(b), -small * std::sin(b), small * std::sin(b), small * std::cos(b);
  d(4, 4) = -std::exp(-100.0 / count);  // even number of signs
  const PeriodicSchur schur(in_turning_bases(random, std::vector<MatrixXd>(count, d)));
  const auto& e = schur.eigenvalues();
  EXPECT_NEAR(e[0].log_magnitude, 0, 1e-11);
  EXPECT_NEAR(std::abs(e[0].phase), std::abs(turned(count * a)), 1e-11);
  EXPECT_NEAR(e[0].phase, -e[1].phase, 1e-11);
  EXPECT_NEAR(e[2].log_magnitude, -100, 1e-10);
  EXPECT_NEAR(e[2].phase, 0, 1e-10);
  EXPECT_NEAR(e[3].log_magnitude, -280, 1e-10);
  EXPECT_NEAR(std::abs(e[3].phase), std::abs(turned(count * b)), 1e-10);
  EXPECT_NEAR(e[3].phase, -e[4].phase, 1e-10);
}

// Of few factors without extremes, the product in extended precision is right; what differs lies within what is stated.
TEST(PeriodicSchur, IsTheProductsSpectrumWhereThatIsMild) {
  std::mt19937 random(3);
  double worst = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Index n = 1 + trial % 8;
    const int count = 1 + trial / 8 % 6;
    std::vector<MatrixXd> factors;
    test::LongMatrix product = test::LongMatrix::Identity(n, n);
    for (int k = 0; k < count; ++k) {
      factors.push_back(random_matrix(random, n));
      product = factors.back().cast<long double>() * product;
    }
    std::vector<Complex> expected = test::eigenvalues_of(product);
    const PeriodicSchur schur(factors);
    for (const PeriodicEigenvalue& e : schur.eigenvalues()) {
      const Complex found = std::polar(std::exp(e.log_magnitude), e.phase);
      const auto nearest = std::min_element(expected.begin(), expected.end(), [&](Complex a, Complex b) {
        return std::abs(a - found) < std::abs(b - found);
      });
      const double off = std::abs(std::log(*nearest / found));
      EXPECT_LE(off, 1e-15 + e.error) << trial;
      worst = std::max(worst, off);
      expected.erase(nearest);
    }
  }
  EXPECT_LT(worst, 1e-9);
}

TEST(PeriodicSchur, FactorsBeyondTheRangeOfNumbersAreNoTrouble) {
  std::mt19937 random(4);
  MatrixXd d(3, 3);
  d << 2, 1, 0, 0, 0.5, 0.3, 0, 0, 0.1;
  std::vector<MatrixXd> factors = in_turning_bases(random, std::vector<MatrixXd>(50, d));
  for (std::size_t k = 0; k < factors.size(); ++k) factors[k] *= k < 25 ? 1e300 : 1e-290;
  const PeriodicSchur schur(factors);
  const double common = 25 * 10 * std::log(10.0);
  EXPECT_NEAR(schur.eigenvalues()[0].log_magnitude, 50 * std::log(2.0) + common, 1e-10);
  EXPECT_NEAR(schur.eigenvalues()[1].log_magnitude, 50 * std::log(0.5) + common, 1e-10);
  EXPECT_NEAR(schur.eigenvalues()[2].log_magnitude, 50 * std::log(0.1) + common, 1e-10);
}

// A direction that sticking wipes out: multiplier 0, and the others as they are.
TEST(PeriodicSchur, WhatOneFactorWipesOutIsZero) {
  std::mt19937 random(5);
  for (const Index which : {0, 1, 3}) {
    std::vector<MatrixXd> d(7, MatrixXd(Eigen::Vector4d(0.9, 0.5, -0.3, 0.1).asDiagonal()));
    d[4](which, which) = 0;
    const PeriodicSchur schur(in_turning_bases(random, d));
    std::vector<double> expected;
    for (const Index i : {0, 1, 2, 3})
      if (i != which) expected.push_back(7 * std::log(std::abs(d[0](i, i))));
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(schur.eigenvalues()[j].log_magnitude, expected[j], 1e-11);
    EXPECT_LT(schur.eigenvalues()[3].log_magnitude, -30) << which;  // rounding of one factor
    EXPECT_GT(schur.eigenvalues()[3].error, 0.01) << which;         // and its error says so
  }
  // Exactly: a column of zeros.
  std::vector<MatrixXd> factors = {random_matrix(random, 3), random_matrix(random, 3)};
  factors[1].col(1).setZero();
  EXPECT_LT(PeriodicSchur(factors).eigenvalues()[2].log_magnitude, -30);
  EXPECT_EQ(PeriodicSchur({MatrixXd::Zero(2, 2)}).eigenvalues()[0].log_magnitude, -HUGE_VAL);
}

TEST(PeriodicSchur, VectorsGoOverIntoEachOther) {
  std::mt19937 random(6);
  for (const std::size_t count : {1u, 2u, 9u}) {
    std::vector<MatrixXd> factors;
    for (std::size_t k = 0; k < count; ++k) factors.push_back(random_matrix(random, 6));
    const PeriodicSchur schur(factors);
    EXPECT_LT(schur.backward_error(), 1e-13);
    for (std::size_t j = 0; j < 6; ++j) {
      const auto v = schur.vectors(j);
      Complex product = 1;
      for (std::size_t k = 0; k < count; ++k) {
        const Eigen::VectorXcd image = factors[k] * v[k];
        const Complex along = v[(k + 1) % count].dot(image);
        EXPECT_LT((image - along * v[(k + 1) % count]).norm(), 1e-11 * factors[k].norm());
        product *= along;
      }
      EXPECT_NEAR(std::log(std::abs(product)), schur.eigenvalues()[j].log_magnitude, 1e-11);
      EXPECT_NEAR(turned(std::arg(product) - schur.eigenvalues()[j].phase), 0, 1e-11);
    }
  }
}

// A thousand factors of stiff and soft, of equal and of nilpotent directions: the iteration ends, and backward it is exact.
TEST(PeriodicSchur, EndsForMatricesOfEveryKind) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-8, 8);
  for (int trial = 0; trial < 60; ++trial) {
    const Index n = 2 + trial % 7;
    std::vector<MatrixXd> factors;
    for (int k = 0; k < 1 + trial % 11; ++k) {
      MatrixXd factor = random_matrix(random, n);
      if (trial % 3 == 0)
        for (Index i = 0; i < n; ++i) factor.row(i) *= std::pow(10, uniform(random));
      if (trial % 3 == 1)
        factor = MatrixXd::Identity(n, n) + factor.triangularView<Eigen::StrictlyUpper>().toDenseMatrix();
      if (trial % 5 == 2)
        factor = Eigen::PermutationMatrix<Eigen::Dynamic>(
            Eigen::VectorXi::NullaryExpr(n, [&](Index i) { return static_cast<int>((i + 1) % n); }));
      factors.push_back(factor);
    }
    ASSERT_NO_THROW(EXPECT_LT(PeriodicSchur(factors).backward_error(), 1e-12) << trial) << trial;
  }
}

}  // namespace
}  // namespace kurbel::periodic_schur_test
