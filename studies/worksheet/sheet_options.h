// sheet_options.h — options of the classical printed sheet of positions.
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

}  // namespace kurbel
