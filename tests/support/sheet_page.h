// sheet_page.h — contents of a printed sheet, read back from its page: cells of tables, marks of diagrams.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <string>
#include <vector>

namespace kurbel::test {

struct SheetCell {
  std::string row, column, text;
  double value = 0;
};
inline std::vector<SheetCell> cells_of(const std::string& html) {
  static const std::regex cell(R"re(data-row="([^"]*)" data-column="([^"]*)" data-value="([^"]*)">([^<]*)<)re");
  std::vector<SheetCell> list;
  for (std::sregex_iterator i(html.begin(), html.end(), cell), end; i != end; ++i)
    list.push_back({(*i)[1], (*i)[2], (*i)[4], std::stod((*i)[3])});
  return list;
}
// The first cell of this row and column.
inline double cell_at(const std::vector<SheetCell>& cells, const std::string& row, const std::string& column) {
  for (const SheetCell& c : cells)
    if (c.row == row && c.column == column) return c.value;
  ADD_FAILURE() << "no cell " << row << ", " << column;
  return std::nan("");
}

// A mark of a diagram with heights to scale.
struct SheetMark {
  std::string diagram, of, position;
  double per_mm = 0, zero = 0, x = 0, y = 0, value = 0;
};
inline std::vector<SheetMark> marks_of(const std::string& html) {
  static const std::regex mark(
      R"re(cx="([^"]*)" cy="([^"]*)" r="0.6" data-of="([^"]*)" data-position="([^"]*)" data-value="([^"]*)")re");
  std::vector<SheetMark> list;
  for (std::size_t at = html.find("<g data-diagram"); at != std::string::npos;
       at = html.find("<g data-diagram", at + 1)) {
    const std::string text = html.substr(at, html.find("</g>", at) - at);
    std::smatch head;
    static const std::regex heading(R"re(data-diagram="([^"]*)" data-per-mm="([^"]*)" data-zero="([^"]*)")re");
    if (!std::regex_search(text, head, heading)) continue;
    for (std::sregex_iterator i(text.begin(), text.end(), mark), end; i != end; ++i)
      list.push_back({head[1], (*i)[3], (*i)[4], std::stod(head[2]), std::stod(head[3]), std::stod((*i)[1]),
                      std::stod((*i)[2]), std::stod((*i)[5])});
  }
  return list;
}

}  // namespace kurbel::test
