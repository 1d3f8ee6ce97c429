// number_text.h — numbers with a given number of significant digits, as text.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
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
constexpr int least_power = -10;
inline constexpr std::array<double, 26> power_of_ten = {1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2,
                                                        1e-1,  1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                        1e8,   1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
inline constexpr std::array<std::uint32_t, 10> whole_ten_to = {1,      10,      100,      1000,      10000,
                                                               100000, 1000000, 10000000, 100000000, 1000000000};

// Eight decimal digits, the first one in the lowest byte: split into fours, twos and ones, all of them at once.
inline std::uint64_t eight_digits(std::uint32_t number) {
  std::uint64_t parts = number / 10000 + (static_cast<std::uint64_t>(number % 10000) << 32);
  std::uint64_t high = (parts * 5243 >> 19) & 0x0000007F0000007F;  // hundredths
  parts = high + ((parts - 100 * high) << 16);
  high = (parts * 103 >> 10) & 0x000F000F000F000F;  // tenths
  return high + ((parts - 10 * high) << 8);
}

// As characters.
inline void put_eight(char* out, std::uint64_t digits) {
  digits |= 0x3030303030303030;
  if constexpr (std::endian::native == std::endian::big) digits = __builtin_bswap64(digits);
  std::memcpy(out, &digits, 8);
}

// Usual numbers, several times faster than by the library: scaled by a power of ten that is exact, so that one rounding
// is known to be less than a thousandth of the last digit. Null: another number, or too near to the middle of two.
inline char* put_usual(char* out, double value, int digits) {
  const double size = std::abs(value);
  if (digits < 1 || digits > 12) return nullptr;
  if (std::signbit(value)) *out++ = '-';
  if (size == 0) return *out = '0', out + 1;
  if (!(size >= 1e-10 && size < 1e15)) return nullptr;
  // Of the digits, that of the first one before the point: its logarithm from that of the power of two below.
  int point = ((static_cast<int>(std::bit_cast<std::uint64_t>(size) >> 52) - 1023) * 1233 >> 12) + 1;
  point += size >= power_of_ten[static_cast<std::size_t>(point - least_power)];
  const int shift = digits - point;
  const double scaled =
      shift >= 0 ? size * ten_to[static_cast<std::size_t>(shift)] : size / ten_to[static_cast<std::size_t>(-shift)];
  auto whole = static_cast<std::int64_t>(scaled);
  const double rest = scaled - static_cast<double>(whole);
  if (std::abs(rest - 0.5) < 1e-3) return nullptr;
  whole += rest > 0.5;
  // As eight or sixteen digits with zeros at the end.
  std::uint64_t first = static_cast<std::uint64_t>(whole), second = 0;
  if (digits <= 8) {
    first *= whole_ten_to[static_cast<std::size_t>(8 - digits)];
  } else {
    second = first * whole_ten_to[static_cast<std::size_t>(16 - digits)];
    first = second / 100000000, second %= 100000000;
  }
  if (first < 10000000 || first >= 100000000) return nullptr;
  char text[32];  // the digits, of which more than there are is copied at one go
  first = eight_digits(static_cast<std::uint32_t>(first));
  put_eight(text, first);
  int count = 8 - std::countl_zero(first) / 8;  // without the zeros at the end
  if (second != 0) {
    second = eight_digits(static_cast<std::uint32_t>(second));
    put_eight(text + 8, second);
    count = 16 - std::countl_zero(second) / 8;
  }
  const bool plain = point > -4 && point <= digits;
  const int before = plain ? std::max(point, 0) : 1;
  if (second == 0 && before > 8) put_eight(text + 8, 0);
  if (before == 0) {
    std::memcpy(out, "0.000", 5);
    out += 2 - point;
    std::memcpy(out, text, 16);
    return out + count;
  }
  std::memcpy(out, text, 16);
  out += before;
  if (count > before) {
    *out++ = '.';
    std::memcpy(out, text + before, 16);
    out += count - before;
  }
  if (plain) return out;
  const int power = std::abs(point - 1);
  *out++ = 'e';
  *out++ = point < 1 ? '-' : '+';
  *out++ = static_cast<char>('0' + power / 10);
  *out++ = static_cast<char>('0' + power % 10);
  return out;
}

}  // namespace number_text_detail

// As printf's "%.*g" and {fmt}'s "{:.{}g}"; at most 40 digits. Returns the end; at most 64 characters are touched.
inline char* put_digits(char* out, double value, int digits) {
  if (char* const end = number_text_detail::put_usual(out, value, digits)) return end;
  return std::to_chars(out, out + 64, value, std::chars_format::general, digits).ptr;
}
inline void append_digits(std::string& text, double value, int digits) {
  char place[64];
  text.append(place, static_cast<std::size_t>(put_digits(place, value, digits) - place));
}

}  // namespace kurbel
