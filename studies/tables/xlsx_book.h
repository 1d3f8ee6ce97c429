// xlsx_book.h — a workbook of sheets, row after row, however many there are; numbers to the last bit.
//
//   XlsxBook book("v.xlsx");
//   XlsxSheet variants = book.sheet("variants");
//   variants.headings({"row", "inertia [kg*m2]"});
//   variants.row({1.0, 200.0});
//   book.close();
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <variant>
#include <vector>

struct lxw_workbook;
struct lxw_worksheet;
struct lxw_format;

namespace kurbel {

// Nothing, a number (what is not finite is an empty cell), words.
using XlsxCell = std::variant<std::monostate, double, std::string>;

class XlsxSheet {
 public:
  static constexpr std::size_t most_rows = 1'048'576;  // the heading among them

  // The first row; it stays in view, and so do the leading columns.
  void headings(const std::vector<std::string>& texts, std::size_t leading_columns = 1);
  void row(const std::vector<XlsxCell>& cells);

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
  void close();  // throws std::runtime_error where it could not be written

 private:
  std::string file_;
  lxw_workbook* book_;
  lxw_format* bold_;
  std::set<std::string> names_;
  std::vector<lxw_worksheet*> sheets_;
};

}  // namespace kurbel
