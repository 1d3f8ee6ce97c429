// xlsx_book.h — a workbook of sheets, written row by row, of any length; numbers exact to the last bit.
//
//   XlsxBook book("v.xlsx");
//   book.add("variants", variants_data(study));
//   XlsxSheet asked = book.sheet("sweep");
//   asked.headings({"what", "as it was asked"});
//   asked.row({"seed", 1.0});
//   book.close();
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "studies/data/data_table.h"

struct lxw_workbook;
struct lxw_worksheet;
struct lxw_format;

namespace kurbel {

class XlsxSheet {
 public:
  static constexpr std::size_t most_rows = 1'048'576;  // including the heading

  // The first row; it stays visible, like the leading columns.
  void headings(const std::vector<std::string>& texts, std::size_t leading_columns = 1);
  // Unknown numbers and empty words are empty cells.
  void row(const std::vector<DataCell>& cells);

 private:
  friend class XlsxBook;
  XlsxSheet(lxw_worksheet* sheet, lxw_format* bold) : sheet_(sheet), bold_(bold) {}
  lxw_worksheet* sheet_;
  lxw_format* bold_;
  std::size_t rows_ = 0;
  std::string text_;
};

class XlsxBook {
 public:
  explicit XlsxBook(const std::string& file);
  ~XlsxBook();  // without close() no file is written
  XlsxBook(const XlsxBook&) = delete;
  XlsxBook& operator=(const XlsxBook&) = delete;

  // The name must conform to the format: at most 31 letters, unique.
  XlsxSheet sheet(const std::string& name);
  // A table, on as many sheets as its rows require.
  void add(const std::string& name, const DataTable& table);
  void close();  // throws std::runtime_error if it could not be written

 private:
  std::string file_;
  lxw_workbook* book_;
  lxw_format* bold_;
  std::set<std::string> names_;
  std::vector<lxw_worksheet*> sheets_;
};

}  // namespace kurbel
