// table.h — a table of a sheet: one column per quantity, one row per position; digits according to its largest value.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/numerics/angles.h"
#include "studies/sheet/paper.h"
#include "studies/sheet/positions.h"

namespace kurbel {

struct SheetColumn {
  std::string symbol, unit;  // "x_B′", "m/rad"
  std::vector<double> values;
  int digits = 5;  // of the largest; values that are not finite are a dash
};

struct SheetTable {
  std::string title;
  std::vector<std::string> labels = {};  // of the rows: "0", "a⁻"
  std::vector<SheetColumn> columns = {};
  std::vector<bool> stressed = {};  // rows of the load's edges; none, or one each
  std::string note = {};
};

// A table whose rows are positions, with the column of their angles.
template <class Values>
class TableOfPositions {
 public:
  using Row = SheetRow<Values>;
  TableOfPositions(const std::string& title, std::vector<Row> rows) : table{.title = title}, rows_(std::move(rows)) {
    for (const Row& row : rows_) {
      table.labels.push_back(row.label);
      table.stressed.push_back(!row.position->numbered || row.position->greatest);
    }
    add("φ", "°", [](const Row& row) { return row.position->phi * in_degrees; });
  }
  // Of a row or of its values. Values that are rounding dust beside `scale` are zeros.
  template <class Get>
  void add(const std::string& symbol, const std::string& unit, const Get& get, double scale = 0) {
    SheetColumn& column = table.columns.emplace_back(SheetColumn{symbol, unit, {}});
    for (const Row& row : rows_) {
      double v = 0;
      if constexpr (std::is_invocable_v<Get, const Row&>)
        v = get(row);
      else
        v = std::invoke(get, *row.values);
      column.values.push_back(std::abs(v) < 1e-12 * scale ? 0 : v);
    }
  }
  SheetTable table;

 private:
  std::vector<Row> rows_;
};

// Puts the table on its own sheets, as many as necessary.
void add_table(Sheets& sheets, const SheetTable& table);

// Cell texts of a column, in its unit times 10ⁿ with n = exponent.
struct ColumnTexts {
  int exponent = 0;
  std::vector<std::string> cells;
};
ColumnTexts texts_of(const SheetColumn& column);

}  // namespace kurbel
