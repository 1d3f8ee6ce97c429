// csv.cpp — reads tables of measured or catalogue data.
#include "engine/scene/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/scene/document.h"

namespace kurbel {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\"");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\"") - begin + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  const bool semicolons = line.find(';') != std::string_view::npos, tabs = line.find('\t') != std::string_view::npos;
  const char separator = semicolons ? ';' : tabs ? '\t' : ',';
  for (std::size_t begin = 0; begin <= line.size();) {
    std::size_t end = line.find(separator, begin);
    if (end == std::string_view::npos) end = line.size();
    cells.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return cells;
}

std::optional<double> number_in(std::string_view cell) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const auto [end, status] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (status != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

// A word, not a number gone wrong: "time [s]", but not "0,5", "1e999" or "nan".
bool is_word(std::string_view cell) {
  double value = 0;
  const auto [end, status] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (!cell.empty() && status != std::errc::invalid_argument && end == cell.data() + cell.size()) return false;
  return cell.find_first_of("0123456789") == std::string_view::npos ||
         cell.find_first_not_of("0123456789+-.,eE ") != std::string_view::npos;
}

constexpr int most_bad_lines = 20;

}  // namespace

Columns read_csv(const std::string& path, int x_column, int y_column, Messages& messages) {
  const std::string text = read_text_file(path, max_csv_bytes);
  Columns columns;
  bool header_allowed = true;
  int line_number = 0, bad = 0;
  const std::size_t byte_order_mark = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  for (std::size_t begin = byte_order_mark; begin < text.size();) {
    std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) end = text.size();
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    ++line_number;
    if (bad == most_bad_lines) {
      messages.add_in(path, {line_number, 1}, fmt::format("{} bad lines so far; the rest is not read", bad));
      break;
    }
    if (trimmed(line).empty() || trimmed(line).starts_with('#')) continue;
    const std::vector<std::string_view> cells = cells_of(line);
    std::optional<double> value[2];
    bool good = true;
    const auto cell_at = [&](int column) { return cells[static_cast<std::size_t>(column - 1)]; };
    const int last_column = std::max(x_column, y_column);
    if (last_column > static_cast<int>(cells.size())) {
      messages.add_in(
          path, {line_number, 1},
          fmt::format(
              "column {} is wanted, but this line has {} cell{}; cells are separated by comma, semicolon or tab",
              last_column, cells.size(), cells.size() == 1 ? "" : "s"));
      ++bad;
      if (std::exchange(header_allowed, false)) break;  // so will all the others
      continue;
    }
    if (std::exchange(header_allowed, false) && is_word(cell_at(x_column)) && is_word(cell_at(y_column))) continue;
    for (int k = 0; k < 2; ++k) {
      const int column = k == 0 ? x_column : y_column;
      const std::string_view cell = cell_at(column);
      value[k] = number_in(cell);
      if (!value[k]) {
        good = false;
        const auto at = static_cast<int>(cell.data() - line.data()) + 1;
        messages.add_in(
            path, {line_number, cell.data() ? at : 1},
            fmt::format("{} is not a finite number{}", in_quotes(cell),
                        cell.find(',') == std::string_view::npos ? "" : "; decimals are written with a point"));
        ++bad;
        break;
      }
    }
    if (!good) continue;
    columns.x.push_back(*value[0]);
    columns.y.push_back(*value[1]);
    columns.line.push_back(line_number);
    columns.x_at.push_back(static_cast<int>(cell_at(x_column).data() - line.data()) + 1);
  }
  return columns;
}

std::vector<CsvHeading> read_headings(const std::string& path) {
  const std::string text = read_text_file(path, max_csv_bytes);
  std::string_view rest(text);
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  for (int line_number = 1; !rest.empty(); ++line_number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (trimmed(line).empty() || trimmed(line).starts_with('#')) continue;
    std::vector<CsvHeading> headings;
    for (const std::string_view cell : cells_of(line)) {
      const int at = cell.data() ? static_cast<int>(cell.data() - line.data()) + 1 : 1;
      headings.push_back({std::string(cell), static_cast<int>(headings.size()) + 1, {line_number, at}});
    }
    return headings;
  }
  return {};
}

}  // namespace kurbel
