// xlsx.cpp — a sweep as a spread sheet.
#include <fmt/format.h>
#include <xlsxwriter.h>

#include <cmath>
#include <stdexcept>

#include "studies/files/whole_file.h"
#include "studies/sweep/sweep_findings.h"

namespace kurbel {
namespace {

class Sheet {
 public:
  Sheet(lxw_workbook* book, const char* name) : sheet_(workbook_add_worksheet(book, name)) {}
  void put(std::size_t row, std::size_t column, const std::string& text) {
    worksheet_write_string(sheet_, static_cast<lxw_row_t>(row), static_cast<lxw_col_t>(column), text.c_str(), nullptr);
  }
  void put(std::size_t row, std::size_t column, double value) {
    if (std::isfinite(value))
      worksheet_write_number(sheet_, static_cast<lxw_row_t>(row), static_cast<lxw_col_t>(column), value, nullptr);
  }

 private:
  lxw_worksheet* sheet_;
};

std::string with_unit_in_brackets(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

void fill_variants(Sheet& sheet, const SweepStudyResult& s) {
  std::size_t column = 0;
  for (const char* heading : {"row", "state", "seconds"}) sheet.put(0, column++, std::string(heading));
  for (const SweptParameter& p : s.identity.parameters) sheet.put(0, column++, with_unit_in_brackets(p.path, p.unit));
  for (const SweptFigure& f : s.identity.figures) {
    sheet.put(0, column++, with_unit_in_brackets(f.name, f.unit));
    sheet.put(0, column++, "error of " + f.name);
  }
  sheet.put(0, column, std::string("diagnosis"));
  std::size_t at = 0;
  s.each_row([&](const SweepRow& r) {
    ++at;
    sheet.put(at, 0, static_cast<double>(r.row));
    sheet.put(at, 1, name_of(r.state));
    sheet.put(at, 2, r.seconds);
    column = 3;
    for (std::size_t k = 0; k < r.parameters.size(); ++k, ++column) {
      const SweptParameter& p = s.identity.parameters[k];
      if (p.words.empty())
        sheet.put(at, column, r.parameters[k]);
      else
        sheet.put(at, column, p.text_of(r.parameters[k]));
    }
    for (const RowFigure& f : r.figures) {
      sheet.put(at, column + 2 * f.figure, f.value);
      if (f.error) sheet.put(at, column + 2 * f.figure + 1, *f.error);
    }
    if (!r.diagnosis.empty()) sheet.put(at, column + 2 * s.identity.figures.size(), r.diagnosis);
  });
}

}  // namespace

void write_xlsx(const SweepStudyResult& s, const std::string& file) {
  if (const std::string why = why_no_file_at(file); !why.empty())
    throw std::invalid_argument(fmt::format("--xlsx: {}", why));
  if (s.tally.rows >= LXW_ROW_MAX)
    throw std::invalid_argument(
        fmt::format("--xlsx {}: a sheet holds {} rows, the sweep has {}; take variants.csv or the database", file,
                    LXW_ROW_MAX - 1, s.tally.rows));
  // A row is written when the next one begins: row after row, however many there are.
  lxw_workbook_options options{.constant_memory = LXW_TRUE, .tmpdir = nullptr, .use_zip64 = LXW_TRUE};
  lxw_workbook* const book = workbook_new_opt(file.c_str(), &options);
  Sheet variants(book, "variants"), asked(book, "sweep");
  fill_variants(variants, s);
  std::size_t row = 0;
  for (const auto& [key, value] : s.identity.meta) {
    constexpr std::size_t longest_cell = 32'000;
    asked.put(row, 0, key);
    asked.put(row++, 1, value.substr(0, longest_cell));
  }
  if (const lxw_error error = workbook_close(book); error != LXW_NO_ERROR)
    throw std::runtime_error(fmt::format("cannot write {}: {}", file, lxw_strerror(error)));
}

}  // namespace kurbel
