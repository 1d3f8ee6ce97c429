// broken_dimension.cpp — comparing them, and their names.
#include "engine/values/broken_dimension.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kurbel {

BrokenDimension broken(const Dimension& dimension) {
  BrokenDimension d{};
  std::copy(dimension.exponent.begin(), dimension.exponent.end(), d.begin());
  return d;
}

bool same_dimension(const BrokenDimension& a, const BrokenDimension& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(std::abs(a[i] - b[i]) < 1e-9)) return false;
  return true;
}

std::string name_of(const BrokenDimension& dimension) {
  Dimension whole;
  for (std::size_t i = 0; i < dimension.size(); ++i) whole.exponent[i] = static_cast<int>(std::lround(dimension[i]));
  if (same_dimension(broken(whole), dimension)) return name_of(whole);
  constexpr const char* symbols[] = {"kg", "m", "s", "rad", "A"};
  std::string text;
  for (std::size_t i = 0; i < dimension.size(); ++i)
    if (dimension[i] != 0) text += fmt::format("{}{}^{:.4g}", text.empty() ? "" : "·", symbols[i], dimension[i]);
  return text;
}

}  // namespace kurbel
