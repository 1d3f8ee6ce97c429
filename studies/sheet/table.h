// table.h — a table of a sheet: one column per quantity, one row per position; digits according to its largest value.
#pragma once

#include <string>
#include <vector>

#include "engine/numerics/angles.h"
#include "studies/sheet/paper.h"

namespace kurbel {

struct SheetColumn {
  std::string symbol, unit;  // "x_B′", "m/rad"
  std::vector<double> values;
  int digits = 5;  // of the largest; values that are not finite are a dash
};

struct SheetTable {
  std::string title;
  std::vector<std::string> labels;  // of the rows: "0", "a⁻"
  std::vector<SheetColumn> columns;
  std::vector<bool> stressed = {};  // rows of the load's edges; none, or one each
  std::string note = {};
};

// From rows of positions, with only the column of angles so far.
template <class Row>
SheetTable table_of_positions(const std::string& title, const std::vector<Row>& rows) {
  SheetTable table{.title = title, .labels = {}, .columns = {{"φ", "°", {}}}};
  for (const Row& row : rows) {
    table.labels.push_back(row.label);
    table.stressed.push_back(!row.position->numbered || row.position->greatest);
    table.columns.front().values.push_back(row.position->phi * in_degrees);
  }
  return table;
}

// Puts the table on its own sheets, as many as necessary.
void add_table(Sheets& sheets, const SheetTable& table);

// Cell texts of a column, in its unit times 10ⁿ with n = exponent.
struct ColumnTexts {
  int exponent = 0;
  std::vector<std::string> cells;
};
ColumnTexts texts_of(const SheetColumn& column);

}  // namespace kurbel
