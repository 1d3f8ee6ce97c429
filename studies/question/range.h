// range.h — a range as it is written on the command line: "20..200 rpm", "20 rpm..200 rpm", "20 … 200 rpm".
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace kurbel {

// A number and what stands behind it: "500 kN*m/rad". Empty: no finite number is at the beginning.
struct Numbered {
  double value = 0;
  std::string_view rest;
};
std::optional<Numbered> numbered(std::string_view text);

// Both ends, each with its unit, which the second one gives to a plain number before it: "20 rpm", "200 rpm". Empty: no range.
std::optional<std::array<std::string, 2>> range_ends(std::string_view text);

}  // namespace kurbel
