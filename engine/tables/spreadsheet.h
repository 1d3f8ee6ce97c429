// spreadsheet.h — a sheet of an .xlsx file as lines of text: a line a row, cells between tabs.
#pragma once

#include <string>
#include <string_view>

namespace kurbel {

// What a file begins with that is a zip archive, as .xlsx is.
inline bool is_archive(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

// The sheet of that name, or the first. Values are those that the sheet was saved with. No part of the archive and no
// text made of it is larger than `limit`, whatever its sizes say. Throws SceneError for `path`.
std::string sheet_as_text(const std::string& bytes, const std::string& sheet, const std::string& path,
                          std::size_t limit);

// "B7"
std::string cell_name(int row, int column);

}  // namespace kurbel
