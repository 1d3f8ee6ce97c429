// headline.cpp — numbers in a sentence, found and rounded.
#include "studies/claims/headline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace kurbel {
namespace {

constexpr std::string_view plus_minus = " ± ";
constexpr double least_error = 1e-3;  // of its number, that a headline tells

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_of_word(char c) { return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

// Digits, a point with digits, an exponent: how long the number is that begins here; 0: none does.
std::size_t number_at(std::string_view text) {
  std::size_t n = 0;
  const auto digits = [&] {
    const std::size_t begin = n;
    while (n < text.size() && is_digit(text[n])) ++n;
    return n > begin;
  };
  if (!digits()) return 0;
  if (n + 1 < text.size() && text[n] == '.' && is_digit(text[n + 1])) ++n, digits();
  if (n + 1 < text.size() && text[n] == 'e') {
    const std::size_t before = n++;
    if (text[n] == '+' || text[n] == '-') ++n;
    if (!digits()) n = before;
  }
  return n;
}

// As long as the word of letters and digits, with points within, that begins here.
std::size_t word_at(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && (is_of_word(text[n]) || (text[n] == '.' && n + 1 < text.size() && is_of_word(text[n + 1]))))
    ++n;
  return n;
}

double value_of(std::string_view number) { return std::strtod(std::string(number).c_str(), nullptr); }

std::string rounded(std::string_view number) {
  return significant_digits(number) > headline_digits ? headline_number(value_of(number)) : std::string(number);
}

}  // namespace

int significant_digits(std::string_view number) {
  std::string digits;
  bool point = false;
  for (const char c : number) {
    if (c == 'e') break;
    point = point || c == '.';
    if (is_digit(c) && !(digits.empty() && c == '0')) digits += c;
  }
  while (!point && digits.ends_with('0')) digits.pop_back();
  return static_cast<int>(digits.size());
}

std::string rounded_number(double value, int digits) {
  if (!std::isfinite(value)) return "—";
  const std::string shown = fmt::format("{:.{}g}", value + 0.0, digits);
  const double round = std::strtod(shown.c_str(), nullptr), size = std::abs(round);
  return shown.find('e') != std::string::npos && size >= 1e4 && size < 1e9 ? fmt::format("{:.0f}", round) : shown;
}

std::string headline_number(double value) { return rounded_number(value, headline_digits); }

std::string headline(std::string_view text) {
  std::string said;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size();) {
    quoted = quoted != (text[i] == '"');
    const std::size_t number = quoted ? 0 : number_at(text.substr(i)), word = quoted ? 0 : word_at(text.substr(i));
    if (number == 0 || word > number) {  // punctuation, a name, a version: as it is
      said += text.substr(i, std::max<std::size_t>(word, 1));
      i += std::max<std::size_t>(word, 1);
      continue;
    }
    const std::string_view digits = text.substr(i, number);
    said += rounded(digits);
    i += number;
    if (!text.substr(i).starts_with(plus_minus)) continue;
    const std::string_view error = text.substr(i + plus_minus.size());
    const std::size_t length = number_at(error);
    if (length == 0) continue;
    const double size = value_of(error.substr(0, length));
    if (size >= least_error * std::abs(value_of(digits)) && size > 0)
      said += std::string(plus_minus) + rounded(error.substr(0, length));
    i += plus_minus.size() + length;
  }
  return said;
}

std::string capitalised(std::string sentence) {
  const std::string first = sentence.substr(0, sentence.find(' '));
  if (first.find_first_of("_.") != std::string::npos && first != sentence) return sentence;  // a figure's name
  if (!sentence.empty() && sentence[0] >= 'a' && sentence[0] <= 'z')
    sentence[0] = static_cast<char>(sentence[0] - 'a' + 'A');
  return sentence;
}

}  // namespace kurbel
