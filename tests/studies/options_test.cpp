// options_test.cpp — every option of every question accepts its own example; a quantity without one is refused when it is
// registered.
#include <fmt/format.h>
#include <gtest/gtest.h>

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
          .add({.name = "speed", .doc = "speed", .example = "60 rpm", .what = "a speed"}, &Wanted::speed)
          .read({{"speed", "1 rad/s"}}, "test", {});
  EXPECT_EQ(read.speed, 1);
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
      // Several values ascend, as two ends of a range do.
      const auto value = [&](int k) {
        if (example.empty()) return std::string("1");
        std::size_t unit = 0;
        const double number = std::stod(example, &unit);
        return fmt::format("{:g}{}", k * number, example.substr(unit));
      };
      std::string text = value(1);
      GivenOptions given = required;
      if (option.form == OptionForm::several && !option.text.each_time)
        for (int k = 2; k <= option.text.count; ++k) text += "," + value(k);
      given.emplace_back(option.text.name, text);
      if (option.text.each_time)
        for (int k = 2; k <= option.text.count; ++k) given.push_back(given.back());
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
