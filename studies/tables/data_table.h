// data_table.h — a table of a study as data, for files that are no text.
//
// A study hands its tables out as CSV. The other formats are made of it, so that a table has the same rows and, to the
// last bit, the same numbers whichever it is read from.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace kurbel {

struct DataColumn {
  std::string name, unit = {};          // "torque.main_coupling", "N*m"; no unit: a plain number, or words
  std::vector<double> numbers = {};     // a row each; NaN: nothing is known there
  std::vector<std::string> words = {};  // of a column that holds others than numbers; else none
  bool is_words() const { return !words.empty(); }
};

struct DataTable {
  std::string name;    // "trajectory"
  std::string remark;  // to be read before it: "incomplete: stopped at t = 1 s"; empty: nothing
  std::vector<DataColumn> columns;
  std::size_t rows() const;
  // Columns of numbers alone; the first is what the others are over.
  std::vector<const DataColumn*> numbers() const;
};

// Of "trajectory.csv" and what it holds. Throws std::logic_error for a text that no study writes.
DataTable data_table(const std::string& file, std::string_view csv);

}  // namespace kurbel
