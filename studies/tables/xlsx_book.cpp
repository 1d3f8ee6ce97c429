// xlsx_book.cpp — uses libxlsxwriter except for the rows: it prints numbers as %.16G, one digit fewer than a double
// may need (0.1 + 0.2 becomes 0.3). In constant-memory mode a sheet's stream is open, and rows are written there.
#include "studies/tables/xlsx_book.h"

#include <fmt/format.h>
#include <xlsxwriter.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "engine/scene/text.h"

namespace kurbel {
namespace {

constexpr std::size_t longest_name = 31, longest_text = 32'000;

// XML allows no control characters except white space.
void put_escaped(std::string& to, std::string_view text) {
  for (const char c : text) {
    if (c == '&')
      to += "&amp;";
    else if (c == '<')
      to += "&lt;";
    else if (c == '>')
      to += "&gt;";
    else
      to += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? ' ' : c;
  }
}

std::string column_letters(std::size_t column) {
  char letters[LXW_MAX_COL_NAME_LENGTH];
  lxw_col_to_name(letters, static_cast<lxw_col_t>(column), LXW_FALSE);
  return letters;
}

void put_cell(std::string& to, std::size_t row, std::size_t column, const DataCell& cell) {
  const auto place = [&] { return column_letters(column) + std::to_string(row); };
  if (const double* number = std::get_if<double>(&cell)) {
    if (std::isfinite(*number))
      fmt::format_to(std::back_inserter(to), "<c r=\"{}\"><v>{}</v></c>", place(), *number + 0.0);
  } else if (const std::string* text = &std::get<std::string>(cell); !text->empty()) {
    fmt::format_to(std::back_inserter(to), "<c r=\"{}\" t=\"inlineStr\"><is><t xml:space=\"preserve\">", place());
    put_escaped(to, cut_at_character(*text, longest_text));
    to += "</t></is></c>";
  }
}

// As wide as its text, within limits.
double width_of(const std::string& heading) { return std::clamp(static_cast<double>(heading.size()) + 2, 10.0, 40.0); }

std::string lawful(const std::string& name) {
  std::string lawful(cut_at_character(name, longest_name));
  for (char& c : lawful)
    if (std::string_view("[]:*?/\\'").find(c) != std::string_view::npos) c = '_';
  return lawful;
}

}  // namespace

void XlsxSheet::headings(const std::vector<std::string>& texts, std::size_t leading_columns) {
  for (std::size_t k = 0; k < texts.size(); ++k) {
    const auto column = static_cast<lxw_col_t>(k);
    worksheet_set_column(sheet_, column, column, width_of(texts[k]), nullptr);
    worksheet_write_string(sheet_, 0, column, std::string(cut_at_character(texts[k], longest_text)).c_str(), bold_);
  }
  worksheet_freeze_panes(sheet_, 1, static_cast<lxw_col_t>(leading_columns));
  lxw_worksheet_write_single_row(sheet_);
  rows_ = 1;
}

void XlsxSheet::row(const std::vector<DataCell>& cells) {
  text_.clear();
  fmt::format_to(std::back_inserter(text_), "<row r=\"{}\">", ++rows_);
  for (std::size_t k = 0; k < cells.size(); ++k) put_cell(text_, rows_, k, cells[k]);
  text_ += "</row>";
  std::fwrite(text_.data(), 1, text_.size(), sheet_->file);
  sheet_->dim_rowmin = sheet_->dim_colmin = 0;
  sheet_->dim_rowmax = static_cast<lxw_row_t>(rows_ - 1);
  sheet_->dim_colmax =
      static_cast<lxw_col_t>(std::max<std::size_t>(sheet_->dim_colmax, cells.empty() ? 0 : cells.size() - 1));
}

XlsxBook::XlsxBook(const std::string& file) : file_(file) {
  lxw_workbook_options options{.constant_memory = LXW_TRUE, .tmpdir = nullptr, .use_zip64 = LXW_TRUE};
  book_ = workbook_new_opt(file.c_str(), &options);
  if (!book_) throw std::runtime_error(fmt::format("cannot write {}: no memory for a workbook", file));
  bold_ = workbook_add_format(book_);
  format_set_bold(bold_);
}

XlsxBook::~XlsxBook() {
  if (book_) lxw_workbook_free(book_);
}

XlsxSheet XlsxBook::sheet(const std::string& name) {
  const auto folded = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
  };
  std::string own = lawful(name);
  for (int number = 2; !names_.insert(folded(own)).second; ++number) {
    const std::string ending = fmt::format(" {}", number);
    own = std::string(cut_at_character(lawful(name), longest_name - ending.size())) + ending;
  }
  lxw_worksheet* const sheet = workbook_add_worksheet(book_, own.c_str());
  if (!sheet) throw std::runtime_error(fmt::format("cannot write {}: no temporary file for a sheet", file_));
  sheets_.push_back(sheet);
  return {sheet, bold_};
}

void XlsxBook::add(const std::string& name, const DataTable& table) {
  std::vector<std::string> headings;
  for (const DataColumn& column : table.columns)
    headings.push_back(column.unit && column.unit->empty() ? column.name : heading_of(column.name, column.unit));
  const auto begin_sheet = [&] {
    XlsxSheet begun = sheet(name);
    begun.headings(headings);
    return begun;
  };
  XlsxSheet sheet = begin_sheet();
  std::vector<DataCell> cells;
  std::size_t rows = 1;
  table.each_row([&](DataRow row) {
    if (rows == XlsxSheet::most_rows) sheet = begin_sheet(), rows = 1;
    cells.assign(row.begin(), row.end());
    for (std::size_t k = 0; k < cells.size(); ++k)
      if (double* number = std::get_if<double>(&cells[k])) *number = as_written(*number, table.columns[k].format);
    sheet.row(cells);
    ++rows;
  });
}

void XlsxBook::close() {
  for (lxw_worksheet* sheet : sheets_)
    if (std::fflush(sheet->file) != 0 || std::ferror(sheet->file))
      throw std::runtime_error(fmt::format("cannot write {}: no room for a sheet's temporary file", file_));
  lxw_workbook* const book = std::exchange(book_, nullptr);
  if (const lxw_error error = workbook_close(book); error != LXW_NO_ERROR)
    throw std::runtime_error(fmt::format("cannot write {}: {}", file_, lxw_strerror(error)));
}

}  // namespace kurbel
