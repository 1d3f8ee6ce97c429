// table.h — a table of a sheet: a column a quantity, a row a position; as many digits as its largest value has use for.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/sheet/paper.h"

namespace kurbel {

struct SheetColumn {
  std::string symbol, unit;  // "x_B′", "m/rad"
  std::vector<double> values;
  int digits = 5;  // of the largest; what is not finite is a dash
};

struct SheetTable {
  std::string title;
  std::vector<std::string> labels;  // of the rows: "0", "a⁻"
  std::vector<SheetColumn> columns;
  std::vector<bool> stressed = {};  // rows of the load's edges; none, or one each
  std::string note = {};
};

// Puts it on sheets of its own, as many as it takes.
void add_table(Sheets& sheets, const SheetTable& table);

// What the cells of a column say, in its unit times 10ⁿ with n = exponent.
struct ColumnTexts {
  int exponent = 0;
  std::vector<std::string> cells;
};
ColumnTexts texts_of(const SheetColumn& column);

}  // namespace kurbel
