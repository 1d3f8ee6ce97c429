// rounding.h — a figure and its numerical error in readable form: the one rule for sentences, tables and pages.
//
//   6257.169983 ± 5.3e-5   →  "6257.17"  "± 0.00006"
//   0.104382 ± 0.0112      →  "0.104"    "± 0.012"
//
// The error is rounded up to one significant digit, to two if the first is a 1. The value ends at the same digit, and
// its rounding counts as error, so that a value below a third of it is 0; or it ends before, at the requested digits,
// and the error is that of the computation alone. Unknown error: at most six digits. An error of 0 means exact by
// construction.
#pragma once

#include <string>

#include "engine/base/estimate.h"

namespace kurbel {

inline constexpr int digits_in_tables = 6, digits_in_long_forms = 9;

struct FigureText {
  std::string value;  // "6257.17"; "—" if it is not finite
  std::string error;  // "± 0.00006"; "± 0": exact; empty: not known
};

FigureText figure_text(const Estimate& estimate, int most_digits = digits_in_tables);

// More than half a unit of the value's last digit, which the printed value does not imply.
bool error_is_visible(const Estimate& estimate, const FigureText& text);

}  // namespace kurbel
