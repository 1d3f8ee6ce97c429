// formula_reader.h — reads the text of a formula: its grammar, its names, and the dimensions of its parts.
//
//     sum      product { (+ | −) product }
//     product  sign { (* | /) sign }
//     sign     [-] power
//     power    operand [ ^ sign ]                          2^3^2 = 2^9, -x^2 = -(x^2)
//     operand  number [unit] | name | name(sum, …) | (sum)
//     unit     one symbol: 5 mm, 2 kN; others in brackets: 4 [kN*m/rad]
//
// Functions: sin cos tan asin acos atan tanh exp log log10 sqrt abs min max clamp hypot atan2 sign step, and
// if(a < b, c, d) with < <= > >=; sign and step are 1 for arguments ≥ 0. Constant: pi. There is nothing else: a text cannot
// execute anything, its length and depth are limited.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/numerics/formula.h"
#include "engine/scene/units.h"
#include "engine/values/broken_dimension.h"

namespace kurbel {

// The names allowed in a formula.
struct FormulaNames {
  std::vector<std::string> variable = {};  // its names; empty: the result must be constant
  Dimension variable_dimension = {};
  std::map<std::string, Quantity> constants = {};
};

struct ReadFormula {
  Formula formula;
  BrokenDimension dimension{};
  bool zero = false;  // plain 0, for any dimension
};

// Errors have their column in the text, from 0.
std::optional<ReadFormula> read_formula(std::string_view text, const FormulaNames& names, UnitError& error);

// Fault of the name of a constant; empty: it is allowed.
std::string wrong_constant_name(const std::string& name);

}  // namespace kurbel
