// parameter.cpp — parsing of ranges and lists from the command line or a table.
#include "studies/experiments/parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "engine/scene/messages.h"
#include "engine/scene/text.h"
#include "engine/scene/units.h"
#include "engine/tables/table_file.h"
#include "studies/question/range.h"

namespace kurbel {
namespace {

constexpr const char* variations =
    "write a range \"main_coupling.stiffness=500..1500 kN*m/rad\" or a list \"flywheel.inertia=200,400,800 kg*m2\"";
constexpr std::size_t most_values = 1'000'000;

[[noreturn]] void refuse_variation(const std::string& text, const std::string& why) {
  throw std::invalid_argument(fmt::format("--vary {}: {}; {}", in_quotes(text), why, variations));
}

std::vector<std::string_view> split(std::string_view text, char by) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(by, begin);
    parts.push_back(trimmed(text.substr(begin, end - begin)));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

void check_unit(const std::string& text, const std::string& unit) {
  UnitError error;
  if (!parse_unit(unit, error)) refuse_variation(text, fmt::format("unit {}: {}", in_quotes(unit), error.text));
}

void read_range(SweptParameter& p, const std::array<std::string, 2>& ends) {
  const auto low = numbered(ends[0]), high = numbered(ends[1]);
  if (!low || !high) refuse_variation(p.given, "a range needs a number on either side of \"..\"");
  if (low->rest != high->rest)
    refuse_variation(p.given, fmt::format("the ends have two units, {} and {}; give one, behind the second end",
                                          in_quotes(low->rest), in_quotes(high->rest)));
  p.unit = high->rest;
  check_unit(p.given, p.unit);
  p.low = low->value, p.high = high->value;
  if (!(p.low < p.high)) refuse_variation(p.given, "the first end must be below the second");
}

void read_list(SweptParameter& p, std::string_view value) {
  const std::vector<std::string_view> items = split(value, ',');
  if (items.size() > most_values) refuse_variation(p.given, fmt::format("a list of more than {} values", most_values));
  const auto last = numbered(items.back());
  const auto is_plain = [&](std::string_view item) {
    const auto read = numbered(item);
    return read && (read->rest.empty() || read->rest == last->rest);
  };
  if (last && std::all_of(items.begin(), items.end() - 1, is_plain)) {
    p.unit = last->rest;
    check_unit(p.given, p.unit);
    for (const std::string_view item : items) p.values.push_back(numbered(item)->value);
    return;
  }
  for (const std::string_view item : items) {
    if (item.empty()) refuse_variation(p.given, "a value of the list is missing");
    p.values.push_back(static_cast<double>(p.values.size()));
    p.words.emplace_back(item);
  }
}

}  // namespace

double SweptParameter::at_share(double u) const {
  if (quantile) return quantile(u);
  if (!is_list()) return low + u * (high - low);
  const auto count = static_cast<double>(values.size());
  return values[static_cast<std::size_t>(std::min(std::floor(u * count), count - 1))];
}

double SweptParameter::at_step(std::size_t i, std::size_t n) const {
  if (is_list()) return values[i];
  return i + 1 == n && n > 1
             ? high
             : low + (high - low) * static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(n - 1, 1));
}

std::string SweptParameter::text_of(double value) const {
  if (!words.empty()) return words[static_cast<std::size_t>(value)];
  return unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

SweptParameter parse_parameter(const std::string& text) {
  const std::size_t equals = text.find('=');
  SweptParameter p{.path = {}, .given = text};
  if (equals == std::string::npos) refuse_variation(text, "no values");
  p.path = trimmed(std::string_view(text).substr(0, equals));
  const std::string_view value = trimmed(std::string_view(text).substr(equals + 1));
  if (p.path.empty()) refuse_variation(text, "no key");
  if (value.empty()) refuse_variation(text, "no values");
  if (const auto ends = range_ends(value))
    read_range(p, *ends);
  else
    read_list(p, value);
  return p;
}

namespace {

// "flywheel.inertia [kg*m2]"; "stages[2]" is a path.
SweptParameter parse_heading(const TableHeading& heading, const std::string& file) {
  SweptParameter p{.path = heading.name,
                   .unit = heading.unit.value_or(""),
                   .given = heading.text,
                   .where = fmt::format("{}:{}:{}", file, heading.at.line, heading.at.column)};
  const std::size_t bracket = heading.text.rfind('[');
  const bool in_heading = heading.name != heading.text && heading.text.ends_with(']');
  if (in_heading && bracket > 0 && heading.text[bracket - 1] != ' ') p.path = heading.text, p.unit.clear();
  if (p.path.empty()) throw SceneError({{file, heading.at, "a column has no heading; write COMPONENT.KEY [UNIT]"}});
  if (p.unit == "-" || p.unit == "1") p.unit.clear();
  UnitError error;
  if (!p.unit.empty() && !parse_unit(p.unit, error))
    throw SceneError({{file, heading.at, fmt::format("unit {}: {}", in_quotes(p.unit), error.text)}});
  return p;
}

// Plain numbers in a column remain numbers; a column with any other text is one of words.
void fill_column(SweptParameter& p, const std::vector<std::vector<std::string>>& cells, std::size_t k,
                 std::vector<std::vector<double>>& rows) {
  const bool numbers = std::all_of(cells.begin(), cells.end(), [&](const auto& row) {
    const auto read = numbered(row[k]);
    return read && read->rest.empty();
  });
  for (std::size_t r = 0; r < cells.size(); ++r) {
    if (numbers) {
      rows[r][k] = numbered(cells[r][k])->value;
      if (std::find(p.values.begin(), p.values.end(), rows[r][k]) == p.values.end()) p.values.push_back(rows[r][k]);
      continue;
    }
    const bool bare = numbered(cells[r][k]) && numbered(cells[r][k])->rest.empty() && !p.unit.empty();
    const std::string word = bare ? cells[r][k] + " " + p.unit : cells[r][k];
    auto found = std::find(p.words.begin(), p.words.end(), word);
    if (found == p.words.end()) {
      p.values.push_back(static_cast<double>(p.words.size()));
      found = p.words.insert(p.words.end(), word);
    }
    rows[r][k] = static_cast<double>(found - p.words.begin());
  }
  if (!numbers) p.unit.clear();
}

}  // namespace

VariantTable read_variants(const std::string& path) {
  const TableFile file(path, {.words = true});
  VariantTable table;
  for (const TableHeading& heading : file.headings()) table.parameters.push_back(parse_heading(heading, path));
  std::vector<std::vector<std::string>> cells;
  for (const std::vector<TableCell>& row : file.cells()) {
    std::vector<std::string>& texts = cells.emplace_back();
    for (const TableCell& cell : row) texts.push_back(cell.text);
  }
  if (cells.empty())
    throw SceneError({{path, {1, 1}, "no variants; the first line names the keys, each further one is a variant"}});
  table.rows.assign(cells.size(), std::vector<double>(table.parameters.size()));
  for (std::size_t k = 0; k < table.parameters.size(); ++k) fill_column(table.parameters[k], cells, k, table.rows);
  return table;
}

}  // namespace kurbel
