// csv.h — two columns of a CSV file, with a message for every bad cell; its headings.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/messages.h"

namespace kurbel {

struct Columns {
  std::vector<double> x, y;
  std::vector<int> line, x_at;  // of each row in the file; where its x begins in that line, from 1
};

// Reads columns `x_column` and `y_column` (1-based); blank lines, lines beginning with # and one header line (a first
// line with words in both columns) are skipped. A line with a semicolon is separated by semicolons, else by tabs if it
// has any, else by commas; decimals are written with a point. Bad cells go into `messages` with file and line.
Columns read_csv(const std::string& path, int x_column, int y_column, Messages& messages);

// Cells of the first line that is neither blank nor begins with #.
struct CsvHeading {
  std::string text;
  int column = 0;  // from 1
  Location at;
};
std::vector<CsvHeading> read_headings(const std::string& path);

inline constexpr std::size_t max_csv_bytes = 64'000'000;

}  // namespace kurbel
