// rounding.cpp — digits end at the error, or after the requested number of digits.
#include "studies/claims/rounding.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "studies/claims/headline.h"
#include "studies/claims/ranges.h"

namespace kurbel {
namespace {

constexpr int digits_without_error = 6, digits_of_counts = 12;

// As "{:.{}e}" writes it.
struct Scientific {
  Scientific(double x, int digits)
      : end(std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::scientific, digits).ptr) {}
  double number() const {
    double value = 0;
    std::from_chars(text.data(), end, value);
    return value;
  }
  std::array<char, 40> text;
  char* end;
};

// Decimal exponent of the first significant digit, from its text where the logarithm is next to a whole number.
int exponent_of(double x) {
  const double logarithm = std::log10(std::abs(x)), whole = std::floor(logarithm);
  if (logarithm - whole > 1e-9 && logarithm - whole < 1 - 1e-9) return static_cast<int>(whole);
  const Scientific written(std::abs(x), 16);
  int exponent = 0;
  const char* sign = std::find(written.text.data(), static_cast<const char*>(written.end), 'e') + 1;
  std::from_chars(sign + (*sign == '+'), written.end, exponent);
  return exponent;
}

double power_of_ten(int exponent) {
  static constexpr auto exact = [] {  // their quotients are rounded right
    std::array<double, 23> power{1};
    for (std::size_t k = 1; k < power.size(); ++k) power[k] = 10 * power[k - 1];
    return power;
  }();
  const auto size = static_cast<std::size_t>(std::abs(exponent));
  if (size < exact.size()) return exponent >= 0 ? exact[size] : 1 / exact[size];
  return std::strtod(fmt::format("1e{}", exponent).c_str(), nullptr);
}

// The value with its last digit at 10^place, in fixed notation from 1e-4 to 1e9.
std::string written(double value, int place) {
  const double magnitude = std::abs(value);
  if (value == 0 || (magnitude >= 1e-4 && magnitude < 1e9)) {
    if (place <= 0) return fmt::format("{:.{}f}", value, value == 0 && -place > 6 ? 0 : -place);
    return fmt::format("{:.0f}", value);
  }
  return fmt::format("{:.{}e}", value, std::max(0, exponent_of(value) - place));
}

double rounded_to(double value, int place) {
  const int digits = value == 0 ? 0 : exponent_of(value) - place;  // behind the first
  if (digits < 0) {
    const double unit = power_of_ten(place);
    return std::abs(value) >= 0.5 * unit ? std::copysign(unit, value) : 0;
  }
  return Scientific(value, std::min(digits, 17)).number();
}

// Number of units 10^place in the error, rounded up; whole numbers are kept despite round-off.
double units_of(double error, int place) { return std::ceil(error / power_of_ten(place) * (1 - 1e-12)); }

std::string error_text(double units, int place) {
  const double upper = units * power_of_ten(place);
  const bool fixed = upper >= 1e-5 && upper < 1e9;
  return "± " + (fixed ? fmt::format("{:.{}f}", upper, std::max(0, -place))
                       : fmt::format("{:.{}e}", upper, units >= 10 ? 1 : 0));
}

// Decimal exponent of the last digit of an error of one significant digit, of two where the first is a 1.
int last_place_of_error(double size) {
  const int place = exponent_of(size);
  return size < 2 * power_of_ten(place) ? place - 1 : place;
}

}  // namespace

FigureText figure_text(const Estimate& estimate, int most_digits) {
  if (!std::isfinite(estimate.value)) return {"—", ""};
  const double value = estimate.value + 0.0;  // no −0
  const std::optional<double>& error = estimate.error;
  if (!error || !std::isfinite(*error)) return {rounded_number(value, std::min(most_digits, digits_without_error)), ""};
  if (*error == 0) {  // a number of teeth or of rows is shown whole
    const bool counts = most_digits >= digits_in_tables && value == std::round(value);
    return {rounded_number(value, counts ? digits_of_counts : most_digits), "± 0"};
  }
  if (3 * std::abs(value) <= *error && value != 0) return figure_text({0, *error + std::abs(value)}, most_digits);
  const double size = std::abs(*error);
  int place = last_place_of_error(size);
  int least_place = place;
  if (value != 0)
    least_place = exponent_of(rounded_to(value, exponent_of(value) - (most_digits - 1))) - (most_digits - 1);
  if (place < least_place && size >= 0.5 * power_of_ten(least_place)) place = least_place;
  if (place < least_place) {
    double units = units_of(size, place);
    if (units >= 20) units = units_of(size, ++place);
    return {written(rounded_to(value, least_place) + 0.0, least_place), error_text(units, place)};
  }
  // The value ends at the place of the error's last digit.
  double shown = rounded_to(value, place), units = units_of(size + std::abs(value - shown), place);
  while (units >= 20) {  // 19.8 units and half a one for the value's rounding are 2 of the next place
    shown = rounded_to(value, ++place);
    units = units_of(size + std::abs(value - shown), place);
  }
  return {written(shown + 0.0, place), error_text(units, place)};
}

std::string range_text(double low, double high, int digits) {
  const auto text = [](const std::string& from, const std::string& to) { return from == to ? to : from + " … " + to; };
  const auto [least, size] = std::minmax({std::abs(low), std::abs(high)});
  const auto place_of = [digits](double x) { return exponent_of(x) - (digits - 1); };
  const bool known = std::isfinite(size) && size > 0;
  const int place = known ? place_of(rounded_to(size, place_of(size))) : 0;
  if (!known || (least > 0 && exponent_of(least) <= place))
    return text(rounded_number(low, digits), rounded_number(high, digits));
  std::string from = written(rounded_to(low, place) + 0.0, place), to = written(rounded_to(high, place) + 0.0, place);
  const auto is_scientific = [](const std::string& number) { return number.find('e') < number.size(); };
  if (is_scientific(from) != is_scientific(to) || low == 0 || high == 0)
    return text(rounded_number(low, digits), rounded_number(high, digits));
  const auto ends_with = [&](char c) { return from.ends_with(c) && to.ends_with(c); };
  const bool decimals = from.find('.') < from.size() && to.find('.') < to.size() && !is_scientific(from);
  while (decimals && ends_with('0')) from.pop_back(), to.pop_back();
  if (decimals && ends_with('.')) from.pop_back(), to.pop_back();
  return text(from, to);
}

bool error_is_visible(const Estimate& estimate, const FigureText& text) {
  if (text.error.empty() || text.error == "± 0") return false;
  const std::size_t point = text.value.find('.'), exponent = text.value.find('e');
  const std::size_t end = std::min(exponent, text.value.size());
  int place = point == std::string::npos ? 0 : -static_cast<int>(end - point - 1);
  if (exponent != std::string::npos) place += std::atoi(text.value.c_str() + exponent + 1);
  return *estimate.error > 0.5 * power_of_ten(place);
}

}  // namespace kurbel
