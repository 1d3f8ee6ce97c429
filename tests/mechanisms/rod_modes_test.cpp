// rod_modes_test.cpp — the integrals of a flexible rod's shape functions against quadrature and a rod's own vibrations.
#include "mechanisms/deforming/rod_flexibility.h"
#include "tests/support/eigen_solutions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace kurbel::rod_modes_test {
namespace {

constexpr double pi = std::numbers::pi, length = 0.42, mass = 1.7;
const RodFlexibility rod = {70e9, 3.1e-4, 5.2e-9, 0.01, 5, true, 0.03, 1};

// ∫₀ˡ f ds by Simpson's rule.
double over_the_rod(const std::function<double(double)>& f) {
  constexpr int n = 2000;
  double sum = f(0) + f(1);
  for (int k = 1; k < n; ++k) sum += (k % 2 ? 4 : 2) * f(static_cast<double>(k) / n);
  return sum * length / (3 * n);
}

TEST(RodModes, HoldTheIntegralsOfTheirShapeFunctions) {
  const RodModes modes(rod, length, mass);
  const int middle = modes.bending, end = modes.end();
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  for (int i = 0; i < modes.bending; ++i) {
    EXPECT_NEAR(modes.across[at(i)], over_the_rod([&](double x) { return modes.shape(i, x); }), 1e-9);
    EXPECT_NEAR(modes.moment_across[at(i)], over_the_rod([&](double x) { return length * x * modes.shape(i, x); }),
                1e-9);
    for (const int j : {middle, end})
      EXPECT_NEAR(modes.product[j - middle][at(i)],
                  over_the_rod([&](double x) { return modes.shape(j, x) * modes.shape(i, x); }), 1e-9)
          << i << ", " << j;
    // EI ∫ w″² ds, w″ as the bending stress has it.
    EXPECT_NEAR(modes.stiffness[at(i)][at(i)] / (rod.modulus * rod.second_moment),
                over_the_rod([&](double x) { return std::pow(modes.curvature(i, x), 2); }),
                1e-7 * modes.stiffness[at(i)][at(i)] / (rod.modulus * rod.second_moment));
  }
  for (const int a : {middle, end}) {
    EXPECT_NEAR(modes.along[at(a)], over_the_rod([&](double x) { return modes.shape(a, x); }), 1e-12);
    EXPECT_NEAR(modes.moment_along[at(a)], over_the_rod([&](double x) { return length * x * modes.shape(a, x); }),
                1e-12);
    for (const int b : {middle, end})
      EXPECT_NEAR(modes.mass[at(a)][at(b)],
                  mass / length * over_the_rod([&](double x) { return modes.shape(a, x) * modes.shape(b, x); }), 1e-9);
  }
}

// A rod fixed at one end rings along itself with ω = π/2l √(EA/μ) and decays with its ζ; the quadratic element's first
// frequency is half a per cent above.
TEST(RodModes, StretchingDecaysWithItsDampingRatio) {
  const RodModes modes(rod, length, mass);
  const auto m = static_cast<std::size_t>(modes.bending);
  Eigen::Matrix2d mass_of, stiffness_of, damping_of;
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t b = 0; b < 2; ++b) {
      const auto i = static_cast<Eigen::Index>(a), j = static_cast<Eigen::Index>(b);
      mass_of(i, j) = modes.mass[m + a][m + b], stiffness_of(i, j) = modes.stiffness[m + a][m + b];
      damping_of(i, j) = modes.damping[m + a][m + b];
    }
  const test::PairSolution solution = test::solution_of_pair(stiffness_of, mass_of);
  const double omega = std::sqrt(solution.values[0]);
  EXPECT_NEAR(omega, pi / 2 / length * std::sqrt(rod.modulus * rod.area / (mass / length)), 0.006 * omega);
  const Eigen::Vector2d shape = solution.vectors.col(0);  // of modal mass 1
  EXPECT_NEAR(shape.dot(damping_of * shape) / (2 * omega), rod.damping_ratio, 0.006 * rod.damping_ratio);
}

}  // namespace
}  // namespace kurbel::rod_modes_test
