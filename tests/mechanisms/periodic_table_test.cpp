// periodic_table_test.cpp — the table by itself: accuracy, wrapping, and what it says when it cannot do better.
#include "mechanisms/reduced/periodic_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace kurbel::periodic_table_test {
namespace {

void harmonics(double phi, std::span<double> values) {
  values[0] = 3 + std::sin(phi);
  values[1] = std::cos(5 * phi);
}

TEST(PeriodicTable, ReproducesHarmonics) {
  const PeriodicTable table = PeriodicTable::build(
      harmonics, {{"first", ErrorScale::own_value, 0}, {"fifth", ErrorScale::own_maximum, 0}}, 1e-13, 1000);
  EXPECT_TRUE(table.report().converged);
  for (double phi = -20; phi < 20; phi += 0.0137) {
    const auto cursor = table.locate(phi);
    EXPECT_NEAR(table.value(cursor, 0), 3 + std::sin(phi), 4e-13);
    EXPECT_NEAR(table.value(cursor, 1), std::cos(5 * phi), 2e-13);
  }
}

TEST(PeriodicTable, EveryEdgeIsCovered) {
  const PeriodicTable table = PeriodicTable::build(harmonics, {{"first", {}, 0}, {"fifth", {}, 0}}, 1e-13, 1000);
  const double edges[] = {0.0,
                          -0.0,
                          -1e-300,
                          -1e-17,
                          PeriodicTable::period,
                          std::nextafter(PeriodicTable::period, 0.0),
                          std::nextafter(PeriodicTable::period, 10.0),
                          -PeriodicTable::period};
  for (const double phi : edges) EXPECT_NEAR(table.value(table.locate(phi), 0), 3 + std::sin(phi), 1e-12) << phi;
  for (int cell = 0; cell <= 1024; ++cell) {
    const double phi = PeriodicTable::period * cell / 1024;
    for (const double near : {std::nextafter(phi, -1.0), phi, std::nextafter(phi, 10.0)})
      EXPECT_NEAR(table.value(table.locate(near), 1), std::cos(5 * near), 1e-12);
  }
  EXPECT_TRUE(std::isnan(table.value(table.locate(NAN), 0)));
  EXPECT_TRUE(std::isnan(table.value(table.locate(-INFINITY), 1)));
}

// A turn more changes nothing: at 10⁶ turns the wrapped angle is still as good as the angle given.
TEST(PeriodicTable, FarAnglesWrapExactly) {
  const PeriodicTable table = PeriodicTable::build(harmonics, {{"first", {}, 0}, {"fifth", {}, 0}}, 1e-14, 1000);
  for (const double far : {1e3, 6.3e6, -6.3e6, 5e7})
    for (int i = 0; i < 100; ++i) {
      const double phi = far + i;
      EXPECT_NEAR(table.value(table.locate(phi), 1), static_cast<double>(std::cos(5 * static_cast<long double>(phi))),
                  1e-13);
    }
}

TEST(PeriodicTable, SharpPeaksGetShortPieces) {
  const auto peak = [](double phi, std::span<double> values) { values[0] = 1 / (1.0001 - std::cos(phi - 2)); };
  const PeriodicTable table = PeriodicTable::build(peak, {{"peak", ErrorScale::own_value, 0}}, 1e-12, 1000);
  EXPECT_TRUE(table.report().converged);
  EXPECT_LT(table.report().pieces, 150u);
  double expected = 0;
  for (double phi = 1.9; phi < 2.1; phi += 1e-5) {
    peak(phi, {&expected, 1});
    EXPECT_NEAR(table.value(table.locate(phi), 0) / expected, 1, 2e-12);
  }
}

TEST(PeriodicTable, SaysWhenItRanOutOfPieces) {
  const auto kink = [](double phi, std::span<double> values) { values[0] = std::fabs(phi - 2); };
  const PeriodicTable table = PeriodicTable::build(kink, {{"kink", ErrorScale::own_maximum, 0}}, 1e-12, 24);
  EXPECT_FALSE(table.report().converged);
  EXPECT_EQ(table.report().pieces, 24u);
  EXPECT_GT(table.report().channels[0].error, 1e-6);
  EXPECT_LT(table.report().channels[0].error, 1e-2);
}

// Samples that are known to 1e-9 are not resolved any further: 1e-9 is what remains, not the pieces. A kink, which a
// halving brings down by half, is resolved until they run out.
TEST(PeriodicTable, DoesNotResolveRoundOff) {
  const auto noisy = [](double phi, std::span<double> values) {
    const double chance = std::fmod(std::fabs(std::sin(phi * 1e7)) * 1e4, 1.0) - 0.5;
    values[0] = std::cos(phi) + 2e-9 * chance;
  };
  const TableReport report = PeriodicTable::build(noisy, {{"noisy", ErrorScale::own_maximum, 0}}, 1e-12, 4096).report();
  EXPECT_FALSE(report.converged);
  EXPECT_LE(report.pieces, 16u << 4);
  EXPECT_LT(report.channels[0].error, 1e-7);
  const auto kink = [](double phi, std::span<double> values) { values[0] = 1e-7 * std::fabs(phi - 2) + std::cos(phi); };
  const TableReport sharp = PeriodicTable::build(kink, {{"kink", ErrorScale::own_maximum, 0}}, 1e-11, 4096).report();
  EXPECT_TRUE(sharp.converged);
}

// A channel in another unit is the same channel: errors count by its largest value.
TEST(PeriodicTable, ErrorsDoNotDependOnTheUnit) {
  const auto wave = [](double factor) {
    return [factor](double phi, std::span<double> values) { values[0] = factor * std::cos(9 * phi); };
  };
  const auto report = [&](double factor) {
    return PeriodicTable::build(wave(factor), {{"wave", ErrorScale::own_maximum, 0}}, 1e-10, 1000).report();
  };
  const TableReport one = report(1);
  for (const double factor : {1e-4, 7e5}) {
    const TableReport other = report(factor);
    EXPECT_TRUE(other.converged);
    EXPECT_EQ(other.pieces, one.pieces) << factor;
    EXPECT_NEAR(other.channels[0].error, one.channels[0].error, 1e-14) << factor;
  }
}

TEST(PeriodicTable, RefusesSenselessRequests) {
  const auto broken = [](double, std::span<double> values) { values[0] = NAN; };
  EXPECT_THROW(PeriodicTable::build(broken, {{"broken", {}, 0}}, 1e-9, 100), std::runtime_error);
  EXPECT_THROW(PeriodicTable::build(harmonics, {}, 1e-9, 100), std::invalid_argument);
  EXPECT_THROW(PeriodicTable::build(harmonics, {{"a", {}, 0}, {"b", {}, 0}}, 0, 100), std::invalid_argument);
}

}  // namespace
}  // namespace kurbel::periodic_table_test
