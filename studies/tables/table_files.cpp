// table_files.cpp — each table is written row by row into every format.
#include "studies/tables/table_files.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "engine/scene/messages.h"
#include "studies/files/whole_file.h"
#include "studies/tables/mat_file.h"
#include "studies/tables/summary_tables.h"
#include "studies/tables/xlsx_book.h"

namespace kurbel {
namespace {

// Figures of the model of a table: "trajectory.rigid" belongs to "rigid"; those without a model to every table.
std::vector<MatConstant> constants_of(const SummaryTables& summary, const std::string& table) {
  std::vector<MatConstant> constants;
  for (const FigureRow& f : summary.figures)
    if (f.of.empty() || table.find('.') == std::string::npos || table.ends_with("." + f.of))
      constants.push_back({f.name, f.unit, f.meaning, f.value});
  return constants;
}

void add_figures(XlsxBook& book, const std::vector<FigureRow>& figures) {
  if (figures.empty()) return;
  XlsxSheet sheet = book.sheet("figures");
  sheet.headings({"figure", "value", "unit", "error", "at [s]", "model", "meaning"});
  for (const FigureRow& f : figures)
    sheet.row({f.name, f.value, f.unit, f.error.value_or(NAN), f.at.value_or(NAN), f.of, f.meaning});
}

void add_events(XlsxBook& book, const std::vector<EventRow>& events) {
  if (events.empty()) return;
  XlsxSheet sheet = book.sheet("events");
  sheet.headings({"time [s]", "component", "from", "to", "model"});
  for (const EventRow& e : events) sheet.row({e.time, e.component, e.from, e.what, e.of});
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
  const SummaryTables summary = formats.mat || formats.xlsx ? summary_tables(summary_of(output)) : SummaryTables{};
  const MemoryFile memory;
  std::optional<XlsxBook> book;
  if (formats.xlsx) {
    book.emplace(memory.path());
    add_figures(*book, summary.figures);
    add_events(*book, summary.events);
  }
  for (const auto& [name, made] : output.tables) {
    const DataTable table = made();
    if (book) book->add(name, table);
    const auto mat = formats.mat ? mat_file(table, constants_of(summary, name)) : std::nullopt;
    if (mat) take(name + ".mat", *mat);
    if (formats.csv || (formats.mat && !mat)) take(name + ".csv", csv_text(table));
  }
  for (const auto& [name, text] : output.files) take(name, text);
  if (!book) return;
  book->close();
  take("results.xlsx", memory.bytes());
}

}  // namespace kurbel
