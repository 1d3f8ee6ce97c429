// xlsx_book.h — a workbook of sheets, row after row, however many there are; numbers to the last bit.
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
  static constexpr std::size_t most_rows = 1'048'576;  // the heading among them

  // The first row; it stays in view, and so do the leading columns.
  void headings(const std::vector<std::string>& texts, std::size_t leading_columns = 1);
  // Numbers that are not known, and no words, are empty cells.
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
  ~XlsxBook();  // without close(): as it has come
  XlsxBook(const XlsxBook&) = delete;
  XlsxBook& operator=(const XlsxBook&) = delete;

  // Of a name that the format allows: at most 31 letters, none twice.
  XlsxSheet sheet(const std::string& name);
  // A table, on as many sheets as its rows need.
  void add(const std::string& name, const DataTable& table);
  void close();  // throws std::runtime_error where it could not be written

 private:
  std::string file_;
  lxw_workbook* book_;
  lxw_format* bold_;
  std::set<std::string> names_;
  std::vector<lxw_worksheet*> sheets_;
};

}  // namespace kurbel
