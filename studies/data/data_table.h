// data_table.h — a long table as data: what its columns hold, and its rows, made one after another as they are written.
//
//   data_of("diagrams", angles)
//       .column("phi", "rad", std::identity())
//       .column("M_d", "N*m", torque, 9);   // nine digits in CSV
//
// CSV, MAT and XLSX are renderings of it. Nobody holds all rows: a trajectory may have millions.
#pragma once

#include <cmath>
#include <concepts>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace kurbel {

// How a number is written, in each file alike.
struct NumberFormat {
  int digits = 0;            // significant ones; 0: as many as give the same double again
  bool after_point = false;  // digits are those behind the point
};
inline constexpr NumberFormat whole_number{.digits = 0, .after_point = true};

struct DataColumn {
  std::string name;  // "torque.main_coupling"
  std::optional<std::string> unit =
      {};  // "N*m"; empty: a plain number; none: words, or a plain number without brackets
  NumberFormat format = {};
  bool words = false;  // not numbers
};

using DataCell = std::variant<double, std::string>;  // NaN: nothing is known there
using DataRow = std::span<const DataCell>;           // a cell a column

struct DataTable {
  std::string name = {};    // "trajectory"
  std::string remark = {};  // to be read before it: "incomplete: stopped at t = 1 s"; empty: nothing
  std::vector<DataColumn> columns = {};
  std::function<void(const std::function<void(DataRow)>& take)> each_row = {};
};

// "torque.shaft [N*m]"
std::string heading_of(const std::string& name, const std::optional<std::string>& unit);

// The number that a column's text gives when it is read: MAT and XLSX hold the same as CSV, to the last bit.
double as_written(double value, const NumberFormat& format);

// A line of headings, then a line a row; "# remark" before. An empty cell is a number that is not known.
std::string csv_text(const DataTable& table);

// A table made only when it is written.
struct TableFile {
  std::string name;  // "trajectory"
  std::function<DataTable()> table;
};

// A row of the table for each of a list's items.
template <class T>
class DataOf {
 public:
  DataOf(std::string name, std::span<const T> rows, std::shared_ptr<const std::vector<T>> owned)
      : rows_(rows), owned_(std::move(owned)) {
    table_.name = std::move(name);
  }
  // `get` gives a number, or std::optional of one (what is not finite is not known), or words.
  template <class Get>
  DataOf& column(std::string name, std::optional<std::string> unit, Get get, int digits = 12) {
    using Got = std::remove_cvref_t<std::invoke_result_t<Get&, const T&>>;
    table_.columns.push_back({.name = std::move(name),
                              .unit = std::move(unit),
                              .format = std::integral<Got> ? whole_number : NumberFormat{digits},
                              .words = std::same_as<Got, std::string>});
    cells_.push_back([get = std::move(get)](const T& row) { return cell(std::invoke(get, row)); });
    return *this;
  }
  DataTable table() const {
    DataTable table = table_;
    table.each_row = [rows = rows_, owned = owned_, cells = cells_](const std::function<void(DataRow)>& take) {
      std::vector<DataCell> made(cells.size());
      for (const T& row : rows) {
        for (std::size_t k = 0; k < cells.size(); ++k) made[k] = cells[k](row);
        take(made);
      }
    };
    return table;
  }

 private:
  static DataCell cell(const std::string& words) { return words; }
  static DataCell cell(double number) {
    return std::isfinite(number) ? number : std::numeric_limits<double>::quiet_NaN();
  }
  static DataCell cell(const std::optional<double>& number) { return cell(number.value_or(HUGE_VAL)); }
  template <std::integral N>
  static DataCell cell(N number) {
    return static_cast<double>(number);
  }
  std::span<const T> rows_;
  std::shared_ptr<const std::vector<T>> owned_;
  DataTable table_;
  std::vector<std::function<DataCell(const T&)>> cells_;
};

// Of rows that live until the table is written; rows made for it are kept.
template <class T>
DataOf<T> data_of(std::string name, const std::vector<T>& rows) {
  return {std::move(name), std::span<const T>(rows), nullptr};
}
template <class T>
DataOf<T> data_of(std::string name, std::vector<T>&& rows) {
  auto kept = std::make_shared<const std::vector<T>>(std::move(rows));
  const std::span<const T> view(*kept);
  return {std::move(name), view, std::move(kept)};
}

}  // namespace kurbel
