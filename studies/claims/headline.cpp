// headline.cpp — numbers in a sentence, found and rounded.
#include "studies/claims/headline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>
#include <tuple>

#include "studies/claims/ranges.h"
#include "studies/claims/rounding.h"

namespace kurbel {
namespace {

constexpr std::string_view plus_minus = " ± ", of_range = " … ";
constexpr double least_error = 1e-3;  // of its number, that a headline reports

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_of_word(char c) { return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

// Length of the number (digits, point, exponent) that begins here; 0: none.
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

// Length of the word of letters, digits, points and hyphens that begins here.
std::size_t word_at(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && (is_of_word(text[n]) || ((text[n] == '.' || text[n] == '-') && n > 0 &&
                                                     n + 1 < text.size() && is_of_word(text[n + 1]))))
    ++n;
  return n;
}

double value_of(std::string_view number) { return std::strtod(std::string(number).c_str(), nullptr); }

std::string rounded(std::string_view number) {
  return significant_digits(number) > headline_digits ? headline_number(value_of(number)) : std::string(number);
}

// With its error, both to the same place; an error below a thousandth of its number is omitted.
std::string rounded(std::string_view number, double error) {
  const double value = value_of(number);
  if (error == 0 || error < least_error * value) return rounded(number);
  const bool has_point = number.find('.') != std::string_view::npos;
  const int given = std::max(1, significant_digits(number));
  const Estimate estimate{value, error};
  const FigureText text = figure_text(estimate, has_point ? std::min(given, headline_digits) : headline_digits);
  return error_is_visible(estimate, text) ? text.value + " " + text.error : text.value;
}

// The number with its point moved by `places` to the left: "35471600" by 6 is "35.4716". Digits are unchanged;
// trailing zeros are dropped if the number had no point.
std::string with_point_moved(std::string_view number, int places) {
  std::string digits;
  int before = 0, exponent = 0;  // digits before the point
  bool point = false;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] == 'e') {
      exponent = std::atoi(std::string(number.substr(i + 1)).c_str());
      break;
    }
    if (number[i] == '.')
      point = true;
    else
      digits += number[i], before += point ? 0 : 1;
  }
  before += exponent - places;
  if (before <= 0) digits.insert(0, static_cast<std::size_t>(1 - before), '0'), before = 1;
  if (static_cast<int>(digits.size()) < before) digits.append(static_cast<std::size_t>(before) - digits.size(), '0');
  const auto whole = static_cast<std::size_t>(before);
  std::string behind = digits.substr(whole);
  if (!point || number.find('e') != std::string_view::npos)
    while (behind.ends_with('0')) behind.pop_back();
  std::string ahead = digits.substr(0, whole);
  ahead.erase(0, std::min(ahead.find_first_not_of('0'), ahead.size() - 1));
  return behind.empty() ? ahead : ahead + "." + behind;
}

// The unit that begins here after a blank, if it takes prefixes: "N·m/rad"; else empty.
std::string_view prefixed_unit_at(std::string_view text) {
  constexpr std::string_view units[] = {"N·m·s/rad", "N·m/rad", "N·m·s", "N·m", "N/m", "N", "J", "W", "Pa", "m", "s"};
  if (!text.starts_with(' ')) return {};
  text.remove_prefix(1);
  for (const std::string_view unit : units) {
    if (!text.starts_with(unit)) continue;
    const std::string_view after = text.substr(unit.size());
    const bool goes_on =
        !after.empty() && (is_of_word(after[0]) || after[0] == '/' || after[0] == '*' || after[0] == '^' ||
                           after.starts_with("·") || after.starts_with("²") || after.starts_with("³"));
    return goes_on ? std::string_view() : unit;
  }
  return {};
}

struct Prefix {
  std::string_view name;
  int places = 0;
};
// Lengths and times have no large ones.
Prefix prefix_of(double size, std::string_view unit) {
  constexpr double least = 1e4, mega = 2e6, giga = 2e9, micro = 1e-4, nano = 1e-6, none = 1e-9;
  if (size < micro) return size >= nano ? Prefix{"µ", -6} : size >= none ? Prefix{"n", -9} : Prefix{};
  if (unit == "m" || unit == "s") return {};
  return size >= giga ? Prefix{"G", 9} : size >= mega ? Prefix{"M", 6} : size >= least ? Prefix{"k", 3} : Prefix{};
}

std::string without_exponent(std::string_view number) {
  const double size = value_of(number);
  if (number.find('e') == std::string_view::npos || !(size == 0 || (size >= 1e-4 && size < 1e9)))
    return std::string(number);
  return with_point_moved(number, 0);
}

// The text ends with a number that shares the unit of the following one, and a connector: "12000 … ".
bool shares_the_unit(std::string_view text) {
  constexpr std::string_view joints[] = {" … ", "…",   " to ", " and ", " or ", ", ", " / ",
                                         "/",   " × ", " · ",  " + ",   " - ",  " − "};
  for (const std::string_view minus : {std::string_view("-"), std::string_view("−")})
    if (text.ends_with(minus) && !text.ends_with(" " + std::string(minus) + " ")) text.remove_suffix(minus.size());
  return std::any_of(std::begin(joints), std::end(joints), [&](std::string_view joint) {
    return text.size() > joint.size() && text.ends_with(joint) && is_digit(text[text.size() - joint.size() - 1]);
  });
}

