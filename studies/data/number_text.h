// number_text.h — numbers with a given number of significant digits, as text.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace kurbel {

namespace number_text_detail {

inline constexpr std::array<double, 23> ten_to = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                  1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                  1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// Usual numbers in a sixth of the time: scaled by a power of ten that is exact, so that one rounding is known to be less
// than a thousandth of the last digit. Null: another number, or too near to the middle of two.
inline char* put_plain(char* out, double value, int digits) {
  const double size = std::abs(value);
  if (!(size >= 1e-4 && size < 1e11) || digits < 1 || digits > 12) return nullptr;
  int point = size >= 1 ? 1 : -3;  // of the digits, that of the first one before it
  while (point < 11 &&
         size >= (point < 0 ? 1 / ten_to[static_cast<std::size_t>(-point)] : ten_to[static_cast<std::size_t>(point)]))
    ++point;
  const int shift = digits - point;
  if (shift > 22) return nullptr;
  const double scaled =
      shift >= 0 ? size * ten_to[static_cast<std::size_t>(shift)] : size / ten_to[static_cast<std::size_t>(-shift)];
  auto whole = static_cast<std::uint64_t>(scaled);
  const double rest = scaled - static_cast<double>(whole);
  if (std::abs(rest - 0.5) < 1e-3) return nullptr;
  whole += rest > 0.5;
  const auto least = static_cast<std::uint64_t>(ten_to[static_cast<std::size_t>(digits - 1)]);
  if (point > digits || whole < least || whole >= 10 * least) return nullptr;
  if (value < 0) *out++ = '-';
  std::array<char, 32> text{};
  const char* const first = text.data();
  const char* last = std::to_chars(text.data(), text.data() + text.size(), whole).ptr;
  while (last - first > std::max(point, 1) && last[-1] == '0') --last;  // at least behind the point
  const auto copy = [&](const char* from, std::ptrdiff_t count) {
    std::memcpy(out, from, 16);  // more than count, at one go
    out += count;
  };
  if (point <= 0) {
    copy("0.00000000000000", 2 - point);
    copy(first, last - first);
    return out;
  }
  copy(first, point);
  if (last - first == point) return out;
  *out++ = '.';
  copy(first + point, last - first - point);
  return out;
}

}  // namespace number_text_detail

// As printf's "%.*g" and {fmt}'s "{:.{}g}"; at most 40 digits.
inline void append_digits(std::string& text, double value, int digits) {
  char place[64];
  char* end = number_text_detail::put_plain(place, value, digits);
  if (!end) end = std::to_chars(place, place + sizeof place, value, std::chars_format::general, digits).ptr;
  text.append(place, static_cast<std::size_t>(end - place));
}

}  // namespace kurbel
