// paper.cpp — frame, title block, styles, and the page.
#include "studies/sheet/paper.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace kurbel {
namespace {

// Margins as on drawings: 20 mm to bind it by, 5 mm elsewhere.
constexpr double bound = 20, margin = 5, block_width = 150, block_height = 20;

constexpr const char* styles = R"(
body { margin: 0; background: #e8e8e8; font-family: Arial, "Liberation Sans", "DejaVu Sans", sans-serif; }
header { font-size: 14px; margin: 12px auto; max-width: 60em; padding: 0 12px; color: #222; }
main { display: flex; flex-direction: column; align-items: center; gap: 16px; padding: 0 8px 24px; }
svg { background: #fff; max-width: 100%; height: auto; box-shadow: 0 1px 6px #0005; }
line, path, rect { fill: none; stroke: #000; stroke-width: .25; stroke-linejoin: round; stroke-linecap: round; }
circle { stroke: #000; stroke-width: .25; }
text { fill: #000; }
.bold { font-weight: bold; }
.ground { paint-order: stroke; stroke: #fff; stroke-width: 1; stroke-linejoin: round; }
.paper { fill: #fff; }
.grid { stroke: #999; stroke-width: .1; }
.thin { stroke: #666; stroke-width: .18; }
.path { stroke: #0072b2; stroke-width: .18; stroke-dasharray: 2.4 .7 .4 .7; }
.dashed { stroke-width: .2; stroke-dasharray: 1.6 1; }
.letter { stroke: #c04a00; stroke-width: .13; stroke-dasharray: 1.2 .9; }
.edge { stroke: #c04a00; stroke-width: .22; }
.thick { stroke-width: .7; }
.drive { stroke: #007a58; stroke-width: .4; stroke-dasharray: 3 1; }
.load { stroke: #c04a00; stroke-width: .5; }
.main { stroke: #0060a0; stroke-width: .5; }
.accent { stroke: #a0307a; stroke-width: .35; }
.on-drive { fill: #007a58; } .on-load { fill: #c04a00; } .on-main { fill: #0060a0; } .on-accent { fill: #a0307a; }
.on-path { fill: #0060a0; stroke: none; } .on-thin, .on-grid { fill: #555; }
.full { fill: #000; stroke: none; } .full.drive { fill: #007a58; } .full.load { fill: #c04a00; }
.full.main { fill: #0060a0; } .full.accent { fill: #a0307a; }
.head { fill: #000; stroke: none; } .head.accent { fill: #a0307a; }
@media (prefers-color-scheme: dark) { @media screen { body { background: #1b1b1b; } header { color: #ddd; } } }
@media print {
  body { background: none; } header { display: none; } main { display: block; padding: 0; }
  svg { display: block; max-width: none; box-shadow: none; break-after: page; break-inside: avoid; }
  svg:last-child { break-after: auto; }
}
)";

}  // namespace

Paper paper_named(const std::string& name) {
  if (name == "A4") return {"A4", 297, 210};
  if (name == "A3") return {"A3", 420, 297};
  throw std::invalid_argument(fmt::format("--paper \"{}\": must be A4 or A3", name));
}

Canvas& Sheets::add(const std::string& what, const std::string& scales) {
  return sheets_.emplace_back(Sheet{what, scales, {}}).canvas;
}

Box Sheets::room() const {
  return {bound + 3, margin + 3, paper_.width - bound - margin - 6, paper_.height - 2 * margin - block_height - 6};
}

Box Sheets::foot() const {
  return {bound + 3, paper_.height - margin - block_height + 1, paper_.width - bound - margin - block_width - 6,
          block_height - 2};
}

void Sheets::draw_block(Canvas& c, const Sheet& sheet, std::size_t number) const {
  const double right = paper_.width - margin, bottom = paper_.height - margin;
  const double left = right - block_width, top = bottom - block_height, column = right - 34;
  c.box({bound, margin, paper_.width - bound - margin, paper_.height - 2 * margin}, Pen::thick);
  c.box({left, top, block_width, block_height}, Pen::thick);
  c.line({column, top}, {column, bottom}, Pen::body);
  for (const double y : {top + 7, top + 14}) c.line({left, y}, {right, y}, Pen::body);
  const auto fitted = [](const std::string& text, double width, double size) {
    return std::min(size, size * width / std::max(1.0, width_of(text, size)));
  };
  const double width = column - left - 4;
  c.words({left + 2, top + 5}, block_.title, {.size = fitted(block_.title, width, 3.6), .bold = true});
  c.words({left + 2, top + 11.8}, sheet.what, {.size = fitted(sheet.what, width, 3.4)});
  c.symbols({left + 2, top + 18.4}, sheet.scales, {.size = fitted(sheet.scales, width, 3)});
  const std::string by = block_.author.empty() ? block_.study : block_.author;
  c.words({column + 2, top + 5}, by, {.size = fitted(by, 30, 3)});
  c.words({column + 2, top + 11.8}, fmt::format("sheet {} of {}", number, sheets_.size()), {.size = 3});
  c.words({column + 2, top + 18.4}, paper_.name, {.size = 3});
}

std::string Sheets::html() const {
  std::string body;
  for (std::size_t i = 0; i < sheets_.size(); ++i) {
    const Sheet& sheet = sheets_[i];
    Canvas frame;
    draw_block(frame, sheet, i + 1);
    body += fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{}\" width=\"{}mm\" height=\"{}mm\" "
        "viewBox=\"0 0 {} {}\">\n{}{}</svg>\n",
        xml_text(sheet.what), paper_.width, paper_.height, paper_.width, paper_.height, frame.svg(),
        sheet.canvas.svg());
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>{0}</title>\n"
      "<style>\n@page {{ size: {1} landscape; margin: 0; }}{2}</style>\n</head>\n<body>\n"
      "<header>{0}: {3}. Print on {1}, landscape, at 100 % (not “fit to page”): then the scales are true.</header>\n"
      "<main>\n{4}</main>\n</body>\n</html>\n",
      xml_text(block_.title), paper_.name, styles, xml_text(block_.study), body);
}

}  // namespace kurbel
