// headline.h — a headline rounds: no number in it has more than four significant digits.
#pragma once

#include <string>
#include <string_view>

namespace kurbel {

inline constexpr int headline_digits = 4;

// Numbers with more significant digits are rounded to four; an error that is smaller than a thousandth of its number is
// dropped. Names in quotes, and digits that are part of a word, stay as they are.
//     "724.8855 ± 1e-06 N·m in \"shaft_10001\""  →  "724.9 N·m in \"shaft_10001\""
std::string headline(std::string_view text);

// Numbers in a text as people read them, no digit lost: between 1e-4 and 1e9 without an exponent, from 1e4 on with the prefix of
// their unit where it takes one, and no minus before a zero. Names in quotes stay.
//     "1.155e+05 N·m, 35471600 N·m/rad, 1.3e+02 %, -0.0 J"  →  "115.5 kN·m, 35.4716 MN·m/rad, 130 %, 0.0 J"
std::string readable(std::string_view text);

// Rounded to so many significant digits; from 1e4 to 1e9 without an exponent: 410470, not 4.1047e+05.
std::string rounded_number(double value, int digits);

// A number as a headline has it: 19092.63 → "19090", 0.10438192 → "0.1044", 1.0 → "1".
std::string headline_number(double value);

// With a capital letter where it begins with a word in small ones; names of figures ("peak_torque.shaft") stay.
std::string capitalised(std::string sentence);

// Significant digits as they are written: "0.0120" has 3, "19000" has 2, "1.0e-06" has 2.
int significant_digits(std::string_view number);

}  // namespace kurbel
