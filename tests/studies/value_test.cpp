// value_test.cpp — records as JSON: every number comes back to the last bit, and the text is that of a parser that wrote it.
#include "studies/data/value.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "studies/data/data_table.h"
#include "studies/data/number_text.h"

namespace kurbel::test::value_test {
namespace {

using Json = nlohmann::ordered_json;

TEST(Values, NumbersComeBackToTheLastBit) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-300, 300), sign(-1, 1);
  List numbers = {0.0, -0.0, 1.0, 0.1, 1e-5, 1e15, 123456.0, 5e-324, std::numeric_limits<double>::max()};
  std::vector<double> all = {0.0, -0.0, 1.0, 0.1, 1e-5, 1e15, 123456.0, 5e-324, std::numeric_limits<double>::max()};
  for (int i = 0; i < 2000; ++i) {
    all.push_back(sign(random) * std::pow(10, exponent(random)));
    numbers.push_back(all.back());
  }
  const Json read = Json::parse(json_text({{"numbers", numbers}})).at("numbers");
  ASSERT_EQ(read.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_TRUE(read[i].is_number_float()) << read[i];
    EXPECT_EQ(read[i].get<double>(), all[i]);
    EXPECT_EQ(std::signbit(read[i].get<double>()), std::signbit(all[i]));
  }
}

TEST(Values, TextIsThatOfOtherWriters) {
  const Record record = {{"words", "a \"quoted\" \\ line\nand <µ>\ttab"},
                         {"nothing", Value()},
                         {"unknown", HUGE_VAL},
                         {"so", true},
                         {"whole", -3},
                         {"number", 2.0},
                         {"none", List{}},
                         {"empty", Record{}},
                         {"nested", List{Record{{"x", 0.25}, {"of", List{1, 2.5}}}, "y"}}};
  const std::string text = json_text(record), in_page = json_text(record, JsonForm::in_page);
  EXPECT_EQ(text, Json::parse(text).dump(2));
  EXPECT_EQ(Json::parse(in_page), Json::parse(text));
  EXPECT_EQ(in_page.find_first_of("<\n"), std::string::npos);
}

TEST(Values, AnEstimateIsTwoFieldsOfItsRecord) {
  const Json read = Json::parse(json_text({{"speed", Estimate{2, 0.5}},
                                           {"torque", Estimate{3}},
                                           {"none", std::optional<Estimate>()},
                                           {"list", List{Estimate{4, 1}}},
                                           {"drawn", RoundedList{{1 / 3.0, HUGE_VAL}, 3}}}));
  EXPECT_EQ(read.dump(),
            R"({"speed":2.0,"speed_error":0.5,"torque":3.0,"torque_error":null,"none":null,"none_error":null,)"
            R"("list":[{"value":4.0,"error":1.0}],"drawn":[0.333,null]})");
}

// Of all magnitudes, beside decimals and beside the middles between them: printf's digits.
TEST(Values, DigitsAreThoseOfPrintf) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-12, 17), sign(-1, 1);
  for (int i = 0; i < 50000; ++i) {
    const double decimal = std::round(1e6 * sign(random)) / std::pow(10.0, i % 9),
                 middle = decimal + 5 / std::pow(10.0, i % 13);
    for (const double number :
         {sign(random) * std::pow(10, exponent(random)), decimal, middle, std::nextafter(decimal, 0),
          std::nextafter(middle, HUGE_VAL), std::pow(10.0, i % 25 - 8)}) {
      const int digits = 1 + i % 14;
      std::string text;
      append_digits(text, number, digits);
      char expected[64];
      std::snprintf(expected, sizeof expected, "%.*g", digits, number);
      ASSERT_EQ(text, expected);
    }
  }
}

TEST(Values, WhatIsNoUtf8OrObeyedIsEscaped) {
  const std::string text = json_text({{"title", "a\xff\x1b[31m\u202e"}});
  EXPECT_EQ(text, "{\n  \"title\": \"a\\ufffd\\u001b[31m\\u202e\"\n}");
}

}  // namespace
}  // namespace kurbel::test::value_test
