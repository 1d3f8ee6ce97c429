// sheet_options.cpp — whether a sheet is requested, and on which paper; over which angles a rocking crank is examined.
#include "studies/worksheet/sheet_options.h"

#include <fmt/format.h>

#include <stdexcept>

namespace kurbel {

std::optional<Paper> SheetRequest::sheet() const {
  if (wanted) return paper_named(paper.empty() ? "A4" : paper);
  if (!paper.empty()) throw std::invalid_argument(fmt::format("--paper {}: is that of the sheet; add --sheet", paper));
  return {};
}

const OptionsOf<SheetRequest>& sheet_options() {
  static const auto made =
      OptionsOf<SheetRequest>()
          .add({.name = "sheet",
                .doc = "write the classical sheet of the positions too, sheet.html: plan, tables and diagrams with "
                       "their scales, to be printed",
                .makes_a_file = true},
               &SheetRequest::wanted)
          .add({.name = "paper", .doc = "of the sheet, landscape: A4 (default) or A3"}, &SheetRequest::paper);
  return made;
}

OptionText arc_range() {
  return {
      .name = "range",
      .doc =
          "two angles, for a crank that rocks: over that part of its arc (default: 95 % of it), e.g. \"-45..45 deg\"",
      .example = "45 deg",
      .what = "two angles, the lesser first, e.g. \"-45..45 deg\"",
      .count = 2};
}

}  // namespace kurbel
