// sheet_options.h — options that reduce and forces share: the classical printed sheet of positions, the range of a rocking crank.
#pragma once

#include <optional>
#include <string>

#include "studies/question/question.h"
#include "studies/sheet/paper.h"

namespace kurbel {

struct SheetRequest {
  bool wanted = false;
  std::string paper;  // "A4", "A3"; empty: A4

  // Throws std::invalid_argument for an unknown paper, and for a paper without a sheet.
  std::optional<Paper> sheet() const;
};

const OptionsOf<SheetRequest>& sheet_options();

// --range: part of the arc of a crank that rocks [rad].
OptionText arc_range();
template <class Request>
void take_arc_range(Request& asked, const OptionValues& given) {
  const auto [from, to] = given.range();
  asked.range = {from, to};
}

}  // namespace kurbel
