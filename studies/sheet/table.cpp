// table.cpp — columns as wide as their numbers, rows on as many sheets as they take.
#include "studies/sheet/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kurbel {
namespace {

constexpr double least_height = 4.9, greatest_height = 6.8, head_height = 12, letter_size = 2.9;

std::string power_of_ten(int exponent) {
  if (exponent == 0) return "";
  constexpr const char* raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char c : std::to_string(std::abs(exponent))) text += raised[c - '0'];
  return text + " ";
}

struct Layout {
  std::vector<ColumnTexts> texts;
  std::vector<double> left;  // of each column, and the right end
  double size = letter_size, row = least_height;
  double larger() const { return std::max(1.0, size / letter_size); }  // than on A4
  double head() const { return head_height * larger(); }
};

// Columns as wide as their widest cell; a table that is too wide is written smaller, on larger paper up to `larger`.
Layout laid_out(const SheetTable& t, const Box& room, double larger) {
  Layout l;
  std::vector<double> widths = {12};
  for (const SheetColumn& c : t.columns) {
    l.texts.push_back(texts_of(c));
    double width =
        std::max(width_of(c.symbol, letter_size), width_of(power_of_ten(l.texts.back().exponent) + c.unit, 2.5));
    for (const std::string& cell : l.texts.back().cells) width = std::max(width, width_of(cell, letter_size));
    widths.push_back(width + 3.4);
  }
  double sum = 0;
  for (const double w : widths) sum += w;
  const double factor = std::min(room.width / sum, 1.25 * larger);
  l.size = letter_size * std::min(larger, factor);
  l.left = {room.x};
  for (const double w : widths) l.left.push_back(l.left.back() + w * factor);
  return l;
}

void draw_head(Canvas& c, const SheetTable& t, const Layout& l, double top) {
  const auto middle = [&](std::size_t k) { return 0.5 * (l.left[k] + l.left[k + 1]); };
  const double symbols = top + 5 * l.larger(), units = top + 10 * l.larger();
  c.words({middle(0), symbols}, "№", {.size = l.size, .at = "middle", .bold = true});
  for (std::size_t k = 0; k < t.columns.size(); ++k) {
    c.symbols({middle(k + 1), symbols}, t.columns[k].symbol, {.size = l.size, .at = "middle", .bold = true});
    c.words({middle(k + 1), units}, power_of_ten(l.texts[k].exponent) + t.columns[k].unit,
            {.size = 2.5 * l.size / letter_size, .at = "middle"});
  }
}

void draw_rows(Canvas& c, const SheetTable& t, const Layout& l, double top, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) {
    const double y = top + l.row * static_cast<double>(i - from), line = y + 0.5 * l.row + 1.1 * l.larger();
    const bool stressed = i < t.stressed.size() && t.stressed[i];
    const Pen pen = stressed ? Pen::load : Pen::body;
    c.line({l.left.front(), y}, {l.left.back(), y}, Pen::grid);
    c.words({0.5 * (l.left[0] + l.left[1]), line}, t.labels[i],
            {.size = l.size, .at = "middle", .bold = true, .pen = pen});
    for (std::size_t k = 0; k < t.columns.size(); ++k)
      c.words({l.left[k + 2] - 1.5, line}, l.texts[k].cells[i], {.size = l.size, .at = "end", .pen = pen},
              fmt::format("data-row=\"{}\" data-column=\"{}\" data-value=\"{:.15g}\"", xml_text(t.labels[i]),
                          xml_text(t.columns[k].symbol), t.columns[k].values[i]));
  }
}

// After the point, in SI: for as many digits as the largest is to have; for three of small ones, too, if two more do.
int decimals_of(const SheetColumn& column, double largest, int order) {
  double least = largest;
  for (const double v : column.values)
    if (std::isfinite(v) && std::abs(v) > 1e-3 * largest) least = std::min(least, std::abs(v));
  const int usual = column.digits - 1 - order;
  if (!(largest > 0)) return 0;
  return std::clamp(2 - static_cast<int>(std::floor(std::log10(least))), usual, usual + 2);
}

}  // namespace

ColumnTexts texts_of(const SheetColumn& column) {
  double largest = 0;
  for (const double v : column.values)
    if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
  ColumnTexts texts;
  const int order = largest > 0 ? static_cast<int>(std::floor(std::log10(largest) + 1e-12)) : 0;
  if (order < -3 || order > 5) texts.exponent = 3 * static_cast<int>(std::floor(order / 3.0));
  const int decimals = std::max(0, decimals_of(column, largest, order) + texts.exponent);
  const double factor = std::pow(10, -texts.exponent), dust = 0.5 * std::pow(10, -decimals);
  for (const double v : column.values) {
    const double shown = v * factor;
    texts.cells.push_back(!std::isfinite(v)        ? "—"
                          : std::abs(shown) < dust ? "0"
                                                   : fmt::format("{:.{}f}", shown, decimals));
    if (texts.cells.back().starts_with('-')) texts.cells.back().replace(0, 1, "−");
  }
  return texts;
}

void add_table(Sheets& sheets, const SheetTable& table) {
  const Box room = sheets.room();
  // On larger paper larger letters, if all rows stay on one sheet.
  const double most = room.width / Sheets({}, {}).room().width, height = room.height - most * head_height - 10,
               row = height / static_cast<double>(table.labels.size());
  const auto fit = static_cast<std::size_t>(height / least_height);
  Layout layout = laid_out(table, room, std::clamp(row / least_height, 1.0, most));
  layout.row = std::clamp(row, least_height, greatest_height * layout.larger());
  for (std::size_t from = 0; from < table.labels.size(); from += fit) {
    const std::size_t to = std::min(table.labels.size(), from + fit);
    Canvas& c = sheets.add(table.title);
    const double top = room.y + 8, body = top + layout.head(),
                 bottom = body + layout.row * static_cast<double>(to - from);
    c.words({room.x, room.y + 4}, table.title + (from > 0 ? ", continued" : ""), {.size = 4, .bold = true});
    draw_head(c, table, layout, top);
    draw_rows(c, table, layout, body, from, to);
    for (const double y : {top, body, bottom}) c.line({layout.left.front(), y}, {layout.left.back(), y}, Pen::body);
    for (std::size_t k = 0; k < layout.left.size(); ++k)
      c.line({layout.left[k], top}, {layout.left[k], bottom},
             k < 2 || k + 1 == layout.left.size() ? Pen::body : Pen::grid);
    add_lines(c, sheets.foot(), table.note);
  }
}

}  // namespace kurbel
