// records.h — measured variants as lines of text: a campaign is cut into pieces, and its pieces are judged together.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tests/coverage/measure.h"

namespace kurbel::coverage {

// "run,…" once, then "figure,…" for each figure; comma-separated, beginning with scene and seed.
std::string lines_of(const MeasuredVariant& variant);
// What the columns are, as the first lines of a file.
std::string column_lines();
// Reads lines back; lines that begin with # are skipped. Throws std::runtime_error with the number of a bad line.
std::vector<MeasuredVariant> read_lines(std::istream& in);

}  // namespace kurbel::coverage
