// range.cpp — reads a number with what stands behind it, and the ends of a range.
#include "studies/question/range.h"

#include <charconv>
#include <cmath>

#include "engine/scene/text.h"

namespace kurbel {

std::optional<Numbered> numbered(std::string_view text) {
  text = trimmed(text);
  double value = 0;
  const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) return {};
  return Numbered{value, trimmed({end, static_cast<std::size_t>(text.data() + text.size() - end)})};
}

std::optional<std::array<std::string, 2>> range_ends(std::string_view text) {
  for (const std::string_view dots : {"...", "..", "…"})
    if (const std::size_t at = text.find(dots); at != std::string_view::npos) {
      std::array ends = {std::string(trimmed(text.substr(0, at))), std::string(trimmed(text.substr(at + dots.size())))};
      const auto low = numbered(ends[0]), high = numbered(ends[1]);
      if (low && low->rest.empty() && high && !high->rest.empty()) ends[0] += " " + std::string(high->rest);
      return ends;
    }
  return {};
}

}  // namespace kurbel
