// heading.cpp — where a heading's name ends and its unit begins.
#include "engine/tables/heading.h"

#include "engine/scene/text.h"
#include "engine/scene/units.h"

namespace kurbel {
namespace {

std::string without_blanks(std::string_view text) { return std::string(trimmed(text, " \t")); }

bool is_unit(const std::string& text) {
  UnitError error;
  return text == "-" || (!text.empty() && parse_unit(text, error));
}

// "in-lb" is no unit that is known, but was meant as one; "measured" was not.
bool looks_like_unit(const std::string& text) {
  if (is_unit(text)) return true;
  UnitError error;
  if (text.empty() || text.find(' ') != std::string::npos) return false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of("-*/.·^", begin), text.size());
    if (end > begin && end - begin < text.size() && parse_unit(text.substr(begin, end - begin), error)) return true;
    begin = end + 1;
  }
  return false;
}

}  // namespace

NameWithUnit name_with_unit(std::string_view heading) {
  const std::string text = without_blanks(heading);
  const auto split = [&](std::size_t name_end, std::size_t unit_begin, std::size_t unit_end) {
    return NameWithUnit{without_blanks(std::string_view(text).substr(0, name_end)),
                        without_blanks(std::string_view(text).substr(unit_begin, unit_end - unit_begin))};
  };
  if (const std::size_t open = text.rfind('['); open != std::string::npos && text.ends_with(']'))
    return split(open, open + 1, text.size() - 1);
  if (const std::size_t open = text.rfind('('); open != std::string::npos && open > 0 && text.ends_with(')'))
    if (NameWithUnit both = split(open, open + 1, text.size() - 1); looks_like_unit(*both.unit)) return both;
  for (const std::string_view between : {"/", " in "})
    if (const std::size_t at = text.find(between); at != std::string::npos && at > 0)
      if (NameWithUnit both = split(at, at + between.size(), text.size()); is_unit(*both.unit)) return both;
  return {text, {}};
}

std::optional<std::string> unit_in_cell(std::string_view cell) {
  const std::string text = without_blanks(cell);
  const bool bracketed =
      text.size() > 1 && ((text.front() == '[' && text.back() == ']') || (text.front() == '(' && text.back() == ')'));
  if (bracketed) return without_blanks(std::string_view(text).substr(1, text.size() - 2));
  return is_unit(text) ? std::optional(text) : std::nullopt;
}

}  // namespace kurbel
