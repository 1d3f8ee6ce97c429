// csv.h — two columns of a CSV file, with a message for every bad cell.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/messages.h"

namespace kurbel {

struct Columns {
  std::vector<double> x, y;
  std::vector<int> line;  // of each row in the file
};

// Reads columns `x_column` and `y_column` (1-based); blank lines, lines beginning with # and one header line (a first
// line with words in both columns) are skipped. A line with a semicolon is separated by semicolons, else by tabs if it
// has any, else by commas; decimals are written with a point. Bad cells go into `messages` with file and line.
Columns read_csv(const std::string& path, int x_column, int y_column, Messages& messages);

inline constexpr std::size_t max_csv_bytes = 64'000'000;

}  // namespace kurbel
