// table_files.h — a study's tables in the formats asked for.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "studies/findings/output.h"

namespace kurbel {

struct TableFormats {
  bool csv = true, mat = false, xlsx = false;
};

// "csv,mat,xlsx". Throws std::invalid_argument for anything else.
TableFormats table_formats(std::string_view list);

// A file a table, as CSV and as MAT, and one workbook, results.xlsx, of figures, events and all tables. A table that no
// MAT file holds (2 GB) is handed out as CSV in its place; what is no table, as it is.
void make_table_files(const StudyOutput& output, const TableFormats& formats,
                      const std::function<void(const std::string& name, const std::string& bytes)>& take);

}  // namespace kurbel
