// table_text.h — a file's text in UTF-8, whatever wrote it.
#pragma once

#include <string>

namespace kurbel {

inline constexpr std::size_t max_table_bytes = 64'000'000;

struct TableText {
  std::string text;       // UTF-8, lines end with \n
  bool is_sheet = false;  // of a spreadsheet: a line a row, cells between tabs
};

// UTF-8 and UTF-16 with their marks or without, else Latin-1; lines that end with \n, \r\n or \r; a sheet of an .xlsx
// file by its name, default the first. Throws SceneError.
TableText read_table_text(const std::string& path, const std::string& sheet = {});

}  // namespace kurbel
