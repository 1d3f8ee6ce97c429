// figure_text_test.cpp — a figure and its error as they are printed: digits end where the error begins; tables on a terminal.
#include "studies/findings/figure_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "studies/claims/headline.h"
#include "studies/claims/ranges.h"
#include "studies/findings/output.h"

namespace kurbel::figure_text_test {
namespace {

std::string shown(double value, double error, int digits = digits_in_tables) {
  const FigureText text = figure_text({value, error}, digits);
  return text.value + " " + text.error;
}

TEST(FigureText, EndsWhereTheErrorBegins) {
  EXPECT_EQ(shown(6082.16283, 0.5), "6082.2 ± 0.6");  // 0.5 and 0.04 for the rounding
  EXPECT_EQ(shown(0.104382, 0.0112), "0.104 ± 0.012");
  EXPECT_EQ(shown(123456, 1870), "123000 ± 3000");
  EXPECT_EQ(shown(-19.6, 3), "-20 ± 4");
  EXPECT_EQ(shown(7, 0), "7 ± 0");
  EXPECT_EQ(shown(1e-3, 0.3), "0.0 ± 0.4");
  EXPECT_EQ(shown(1, 14), "0 ± 15");
  EXPECT_EQ(shown(1e-13, 1.1e-12), "0 ± 1.2e-12");
  EXPECT_EQ(shown(1.23456e-7, 3e-11), "1.2346e-07 ± 4e-11");
}

// Of a small error the value shows six digits, in long forms nine; the error is that of the computation.
TEST(FigureText, HasNoMoreDigitsThanATableShows) {
  EXPECT_EQ(shown(6257.169983, 5.3e-5), "6257.17 ± 0.00006");
  EXPECT_EQ(shown(6257.169983, 5.3e-5, digits_in_long_forms), "6257.16998 ± 0.00006");
  EXPECT_EQ(shown(724.88551234, 1e-6), "724.886 ± 1.0e-06");
  EXPECT_EQ(shown(-0.99999961, 1.96e-9), "-1.00000 ± 2e-09");
}

// In words: what the last digit does not say; what is not resolved is said to be small.
TEST(FigureText, InWordsHasAnErrorThatMatters) {
  EXPECT_EQ(with_error({724.88551234, 1e-6}, "N*m"), "724.886 N·m");
  EXPECT_EQ(with_error({6082.16283, 0.5}, "N*m"), "6082.2 ± 0.6 N·m");
  EXPECT_EQ(with_error({123456, 1870}, "N"), "123000 ± 3000 N");
  EXPECT_EQ(with_error({1, 14}, "s"), "less than 15 s");
  EXPECT_EQ(with_error({-1e-3, 0.3}, ""), "less than 0.3");
  EXPECT_EQ(with_error({7, 0}, "s"), "7 s");
}

// Of an unknown error: by the scale.
TEST(FigureText, RoundingOfAScaleIsZero) {
  EXPECT_EQ(without_rounding({-2e-7}, 1e6).value, 0);
  EXPECT_EQ(without_rounding({-2e-5}, 1e6).value, -2e-5);
  EXPECT_EQ(without_rounding({2e-7, 1e-9}, 1e6).value, 2e-7);
}

TEST(FigureText, DurationsHaveTheUnitOfTheirSize) {
  EXPECT_EQ(duration_text(1.7004), "1.7 s");
  EXPECT_EQ(duration_text(0.0123), "12.3 ms");
  EXPECT_EQ(duration_text(6.85e-4), "685 µs");
}

TEST(FigureText, WithoutAnErrorHasSixDigitsAtMostAndSaysSo) {
  EXPECT_EQ(with_error({724.88551234}, "N*m"), "724.886 N·m");
  EXPECT_EQ(figure_text({724.88551234}, 3).value, "725");
  EXPECT_EQ(error_cell({724.88551234}), "not measured");
  EXPECT_EQ(error_cell({1, std::numeric_limits<double>::infinity()}), "not measured");
}

// What is exact by construction has the requested digits; a count is shown whole.
TEST(FigureText, ExactFiguresHaveNoMoreDigitsThanOthers) {
  EXPECT_EQ(shown(0.883412345678, 0), "0.883412 ± 0");
  EXPECT_EQ(shown(0.883412345678, 0, 4), "0.8834 ± 0");
  EXPECT_EQ(shown(0.883412345678, 0, digits_in_long_forms), "0.883412346 ± 0");
  EXPECT_EQ(shown(20.0 / 3, 0), "6.66667 ± 0");
  EXPECT_EQ(shown(1485.5, 0), "1485.5 ± 0");
  EXPECT_EQ(shown(123456789, 0), "123456789 ± 0");
}

TEST(Ranges, HaveEndsOfOnePlace) {
  EXPECT_EQ(range_text(56.7912, 63.0012), "56.79 … 63.00");
  EXPECT_EQ(range_text(5, 7.5), "5.0 … 7.5");
  EXPECT_EQ(range_text(20, 200), "20 … 200");
  EXPECT_EQ(range_text(-17.64, 2), "-17.64 … 2.00");
  EXPECT_EQ(range_text(99.4, 99.997), "99.4 … 100.0");
  EXPECT_EQ(range_text(0, 0.3), "0 … 0.3");
  EXPECT_EQ(range_text(0, 218.1), "0 … 218.1");
  EXPECT_EQ(range_text(-218.1, 0), "-218.1 … 0");
  EXPECT_EQ(range_text(1e-5, 5.4142e-4), "1e-05 … 0.0005414");
  EXPECT_EQ(range_text(12345.6, 23456.7), "12350 … 23460");
  EXPECT_EQ(range_text(0.1234, 350.1), "0.1234 … 350.1");
  EXPECT_EQ(range_text(1.23456e-6, 2e-6), "1.235e-06 … 2.000e-06");
  EXPECT_EQ(range_text(63.0012, 63.0013), "63");
  EXPECT_EQ(range_text(0, 0), "0");
  EXPECT_EQ(headline("at 56.79123 … 63.00123 rpm, 1340 … 1640 rpm"), "at 56.79 … 63.00 rpm, 1340 … 1640 rpm");
}

// Of ends of one size: as many decimals behind both points, and each within half a unit of its last place.
TEST(Ranges, OfAnySizeHaveAsManyDecimalsAtBothEnds) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> decade(-2, 8), share(0.1, 1);
  for (int i = 0; i < 5000; ++i) {
    const double high = std::pow(10, decade(random)), low = (i % 3 ? 1 : -1) * share(random) * high;
    const int digits = 3 + i % 3;
    const std::string text = range_text(low, high, digits);
    const std::size_t between = text.find(" … ");
    if (between == std::string::npos) continue;
    const std::string ends[] = {text.substr(0, between), text.substr(between + std::string(" … ").size())};
    const auto decimals = [](const std::string& end) {
      return end.find('.') == std::string::npos ? 0 : end.size() - end.find('.') - 1;
    };
    EXPECT_EQ(decimals(ends[0]), decimals(ends[1])) << text;
    const double unit = std::pow(10, std::floor(std::log10(high)) - digits + 1);
    EXPECT_NEAR(std::stod(ends[0]), low, 5.01 * unit) << text;
    EXPECT_NEAR(std::stod(ends[1]), high, 0.501 * unit) << text;
  }
}

// Of many values and errors over many decades: the printed error is that of the value, with what its rounding adds where both end at
// the same place, and wastes no more than a factor of two; else the value is rounded to six digits.
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
    // To six digits, where the error is less than half of the last one.
    const bool rounded = error < 0.5 * std::pow(10, std::floor(std::log10(std::abs(value))) - 5);
    ASSERT_LE((rounded ? 0 : std::abs(value - printed)) + error, printed_error + round_off)
        << text.value << " " << text.error;
    ASSERT_LE(std::abs(value - printed), std::max(printed_error, 5.1e-6 * std::abs(value)))
        << text.value << " " << text.error;
    ASSERT_LE(printed_error, 2 * error + 1.6e-5 * std::abs(value)) << text.value << " " << text.error;
    if (error < 1e-7 * std::abs(value)) {
      ASSERT_LE(printed_error, 2 * error) << text.value << " " << text.error;
    }
    std::string digits;
    for (const char c : text.value.substr(0, text.value.find('e')))
      if (c >= '0' && c <= '9' && !(digits.empty() && c == '0')) digits += c;
    if (std::abs(value) < 1e5 && std::abs(value) >= 1e-4) {
      ASSERT_LE(digits.size(), 6u) << text.value;
    }
    // The last place of the value is worth no less than a twentieth of the error.
    const std::size_t point = text.value.find('.');
    if (text.value.find('e') == std::string::npos && point != std::string::npos && printed != 0) {
      const double last_place = std::pow(10, -static_cast<double>(text.value.size() - point - 1));
      ASSERT_GE(last_place, printed_error / 20) << text.value << " " << text.error;
    }
  }
}

