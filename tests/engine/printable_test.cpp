// printable_test.cpp — no text, whatever its bytes, holds anything that a terminal obeys; valid text stays as it is.
#include "engine/scene/printable.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

namespace kurbel::printable_test {
namespace {

TEST(Printable, TextOfAllScriptsStaysAsItIs) {
  const std::string text = "Kurbel · ω² ≤ 5 %, Ölpumpe, пресс, 曲柄, 🛠";
  EXPECT_EQ(printable(text), text);
  EXPECT_EQ(printable_lines("a\n\tb\n"), "a\n\tb\n");
  EXPECT_EQ(printable_json("{\n  \"a\": \"ω\"\n}"), "{\n  \"a\": \"ω\"\n}");
}

TEST(Printable, WhatATerminalObeysIsShownInWords) {
  EXPECT_EQ(printable("\033[31mred\033[0m"), "\\x1B[31mred\\x1B[0m");
  EXPECT_EQ(printable("a\nb\tc\rd\x07\x7F"), "a\\nb\\tc\\rd\\x07\\x7F");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\x9B31m")
      << "C1 in UTF-8";
  EXPECT_EQ(printable("\x9B"
                      "31m"),
            "\\x9B31m")
      << "C1 as a byte";
  EXPECT_EQ(printable("exe\u202Elmot"), "exe\\u202Elmot");
  EXPECT_EQ(printable("\xC3("), "\\xC3(") << "cut short";
  EXPECT_EQ(printable("\xC0\xAF"), "\\xC0\\xAF") << "overlong";
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xED\\xA0\\x80") << "half a pair";
  EXPECT_EQ(printable(std::string("\0", 1)), "\\x00");
}

// Random bytes: what comes out is valid UTF-8 without anything to obey, and JSON keeps its meaning.
TEST(Printable, NoBytesGetThrough) {
  std::mt19937 random(7);
  for (int n = 0; n < 2000; ++n) {
    std::string text;
    const std::size_t length = random() % 24;
    constexpr unsigned char likely[] = {0x1B, 0x9B, 0xC2, 0xE2, 0x80, 0xAE, 0xF0, 0x9F, '[', 'm', 0xFF, '\n'};
    for (std::size_t i = 0; i < length; ++i)
      text += static_cast<char>(random() % 3 ? likely[random() % sizeof likely] : random() % 256);
    const std::string shown = printable(text);
    EXPECT_EQ(printable(shown), shown) << "nothing left to show in words";
    for (const char c : shown) EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F);
    const nlohmann::json json = shown;
    EXPECT_NO_THROW(json.dump()) << "is UTF-8";
    const nlohmann::json raw = {{"title", "\u009B31m \u202E" + shown}};
    const std::string dumped = printable_json(raw.dump(2));
    EXPECT_EQ(nlohmann::json::parse(dumped), raw);
    EXPECT_EQ(dumped.find("\u009B"), std::string::npos);
  }
}

}  // namespace
}  // namespace kurbel::printable_test
