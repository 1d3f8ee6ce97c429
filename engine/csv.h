// csv.h — two columns of a CSV file, with a message for every bad cell.
#pragma once

#include <string>
#include <vector>

#include "engine/messages.h"

namespace kurbel {

struct Columns {
  std::vector<double> x, y;
};

// Reads columns `x_column` and `y_column` (1-based); blank lines, lines beginning with # and one header line are
// skipped; cells are separated by comma, semicolon or tab. Bad cells go into `messages` with file and line.
Columns read_csv(const std::string& path, int x_column, int y_column, Messages& messages);

inline constexpr std::size_t max_csv_bytes = 64'000'000;

}  // namespace kurbel
