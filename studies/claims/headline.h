// headline.h — the conclusion of a study, made from its claims. A headline rounds: no number in it has more than four
// significant digits.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "studies/claims/claim.h"

namespace kurbel {

inline constexpr int headline_digits = 4;

// Numbers with more significant digits are rounded to four; an error smaller than a thousandth of its number is
// omitted. Quoted names, and digits within words, are unchanged.
//     "724.8855 ± 1e-06 N·m in \"shaft_10001\""  →  "724.9 N·m in \"shaft_10001\""
std::string headline(std::string_view text);

// Numbers in a text in readable form, without loss of digits: no exponent between 1e-4 and 1e9, outside of
// 1e-4 … 1e4 with a unit prefix where the unit takes one, no minus before zero. Quoted names are unchanged.
//     "1.155e+05 N·m, 35471600 N·m/rad, 1.3e+02 %, -0.0 J"  →  "115.5 kN·m, 35.4716 MN·m/rad, 130 %, 0.0 J"
std::string readable(std::string_view text);

// Rounded to `digits` significant digits; no exponent from 1e4 to 1e9: 410470, not 4.1047e+05.
std::string rounded_number(double value, int digits);

// A number as in a headline: 19092.63 → "19090", 0.10438192 → "0.1044", 1.0 → "1".
std::string headline_number(double value);

// Capital letter if it begins with a lower-case word; names of figures ("peak_torque.shaft") are unchanged.
std::string capitalised(std::string sentence);

// Significant digits as written: "0.0120" has 3, "19000" has 2, "1.0e-06" has 2.
int significant_digits(std::string_view number);

// Of the machine as it is bad news first; behind it what is said of its variants, then figures. Bad news by question, then
// by severity, then by how far it is beyond its limit, at most two of a question; then the others by question, each as it
// was given. With full stops, and rounded as headlines are.
//     figures_told "δ is 0.1043819", limit_exceeded "\"clutch\" gets too hot"
//         → "\"clutch\" gets too hot.", "δ is 0.1044."
std::vector<std::string> concluded(Claims claims);

// In one line.
std::string in_one_line(const std::vector<std::string>& sentences);

}  // namespace kurbel
