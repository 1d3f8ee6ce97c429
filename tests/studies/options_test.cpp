// options_test.cpp — every option of every question accepts its own example; a quantity without one is refused when it is
// registered.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <stdexcept>

#include "studies/question/question.h"
#include "tests/support/scenes.h"

namespace kurbel::options_test {
namespace {

struct Wanted {
  double speed = 0;
  std::optional<double> limit = {};
  std::vector<double> list = {};
};

TEST(Options, AQuantityWithoutAnExampleIsRefusedAtRegistration) {
  EXPECT_THROW(OptionsOf<Wanted>().add({.name = "speed", .doc = "speed"}, &Wanted::speed), std::logic_error);
  EXPECT_THROW(OptionsOf<Wanted>().add({.name = "limit", .doc = "limit", .what = "a speed"}, &Wanted::limit),
               std::logic_error);
  EXPECT_THROW(OptionsOf<Wanted>().add({.name = "list", .doc = "list", .example = "60 rmp"}, &Wanted::list),
               std::logic_error);
  EXPECT_THROW(OptionsOf<Wanted>().add({.name = "speed", .doc = "speed", .example = "-60 rpm", .domain = positive},
                                       &Wanted::speed),
               std::logic_error);
  const Wanted read =
      OptionsOf<Wanted>()
          .add({.name = "speed", .doc = "speed", .example = "30 rpm", .what = "a speed"}, &Wanted::speed)
          .read({{"speed", "1 rad/s"}}, "test", {});
  EXPECT_EQ(read.speed, 1);
}

TEST(Options, OfTwoValuesAreARange) {
  const auto list = [](const std::string& text) {
    return OptionsOf<Wanted>()
        .add({.name = "list", .doc = "list", .example = "30 rpm", .what = "two speeds", .count = 2}, &Wanted::list)
        .read({{"list", text}}, "test", {})
        .list;
  };
  const std::vector<double> wanted = list("20 rpm,200 rpm");
  for (const char* text :
       {"20..200 rpm", "20 rpm..200 rpm", "20 .. 200 rpm", "20 rpm … 200 rpm", "20…200rpm", "+20..200 rpm"})
    EXPECT_EQ(list(text), wanted) << text;
  EXPECT_EQ(list("2 rad/s..200 rpm")[0], 2);
  for (const char* text : {"20..200", "20 rpm..200", "..200 rpm", "20 rpm..", "..", "20 rpm"})
    EXPECT_THROW(list(text), std::invalid_argument) << text;
}

// With a reader of its own an option may be a quantity, too: any text is read or refused, and never for a missing example.
TEST(Options, OfEveryQuestionAcceptTheirExamples) {
  const Scene scene = test::scene_file("scenes/crank_press.toml");
  int examples = 0;
  for (const Question& question : questions()) {
    GivenOptions required;
    for (const DeclaredOption& option : question.options)
      if (option.text.required) required.emplace_back(option.text.name, "x");
    for (const DeclaredOption& option : question.options) {
      if (option.form == OptionForm::flag) continue;
      const std::string& example = option.text.example;
      // The k-th of several is k times the example: a range begins below its end.
      const auto of_several = [&](int k) {
        if (example.empty()) return std::string("1");
        std::size_t digits = 0;
        const double value = std::isdigit(static_cast<unsigned char>(example[0])) ? std::stod(example, &digits) : 0;
        return digits > 0 ? fmt::format("{}{}", k * value, example.substr(digits)) : example;
      };
      std::string text = of_several(1);
      GivenOptions given = required;
      if (option.form == OptionForm::several && !option.text.each_time)
        for (int k = 1; k < option.text.count; ++k) text += "," + of_several(k + 1);
      given.emplace_back(option.text.name, text);
      if (option.text.each_time)
        for (int k = 1; k < option.text.count; ++k) given.push_back(given.back());
      examples += !example.empty();
      try {
        question.check(given, scene);
      } catch (const std::invalid_argument& error) {
        EXPECT_TRUE(example.empty()) << question.name << ": " << error.what();
      } catch (const std::logic_error& error) {
        ADD_FAILURE() << question.name << ": " << error.what();
      }
    }
  }
  EXPECT_GT(examples, 25);
}

}  // namespace
}  // namespace kurbel::options_test
