// gauss_test.cpp — quadrature by Gauss and Legendre: what it is exact for, and its weights over a length.
#include "engine/base/gauss.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kurbel::gauss_test {
namespace {

template <std::size_t n>
void expect_exact() {
  for (int degree = 0; degree < 2 * static_cast<int>(n); ++degree) {
    double sum = 0, weights = 0, last = 1;
    gauss<n>.over(1, 2, [&](double x, double weight) {
      EXPECT_GT(x, last);
      sum += weight * std::pow(x - 2, degree), weights += weight, last = x;
    });
    EXPECT_NEAR(sum, degree % 2 == 0 ? 2.0 / (degree + 1) : 0, 1e-15) << n << " nodes, degree " << degree;
    EXPECT_NEAR(weights, 2, 1e-15);
    EXPECT_LT(last, 3);
  }
}

TEST(Gauss, IsExactUpToDegreeTwoNLessOne) {
  expect_exact<2>();
  expect_exact<3>();
  expect_exact<4>();
  expect_exact<5>();
  expect_exact<6>();
  expect_exact<16>();
  expect_exact<17>();
}

}  // namespace
}  // namespace kurbel::gauss_test
