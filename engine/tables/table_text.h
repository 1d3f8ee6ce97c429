// table_text.h — the text of a table file in UTF-8, for all usual encodings.
#pragma once

#include <string>

namespace kurbel {

inline constexpr std::size_t max_table_bytes = 64'000'000;

struct TableText {
  std::string text;       // UTF-8, lines end with \n
  bool is_sheet = false;  // from a spreadsheet: one line per row, cells separated by tabs
};

// Reads UTF-8 and UTF-16 with or without byte order mark, else Latin-1; lines that end with \n, \r\n or \r; a sheet of an
// .xlsx file by its name, by default the first; the variables of a .mat file. Throws SceneError.
TableText read_table_text(const std::string& path, const std::string& sheet = {});

}  // namespace kurbel
