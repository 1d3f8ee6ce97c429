// formula_reader.h — the text of a formula: its grammar, its names, and the dimension of every part of it.
//
//     sum      product { (+ | −) product }
//     product  sign { (* | /) sign }
//     sign     [-] power
//     power    operand [ ^ sign ]                          2^3^2 = 2^9, -x^2 = -(x^2)
//     operand  number [unit] | name | name(sum, …) | (sum)
//     unit     one symbol: 5 mm, 2 kN; others in brackets: 4 [kN*m/rad]
//
// Functions: sin cos tan asin acos atan tanh exp log log10 sqrt abs min max clamp hypot atan2 sign step, and
// if(a < b, c, d) with < <= > >=; sign and step are 1 from 0 on. Constant: pi. Nothing else is there: a text cannot run
// anything, its length and depth are bounded.
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

// What a formula may speak of.
struct FormulaNames {
  std::vector<std::string> variable = {};  // its names; none: a constant is asked for
  Dimension variable_dimension = {};
  std::map<std::string, Quantity> constants = {};
};

struct ReadFormula {
  Formula formula;
  BrokenDimension dimension{};
  bool zero = false;  // just 0, of any dimension
};

// Errors have their column in the text, from 0.
std::optional<ReadFormula> read_formula(std::string_view text, const FormulaNames& names, UnitError& error);

// A name that a constant may have; else why not.
std::string wrong_constant_name(const std::string& name);

}  // namespace kurbel
