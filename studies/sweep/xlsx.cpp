// xlsx.cpp — a sweep as a spreadsheet.
#include <fmt/format.h>

#include <stdexcept>

#include "studies/files/whole_file.h"
#include "studies/sweep/sweep_findings.h"
#include "studies/tables/xlsx_book.h"

namespace kurbel {
void check_xlsx(const std::string& file, std::size_t rows) {
  if (const std::string why = why_no_file_at(file); !why.empty())
    throw std::invalid_argument(fmt::format("--xlsx: {}", why));
  if (rows >= XlsxSheet::most_rows)
    throw std::invalid_argument(
        fmt::format("--xlsx {}: a sheet holds {} rows, the sweep has {}; take variants.csv or the database", file,
                    XlsxSheet::most_rows - 1, rows));
}

void write_xlsx(const SweepStudyResult& s, const std::string& file) {
  check_xlsx(file, s.tally.rows);
  XlsxBook book(file);
  DataTable variants = variants_data(s, 0, SweepStore::all, true);
  for (DataColumn& column : variants.columns) column.format = {};  // to the last bit
  book.add("variants", variants);
  XlsxSheet asked = book.sheet("sweep");
  asked.headings({"what", "as it was asked"});
  for (const auto& [key, value] : s.identity.meta) asked.row({key, value});
  book.close();
}

}  // namespace kurbel
