// piecewise_test.cpp — functions by polynomial pieces: integrals, derivatives, extremes, harmonics.
#include "engine/base/piecewise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace kurbel::piecewise_test {
namespace {

using std::numbers::pi;

TEST(Piecewise, IntegratesAndDifferentiatesBackToTheFunction) {
  const Piecewise f = Piecewise::of({0, 1, 4}, [](double x) { return x < 1 ? std::exp(3 * x) : std::cos(7 * x); });
  EXPECT_NEAR(f.total(), (std::exp(3.0) - 1) / 3 + (std::sin(28.0) - std::sin(7.0)) / 7, 1e-12);
  const Piecewise back = f.integral().derivative();
  for (double x = 0.01; x < 4; x += 0.013) EXPECT_NEAR(back.value(x), f.value(x), 1e-11);
}

// Through Gauss's nodes the total is exact beyond the degree of the pieces themselves.
TEST(Piecewise, TotalsAreExactUpToDegree31) {
  for (int degree = 0; degree <= 31; ++degree) {
    std::vector<double> samples;
    for (std::size_t k = 0; k < Piecewise::nodes; ++k)
      samples.push_back(std::pow(0.5 * (1 + Piecewise::node(k)), degree));
    const Piecewise power = Piecewise::through({0, 1}, samples);
    EXPECT_NEAR(power.total(), 1.0 / (degree + 1), 1e-15);
    if (degree > 15) continue;
    for (const double x : {0.1, 0.5, 0.9})
      EXPECT_NEAR(power.integral().value(x), std::pow(x, degree + 1) / (degree + 1), 1e-15);
  }
}

// In a piece far shorter than its place is from zero a value is as exact as in long ones.
TEST(Piecewise, ShortPiecesFarFromZeroKeepTheirDigits) {
  const double begin = 6, end = 6 + 1e-6;
  const Piecewise line = Piecewise::linear({begin, end}, {0, 1});
  for (double x = begin; x < end; x += 1e-8) EXPECT_NEAR(line.value(x), (x - begin) / (end - begin), 1e-15);
}

TEST(Piecewise, OfEqualExtremesTheFirstCounts) {
  for (const double shift : {0.1, 0.2, 0.3, 0.4, 0.5}) {
    const Piecewise wave = Piecewise::of({0, 2 * pi}, [=](double x) { return std::sin(3 * x + shift); });
    EXPECT_NEAR(wave.maximum().x, (pi / 2 - shift) / 3, 1e-7);
    EXPECT_NEAR(wave.minimum().x, (3 * pi / 2 - shift) / 3, 1e-7);
  }
}

// Of e^(rx) over 0 … L:  (e^((r + iν)L) − 1)/((r + iν)L), from waves far longer than a piece to far shorter ones.
TEST(Piecewise, MeanWithAWaveIsTheClosedForm) {
  const double rate = 0.3, length = 6.28;
  const Piecewise f = Piecewise::of({0, 0.7, 2.1, length}, [&](double x) { return std::exp(rate * x); });
  for (const double nu : {0.0, 1e-6, 1e-3, 0.4, 3.0, 17.0, 55.5, 300.0, 5000.0, -3.0}) {
    const std::complex<double> exponent = std::complex<double>(rate, nu) * length;
    const std::complex<double> expected = (std::exp(exponent) - 1.0) / exponent, found = f.mean_with_wave(nu);
    EXPECT_NEAR(found.real(), expected.real(), 1e-13) << nu;
    EXPECT_NEAR(found.imag(), expected.imag(), 1e-13) << nu;
  }
  EXPECT_NEAR(f.mean_square(), (std::exp(2 * rate * length) - 1) / (2 * rate * length), 1e-13 * f.mean_square());
}

}  // namespace
}  // namespace kurbel::piecewise_test
