// text_table.h — tables for a terminal.
#pragma once

#include <string>
#include <vector>

namespace kurbel {

// Rows aligned in columns: the first `text_columns` and the last one on the left, the others on the right. UTF-8 safe.
std::string aligned(const std::vector<std::vector<std::string>>& rows, std::size_t text_columns);

}  // namespace kurbel
