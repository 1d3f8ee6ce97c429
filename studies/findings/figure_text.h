// figure_text.h — a figure in readable form, the same in terminal, report and README; rounded by studies/claims/rounding.h.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/estimate.h"
#include "engine/scene/speed_unit.h"
#include "studies/claims/rounding.h"

namespace kurbel {

// A figure on a tile: rounded as in a headline; `known` shows its further digits, if any.
struct TileText {
  std::string value, known, error;  // "6257", "6257.17", ""
};
TileText tile_text(const Estimate& estimate, int digits = 0);  // digits: 0: by the error

// "6082.2 ± 0.6 N·m"; "6257.17 N·m" if the error is less than half a unit of the last digit, or unknown; if it
// exceeds the value, the upper bound: "less than 15 s".
std::string with_error(const Estimate& estimate, std::string_view unit, int most_digits = digits_in_tables);

// For sentences: four digits in a readable unit: 19092.63 N·m → "19.09 kN·m"; a speed in its unit.
std::string short_text(double value, const std::string& si_unit, const SpeedUnit& speed = {});

// A figure in a row of a table: a speed in the scene's unit, all else in SI.
struct FigureCells {
  std::string value, error, unit;  // "6257.17", "± 0.00006", "N·m"
};
FigureCells figure_cells(const Estimate& estimate, const std::string& si_unit, const SpeedUnit& speed,
                         int most_digits = digits_in_tables);

// A figure of which no error is known: what is 1e-12 of its scale is rounding, 0.
Estimate without_rounding(Estimate value, double scale);

// "12.3 ms", "1.7 s": processor time, in three digits.
std::string duration_text(double seconds);

// Text in a column of errors if none was measured.
std::string error_cell(const Estimate& estimate);

// A table for a terminal: aligned columns, the first `text_columns` and the last one on the left, the others on the
// right. UTF-8 safe.
std::string aligned(const std::vector<std::vector<std::string>>& rows, std::size_t text_columns);

}  // namespace kurbel
