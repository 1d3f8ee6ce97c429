// spreadsheet.h — a sheet of an .xlsx file as text: one line per row, cells separated by tabs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kurbel {

// Whether a file begins like a zip archive, as .xlsx files do.
inline bool is_archive(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

// The sheet with this name, or the first; of what is no archive, a MAT file's variables. Values are those saved in the
// sheet. Parts of the archive and the resulting text are limited to `limit`, whatever sizes the archive declares. Throws
// SceneError for `path`.
std::string sheet_as_text(const std::string& bytes, const std::string& sheet, const std::string& path,
                          std::size_t limit);

// Of a workbook (.xlsx, .xlsm); none: another file.
std::vector<std::string> sheet_names(const std::string& path);

// "B7"
std::string cell_name(int row, int column);

}  // namespace kurbel