// Drops a minus at the end of the text, after nothing or a blank.
void drop_minus(std::string& text) {
  for (const std::string_view minus : {std::string_view("-"), std::string_view("−")}) {
    if (!text.ends_with(minus)) continue;
    const std::string_view before = std::string_view(text).substr(0, text.size() - minus.size());
    if (before.empty() || before.ends_with(' ') || before.ends_with('(')) text.resize(before.size());
    return;
  }
}

constexpr int most_bad_news = 2;  // of a question

std::string as_sentence(std::string sentence) {
  while (sentence.ends_with('.') || sentence.ends_with(' ') || sentence.ends_with('\n')) sentence.pop_back();
  return sentence.empty() ? sentence : capitalised(std::move(sentence)) + ".";
}

}  // namespace

std::string readable(std::string_view text) {
  std::string said;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size();) {
    quoted = quoted != (text[i] == '"');
    const std::string_view rest = text.substr(i);
    const std::size_t length = quoted ? 0 : number_at(rest), word = quoted ? 0 : word_at(rest);
    if (length == 0 || word > length) {
      said += rest.substr(0, std::max<std::size_t>(word, 1));
      i += std::max<std::size_t>(word, 1);
      continue;
    }
    const std::string_view number = rest.substr(0, length);
    std::string_view error = rest.substr(length);
    error = error.starts_with(plus_minus) ? error.substr(plus_minus.size()) : std::string_view();
    error = error.substr(0, number_at(error));
    const std::size_t whole = length + (error.empty() ? 0 : plus_minus.size() + error.size());
    const std::string_view unit = prefixed_unit_at(rest.substr(whole));
    const Prefix prefix =
        unit.empty() || shares_the_unit(said) ? Prefix{} : prefix_of(std::max(value_of(number), value_of(error)), unit);
    const auto shown = [&](std::string_view n) {
      return prefix.places != 0 ? with_point_moved(n, prefix.places) : without_exponent(n);
    };
    if (value_of(number) == 0) drop_minus(said);
    said += shown(number);
    if (!error.empty()) said += std::string(plus_minus) + shown(error);
    i += whole;
    if (prefix.places == 0) continue;
    said += " " + std::string(prefix.name) + std::string(unit);
    i += 1 + unit.size();
  }
  return said;
}

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
    i += number;
    std::string_view error = text.substr(i);
    std::string_view end = error.starts_with(of_range) ? error.substr(of_range.size()) : std::string_view();
    end = end.substr(0, number_at(end));
    if (std::max(significant_digits(digits), significant_digits(end)) > headline_digits && !end.empty()) {
      said += range_text(value_of(digits), value_of(end), headline_digits);
      i += of_range.size() + end.size();
      continue;
    }
    error = error.starts_with(plus_minus) ? error.substr(plus_minus.size()) : std::string_view();
    error = error.substr(0, number_at(error));
    said += error.empty() ? rounded(digits) : rounded(digits, value_of(error));
    if (!error.empty()) i += plus_minus.size() + error.size();
  }
  return readable(said);
}

std::string capitalised(std::string sentence) {
  const std::string first = sentence.substr(0, sentence.find(' '));
  if (first.find_first_of("_.") != std::string::npos && first != sentence) return sentence;  // a figure's name
  if (!sentence.empty() && sentence[0] >= 'a' && sentence[0] <= 'z')
    sentence[0] = static_cast<char>(sentence[0] - 'a' + 'A');
  return sentence;
}

std::vector<std::string> concluded(Claims claims) {
  std::erase_if(claims, [](const Claim& c) { return !c.in_conclusion; });
  std::stable_sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) {
    const auto place = [](const Claim& c) {
      const bool bad = c.is_bad();
      // What is wrong with the machine, with its variants, what else is said of it and of them, figures.
      const int part = bad ? (c.variant.empty() ? 0 : 1) : !c.variant.empty() ? 3 : c.topic() < Topic::figures ? 2 : 4;
      return std::tuple(part, c.topic(), bad ? -static_cast<int>(c.severity()) : 0,
                        bad && c.topic() == Topic::bears ? -c.share() : 0, bad ? c.predicate : Predicate{});
    };
    return place(a) < place(b);
  });
  std::vector<std::string> sentences;
  std::map<std::pair<bool, Topic>, int> reported;
  for (const Claim& claim : claims) {
    if (claim.is_bad() && ++reported[{claim.variant.empty(), claim.topic()}] > most_bad_news) continue;
    if (std::string sentence = as_sentence(headline(claim.text)); !sentence.empty())
      sentences.push_back(std::move(sentence));
  }
  return sentences;
}

std::string in_one_line(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : " ") + sentence;
  return text;
}

}  // namespace kurbel
