// figure_text.h — a figure and its error as people read them: the one form of terminal, report and README.
//
//   6257.169983 ± 5.3e-5   →  "6257.16998" "± 0.00006"
//   0.104382 ± 0.0112      →  "0.104"      "± 0.012"
//
// The error is rounded up to one significant digit, to two where the first is a 1; what the rounding of the value does
// counts as error. The value ends at the same place. At most nine significant digits of a value are shown: the error
// shown is never less than what that leaves open. No error is known: six digits. An error of 0 stands for what is exact
// by construction.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/estimate.h"
#include "engine/scene/speed_unit.h"

namespace kurbel {

struct FigureText {
  std::string value;  // "6257.16998"; "—" if it is not finite
  std::string error;  // "± 0.00006"; "± 0": exact; empty: not known
};

FigureText figure_text(const Estimate& estimate);

// A figure on a tile: rounded as a headline rounds, and below it what is known where that is more.
struct TileText {
  std::string value, known, error;  // "6257", "6257.16998", "± 0.00006"
};
TileText tile_text(const Estimate& estimate, int digits = 0);  // digits: 0: by the error

// "6257.16998 ± 0.00006 N·m"; without an error "6257.17 N·m".
std::string with_error(const Estimate& estimate, std::string_view unit);

// As a sentence has it, four digits in a unit that is read easily: 19092.63 N·m → "19.09 kN·m"; a speed in its unit.
std::string told_shortly(double value, const std::string& si_unit, const SpeedUnit& speed = {});

// A figure in a row of a table: a speed in the scene's unit, all else in SI.
struct FigureCells {
  std::string value, error, unit;  // "6257.16998", "± 0.00006", "N·m"
};
FigureCells figure_cells(const Estimate& estimate, const std::string& si_unit, const SpeedUnit& speed);

// What a column of errors says where none was measured.
std::string error_cell(const Estimate& estimate);

// A table for a terminal: rows aligned in columns, the first `text_columns` and the last one on the left, the others on the
// right. UTF-8 safe.
std::string aligned(const std::vector<std::vector<std::string>>& rows, std::size_t text_columns);

}  // namespace kurbel
