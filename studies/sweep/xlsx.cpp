// xlsx.cpp — a sweep as a spread sheet.
#include <fmt/format.h>

#include <stdexcept>

#include "studies/files/whole_file.h"
#include "studies/sweep/sweep_findings.h"
#include "studies/tables/xlsx_book.h"

namespace kurbel {
namespace {

std::string with_unit_in_brackets(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

std::vector<std::string> headings_of(const SweepStudyResult& s) {
  std::vector<std::string> headings = {"row", "state", "seconds"};
  for (const SweptParameter& p : s.identity.parameters) headings.push_back(with_unit_in_brackets(p.path, p.unit));
  for (const SweptFigure& f : s.identity.figures) {
    headings.push_back(with_unit_in_brackets(f.name, f.unit));
    headings.push_back("error of " + f.name);
  }
  headings.emplace_back("diagnosis");
  return headings;
}

void fill_variants(XlsxSheet sheet, const SweepStudyResult& s) {
  const std::vector<std::string> headings = headings_of(s);
  sheet.headings(headings);
  const std::size_t figures = 3 + s.identity.parameters.size();
  s.each_row([&](const SweepRow& r) {
    std::vector<XlsxCell> cells(headings.size());
    cells[0] = static_cast<double>(r.row), cells[1] = std::string(name_of(r.state)), cells[2] = r.seconds;
    for (std::size_t k = 0; k < r.parameters.size(); ++k) {
      const SweptParameter& p = s.identity.parameters[k];
      cells[3 + k] = p.words.empty() ? XlsxCell(r.parameters[k]) : XlsxCell(p.text_of(r.parameters[k]));
    }
    for (const RowFigure& f : r.figures) {
      cells[figures + 2 * f.figure] = f.value;
      if (f.error) cells[figures + 2 * f.figure + 1] = *f.error;
    }
    cells.back() = r.diagnosis;
    sheet.row(cells);
  });
}

}  // namespace

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
  fill_variants(book.sheet("variants"), s);
  XlsxSheet asked = book.sheet("sweep");
  asked.headings({"what", "as it was asked"});
  for (const auto& [key, value] : s.identity.meta) asked.row({key, value});
  book.close();
}

}  // namespace kurbel
