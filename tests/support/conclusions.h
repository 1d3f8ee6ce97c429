// conclusions.h — what a conclusion says, and requirements on every one: one text in all renderings, and no superfluous digits.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "studies/claims/headline.h"
#include "studies/findings/output.h"

namespace kurbel::test {

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Null: there is no such claim.
inline const Claim* find(const Claims& claims, Predicate what, const std::string& of = {}) {
  const auto found = std::find_if(claims.begin(), claims.end(),
                                  [&](const Claim& c) { return c.predicate == what && (of.empty() || c.of == of); });
  return found == claims.end() ? nullptr : &*found;
}

// All that a run says, in one text.
template <class R>
std::string said(const R& result) {
  return findings_of(result).conclusion();
}

// Numbers in a text outside of quotes and names, parsed independently of the program.
inline std::vector<std::string> numbers_in(const std::string& text) {
  std::vector<std::string> numbers;
  bool quoted = false;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  for (std::size_t i = 0; i < text.size(); ++i) {
    quoted = quoted != (text[i] == '"');
    if (quoted || !is_digit(text[i]) || (i > 0 && (is_letter(text[i - 1]) || text[i - 1] == '.'))) continue;
    std::size_t end = i;
    while (end < text.size() &&
           (is_digit(text[end]) || (text[end] == '.' && end + 1 < text.size() && is_digit(text[end + 1]))))
      ++end;
    if (end == text.size() || !is_letter(text[end]) || text[end] == 'e') numbers.push_back(text.substr(i, end - i));
    i = end;
  }
  return numbers;
}

inline std::string in_one_run_of_words(std::string text) {
  std::string words;
  for (const char c : text)
    if (c != '\n' && c != ' ')
      words += c;
    else if (!words.empty() && words.back() != ' ')
      words += ' ';
  return words;
}

// The same first sentence on the terminal, in the short and the full form, on the page and in JSON; at most four digits.
inline void expect_valid_conclusion(const Findings& f, const std::string& whose) {
  const std::vector<std::string> sentences = concluded(f.claims);
  ASSERT_FALSE(sentences.empty()) << whose;
  const std::string& first = sentences.front();
  EXPECT_TRUE(in_one_line(page_of(f).conclusion).starts_with(first)) << whose;
  EXPECT_TRUE(nlohmann::json::parse(json_text(summary_of(f))).at("conclusion").get<std::string>().starts_with(first))
      << whose;
  EXPECT_NE(terminal_text(f).find(first), std::string::npos) << whose << ": " << first;
  if (f.brief) {
    const std::string reported = in_one_run_of_words(headline_text(f)), wanted = in_one_run_of_words(first);
    const std::size_t n = std::min<std::size_t>(60, wanted.size());  // what is longer may be cut
    EXPECT_EQ(reported.substr(0, n), wanted.substr(0, n)) << whose;
    EXPECT_NE(brief_text(f).find(headline_text(f)), std::string::npos) << whose;
  }
  for (const std::string& number : numbers_in(f.conclusion()))
    EXPECT_LE(significant_digits(number), headline_digits) << whose << ": " << number << " in " << f.conclusion();
}

}  // namespace kurbel::test
