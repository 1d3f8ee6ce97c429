// data_table.h — a long table as data: what its columns hold, and its rows, made one after another as they are written.
// CSV, MAT and XLSX are renderings of it. Nobody holds all rows: a trajectory may have millions.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace kurbel {

// How a number is written, in each file alike.
struct NumberFormat {
  int digits = 0;            // significant ones; 0: as many as give the same double again
  bool after_point = false;  // digits are those behind the point
};

struct DataColumn {
  std::string name;                      // "torque.main_coupling"
  std::optional<std::string> unit = {};  // "N*m"; empty: a plain number; none: words, or one without brackets
  NumberFormat format = {};
  bool words = false;  // not numbers
};

using DataCell = std::variant<double, std::string>;  // NaN: nothing is known there
using DataRow = std::span<const DataCell>;           // a cell a column

struct DataTable {
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
struct NamedTable {
  std::string name;  // "trajectory"
  std::function<DataTable()> table;
};

}  // namespace kurbel