// Tables of random lengths: together at most 48 rows, and a line more for each, or eight rows of each; none that is cut
// shows fewer than one that is not; with everything requested all rows.
TEST(TerminalTables, AreCutWhereTheyAreLong) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<std::size_t> lengths(1 + random() % 7);
    Findings f;
    const Chapter chapter = f.chapter("tables");
    for (std::size_t k = 0; k < lengths.size(); ++k) {
      lengths[k] = 1 + random() % (random() % 2 ? 10 : 120);
      f.say(chapter,
            table_of("", "", numbers_below(lengths[k])).only_for_people(fmt::format("table{}", k), [k](std::size_t) {
              return fmt::format("row{}", k);
            }));
    }
    const std::string text = terminal_text(f), whole = terminal_text(f, true);
    std::size_t sum = 0, least_cut = SIZE_MAX, most_whole = 0;
    for (std::size_t k = 0; k < lengths.size(); ++k) {
      const auto rows = [&](const std::string& all) {
        const std::string row = fmt::format("row{}\n", k);
        std::size_t count = 0;
        for (std::size_t at = all.find(row); at != std::string::npos; at = all.find(row, at + 1)) ++count;
        return count;
      };
      EXPECT_EQ(rows(whole), lengths[k]);
      sum += rows(text);
      if (rows(text) == lengths[k]) {
        most_whole = std::max(most_whole, lengths[k]);
        continue;
      }
      least_cut = std::min(least_cut, rows(text));
      EXPECT_GE(rows(text), 8u);
      EXPECT_NE(text.find(fmt::format("  {} more rows (report, or --all)\n", lengths[k] - rows(text))),
                std::string::npos);
    }
    EXPECT_LE(sum, std::max<std::size_t>(48, 8 * lengths.size()) + lengths.size());
    EXPECT_LE(most_whole, std::max(least_cut, least_cut + 1));  // nothing cut: SIZE_MAX
  }
}

}  // namespace
}  // namespace kurbel::figure_text_test
