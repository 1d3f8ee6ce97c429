// figure_text_test.cpp — a figure and its error as they are printed: digits end where the error begins.
#include "studies/findings/figure_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace kurbel::figure_text_test {
namespace {

std::string shown(double value, double error) { return with_error({value, error}, ""); }

TEST(FigureText, EndsWhereTheErrorBegins) {
  EXPECT_EQ(shown(6257.169983, 5.3e-5), "6257.16998 ± 0.00006");
  EXPECT_EQ(shown(6082.16283, 0.5), "6082.2 ± 0.6");  // 0.5 and 0.04 for the rounding
  EXPECT_EQ(shown(0.104382, 0.0112), "0.104 ± 0.012");
  EXPECT_EQ(shown(123456, 1870), "123000 ± 3000");
  EXPECT_EQ(shown(-19.6, 3), "-20 ± 4");
  EXPECT_EQ(shown(7, 0), "7 ± 0");
  EXPECT_EQ(shown(1e-3, 0.3), "0.0 ± 0.4");
  EXPECT_EQ(shown(1.23456e-7, 3e-11), "1.2346e-07 ± 4e-11");
  EXPECT_EQ(with_error({724.88551234, 1e-6}, "N*m"), "724.885512 ± 2e-06 N·m");
}

TEST(FigureText, WithoutAnErrorHasSixDigitsAtMostAndSaysSo) {
  EXPECT_EQ(with_error({724.88551234}, "N*m"), "724.886 N·m");
  EXPECT_EQ(error_cell({724.88551234}), "not measured");
  EXPECT_EQ(error_cell({1, std::numeric_limits<double>::infinity()}), "not measured");
}

// Of a thousand values and errors over many decades: what is printed covers the true interval, wastes no more than a
// factor of two and the nine digits' rounding, and value and error end at the same place.
TEST(FigureText, CoversWhatItStandsForAndNoDigitIsBeyondTheError) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> decade(-9, 9), relative(-14, 1), mantissa(1, 10);
  for (int i = 0; i < 20000; ++i) {
    const double value = (i % 2 ? 1 : -1) * mantissa(random) * std::pow(10, std::floor(decade(random)));
    const double error = std::abs(value) * std::pow(10, relative(random));
    const FigureText text = figure_text({value, error});
    ASSERT_TRUE(text.error.starts_with("± ")) << text.error;
    const double printed = std::stod(text.value), printed_error = std::stod(text.error.substr(4 - 1));
    const double round_off = 1e-14 * std::abs(value);
    ASSERT_LE(std::abs(value - printed) + error, printed_error + round_off) << text.value << " " << text.error;
    ASSERT_LE(printed_error, 2 * error + 1.6e-8 * std::abs(value)) << text.value << " " << text.error;
    std::string digits;
    for (const char c : text.value.substr(0, text.value.find('e')))
      if (c >= '0' && c <= '9' && !(digits.empty() && c == '0')) digits += c;
    if (std::abs(value) < 1e8 && std::abs(value) >= 1e-4) {
      ASSERT_LE(digits.size(), 9u) << text.value;
    }
    // The last place of the value is worth no less than a twentieth of the error.
    const std::size_t point = text.value.find('.');
    if (text.value.find('e') == std::string::npos && point != std::string::npos && printed != 0) {
      const double last_place = std::pow(10, -static_cast<double>(text.value.size() - point - 1));
      ASSERT_GE(last_place, printed_error / 20) << text.value << " " << text.error;
    }
  }
}

}  // namespace
}  // namespace kurbel::figure_text_test
