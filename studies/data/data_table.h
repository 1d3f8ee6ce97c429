// data_table.h — a long table as data: its columns, and its rows generated one after another while they are written.
// CSV, MAT and XLSX are renderings of it. The rows are never all in memory: a trajectory may have millions.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace kurbel {

// Number format, the same in each file.
struct NumberFormat {
  int digits = 0;            // significant ones; 0: as many as reproduce the double exactly
  bool after_point = false;  // digits are those behind the point
};

struct DataColumn {
  std::string name;                      // "torque.main_coupling"
  std::optional<std::string> unit = {};  // "N*m"; empty: a plain number; none: heading without brackets
  NumberFormat format = {};
  bool words = false;  // not numbers
};

using DataCell = std::variant<double, std::string>;  // NaN: not known
using DataRow = std::span<const DataCell>;           // one cell per column

struct DataTable {
  std::string remark = {};  // printed before the table: "incomplete: stopped at t = 1 s"; empty: none
  std::vector<DataColumn> columns = {};
  std::function<void(const std::function<void(DataRow)>& take)> each_row = {};
};

// "torque.shaft [N*m]"
std::string heading_of(const std::string& name, const std::optional<std::string>& unit);

// The number that results from reading the text of a column: MAT and XLSX contain the same as CSV, to the last bit.
double as_written(double value, const NumberFormat& format);

// A line of headings, then one line per row; "# remark" before. An empty cell is an unknown number.
std::string csv_text(const DataTable& table);

// A table that is made only when it is written.
struct NamedTable {
  std::string name;  // "trajectory"
  std::function<DataTable()> table;
};

}  // namespace kurbel
