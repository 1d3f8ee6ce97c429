// table_files.h — a study's tables in the requested formats.
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

// One file per table, as CSV and as MAT, and one workbook, results.xlsx, of figures, events and all tables. A table
// too large for a MAT file (2 GB) is written as CSV instead; other files are passed on unchanged.
void make_table_files(const StudyOutput& output, const TableFormats& formats,
                      const std::function<void(const std::string& name, const std::string& bytes)>& take);

}  // namespace kurbel
