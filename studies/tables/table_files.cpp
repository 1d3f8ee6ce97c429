// table_files.cpp — each table is written row by row into every format.
#include "studies/tables/table_files.h"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "engine/scene/messages.h"
#include "studies/files/memory_file.h"
#include "studies/tables/mat_file.h"
#include "studies/tables/summary_tables.h"
#include "studies/tables/xlsx_book.h"

namespace kurbel {
namespace {

// Figures of the model that a table is of: "trajectory.rigid" is of "rigid"; what belongs to no model, to every table.
std::vector<MatConstant> constants_of(const SummaryTables& summary, const std::string& table) {
  std::vector<MatConstant> constants;
  for (const FigureRow& f : summary.figures)
    if (f.of.empty() || table.find('.') == std::string::npos || table.ends_with("." + f.of))
      constants.push_back({f.name, f.unit, f.meaning, f.value});
  return constants;
}

XlsxCell cell(const std::optional<double>& number) { return number ? XlsxCell(*number) : XlsxCell(); }

void add_figures(XlsxBook& book, const std::vector<FigureRow>& figures) {
  if (figures.empty()) return;
  XlsxSheet sheet = book.sheet("figures");
  sheet.headings({"figure", "value", "unit", "error", "at [s]", "model", "meaning"});
  for (const FigureRow& f : figures) sheet.row({f.name, f.value, f.unit, cell(f.error), cell(f.at), f.of, f.meaning});
}

void add_events(XlsxBook& book, const std::vector<EventRow>& events) {
  if (events.empty()) return;
  XlsxSheet sheet = book.sheet("events");
  sheet.headings({"time [s]", "component", "from", "to", "model"});
  for (const EventRow& e : events) sheet.row({e.time, e.component, e.from, e.what, e.of});
}

std::vector<std::string> headings_of(const DataTable& table) {
  std::vector<std::string> headings;
  for (const DataColumn& column : table.columns)
    headings.push_back(column.unit && column.unit->empty() ? column.name : heading_of(column.name, column.unit));
  return headings;
}

XlsxCell cell(const DataCell& of, const NumberFormat& format) {
  const double* const number = std::get_if<double>(&of);
  return number ? XlsxCell(as_written(*number, format)) : XlsxCell(std::get<std::string>(of));
}

// As many sheets as its rows need.
void add_table(XlsxBook& book, const DataTable& table) {
  std::vector<XlsxCell> cells(table.columns.size());
  const auto begin_sheet = [&] {
    XlsxSheet sheet = book.sheet(table.name);
    sheet.headings(headings_of(table));
    return sheet;
  };
  XlsxSheet sheet = begin_sheet();
  std::size_t rows = 1;
  table.each_row([&](DataRow row) {
    if (rows == XlsxSheet::most_rows) sheet = begin_sheet(), rows = 1;
    for (std::size_t k = 0; k < cells.size(); ++k) cells[k] = cell(row[k], table.columns[k].format);
    sheet.row(cells);
    ++rows;
  });
}

}  // namespace

TableFormats table_formats(std::string_view list) {
  TableFormats formats{.csv = false};
  while (true) {
    const std::size_t comma = list.find(',');
    const std::string_view name = list.substr(0, comma);
    if (name == "csv")
      formats.csv = true;
    else if (name == "mat")
      formats.mat = true;
    else if (name == "xlsx")
      formats.xlsx = true;
    else
      throw std::invalid_argument(
          fmt::format("{} is no format of tables; allowed: csv, mat, xlsx, joined by commas", in_quotes(name)));
    if (comma == std::string_view::npos) return formats;
    list.remove_prefix(comma + 1);
  }
}

void make_table_files(const StudyOutput& output, const TableFormats& formats,
                      const std::function<void(const std::string& name, const std::string& bytes)>& take) {
  const SummaryTables summary = formats.mat || formats.xlsx ? summary_tables(output.summary) : SummaryTables{};
  const MemoryFile memory;
  std::optional<XlsxBook> book;
  if (formats.xlsx) {
    book.emplace(memory.path());
    add_figures(*book, summary.figures);
    add_events(*book, summary.events);
  }
  for (const TableFile& file : output.tables) {
    const DataTable table = file.table();
    if (formats.csv) take(table.name + ".csv", csv_text(table));
    if (book) add_table(*book, table);
    if (!formats.mat) continue;
    if (const auto mat = mat_file(table, constants_of(summary, table.name)))
      take(table.name + ".mat", *mat);
    else if (!formats.csv)
      take(table.name + ".csv", csv_text(table));
  }
  for (const auto& [name, text] : output.files) take(name, text);
  if (!book) return;
  book->close();
  take("results.xlsx", memory.bytes());
}

}  // namespace kurbel
