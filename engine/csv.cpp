// csv.cpp — reads tables of measured or catalogue data.
#include "engine/csv.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "engine/document.h"

namespace kurbel {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\"");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\"") - begin + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    std::size_t end = line.find_first_of(",;\t", begin);
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

}  // namespace

Columns read_csv(const std::string& path, int x_column, int y_column, Messages& messages) {
  const std::string text = read_text_file(path, max_csv_bytes);
  Columns columns;
  bool header_allowed = true;
  int line_number = 0, bad = 0;
  for (std::size_t begin = 0; begin < text.size() && bad < 20;) {
    std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) end = text.size();
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    ++line_number;
    if (trimmed(line).empty() || trimmed(line).starts_with('#')) continue;
    const std::vector<std::string_view> cells = cells_of(line);
    std::optional<double> value[2];
    bool good = true;
    for (int k = 0; k < 2; ++k) {
      const int column = k == 0 ? x_column : y_column;
      if (column > static_cast<int>(cells.size())) {
        messages.add_in(path, {line_number, 1},
                        fmt::format("{} cell(s) in this line; column {} is wanted", cells.size(), column));
        good = false;
        ++bad;
        break;
      }
      const std::string_view cell = cells[static_cast<std::size_t>(column - 1)];
      value[k] = number_in(cell);
      if (!value[k]) {
        good = false;
        if (header_allowed) break;
        const auto at = static_cast<int>(cell.data() - line.data()) + 1;
        messages.add_in(path, {line_number, cell.data() ? at : 1},
                        fmt::format("\"{}\" is not a finite number; decimals are written with a point", cell));
        ++bad;
      }
    }
    header_allowed = false;
    if (!good) continue;
    columns.x.push_back(*value[0]);
    columns.y.push_back(*value[1]);
  }
  return columns;
}

}  // namespace kurbel
