// data_table.cpp — reads the CSV that studies write: remarks, a line of headings with units, cells without quotes.
#include "studies/tables/data_table.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <optional>
#include <stdexcept>

namespace kurbel {
namespace {

// Takes what stands before the mark off the text, and the mark.
std::string_view cut(std::string_view& text, char mark) {
  const std::size_t end = text.find(mark);
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

// "torque.shaft [N*m]"
DataColumn column_headed(std::string_view heading) {
  const std::size_t open = heading.rfind(" [");
  if (open == std::string_view::npos || !heading.ends_with(']')) return {.name = std::string(heading)};
  return {.name = std::string(heading.substr(0, open)),
          .unit = std::string(heading.substr(open + 2, heading.size() - open - 3))};
}

// An empty cell is a number that is not known.
std::optional<double> number_in(std::string_view cell) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const auto [end, status] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (status != std::errc{} || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

void put(DataColumn& column, std::string_view cell) {
  const std::optional<double> number = number_in(cell);
  if (!number && !column.is_words())
    for (const double before : column.numbers) column.words.push_back(fmt::format("{}", before));
  if (!number || column.is_words()) column.words.emplace_back(cell);
  column.numbers.push_back(number.value_or(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace

std::size_t DataTable::rows() const { return columns.empty() ? 0 : columns.front().numbers.size(); }

std::vector<const DataColumn*> DataTable::numbers() const {
  std::vector<const DataColumn*> all;
  for (const DataColumn& column : columns)
    if (!column.is_words()) all.push_back(&column);
  return all;
}

DataTable data_table(const std::string& file, std::string_view csv) {
  DataTable table{.name = file.substr(0, file.rfind('.')), .remark = {}, .columns = {}};
  while (csv.starts_with("# ")) table.remark += cut(csv, '\n').substr(2);
  for (std::string_view headings = cut(csv, '\n'); !headings.empty();)
    table.columns.push_back(column_headed(cut(headings, ',')));
  while (!csv.empty()) {
    std::string_view line = cut(csv, '\n');
    for (DataColumn& column : table.columns) put(column, cut(line, ','));
    if (!line.empty()) throw std::logic_error(fmt::format("{}: a row has more cells than there are headings", file));
  }
  return table;
}

}  // namespace kurbel
