// piecewise_test.cpp — functions by polynomial pieces: integrals, derivatives, roots.
#include "engine/base/piecewise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace kurbel::piecewise_test {
namespace {

using std::numbers::pi;

TEST(Piecewise, IntegratesAndDifferentiatesBackToTheFunction) {
  const Piecewise f = Piecewise::of({0, 1, 4}, [](double x) { return x < 1 ? std::exp(3 * x) : std::cos(7 * x); });
  EXPECT_NEAR(f.total(), (std::exp(3.0) - 1) / 3 + (std::sin(28.0) - std::sin(7.0)) / 7, 1e-12);
  const Piecewise back = f.integral().derivative();
  for (double x = 0.01; x < 4; x += 0.013) EXPECT_NEAR(back.value(x), f.value(x), 1e-11);
  const std::vector<double> zeros = f.sign_changes();  // cos 7x on 1 … 4: (k + ½) π/7, k = 2 … 8; none at the jump up
  ASSERT_EQ(zeros.size(), 7U);
  for (std::size_t k = 0; k < zeros.size(); ++k) EXPECT_NEAR(zeros[k], (static_cast<double>(k) + 2.5) * pi / 7, 1e-13);
}

}  // namespace
}  // namespace kurbel::piecewise_test
