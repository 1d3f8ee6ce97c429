// formula_builder.h — builds the nodes of a formula while it is read: folds constants, checks dimensions, composes
// functions from the operations of engine/numerics/formula.h.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/numerics/formula.h"
#include "engine/scene/units.h"
#include "engine/values/broken_dimension.h"

namespace kurbel {

// Base of the parser of formulas (formula_reader.cpp).
class FormulaBuilder {
 protected:
  FormulaBuilder(std::string_view text, UnitError& error) : text_(text), error_(error) {}

  struct Term {
    int node = -1;
    BrokenDimension dimension{};
    bool zero = false;  // the number 0 without a unit is compatible with every dimension
    std::size_t column = 0;
  };

  // --- faults: the first one is reported, and reading ends ---
  Term stop(std::string text, std::size_t column);

  // --- nodes; constant expressions are computed at once ---
  const Formula::Node& of(const Term& t) const { return made_[t.node]; }
  bool constant(const Term& t) const { return of(t).op == FormulaOp::number; }
  Term number(double value, const BrokenDimension& dimension, std::size_t column, bool may_be_zero = false);
  Term make(Formula::Node node, const BrokenDimension& dimension);
  Term one(FormulaOp op, const Term& a, const BrokenDimension& dimension, std::size_t column, double exponent = 0);
  Term two(FormulaOp op, const Term& a, const Term& b, const BrokenDimension& dimension, std::size_t column);
  Term choose(const Term& asked, const Term& yes, const Term& no, const BrokenDimension& dimension, std::size_t column);

  // --- dimensions ---
  // Common dimension of two terms that are added, compared or alternatives.
  BrokenDimension common(const Term& a, const Term& b, std::size_t column, const char* what);
  static BrokenDimension combined(const BrokenDimension& a, const BrokenDimension& b, double sign);
  bool demand(const Term& t, const BrokenDimension& wanted, std::string_view who, const char* must);

  // --- functions ---
  Term extreme(bool greatest, const std::vector<Term>& args, std::size_t column);
  Term of_several(const std::string& name, const std::vector<Term>& args, std::size_t column);
  // max(least, min(greatest, a))
  Term clamped(const std::vector<Term>& args, std::size_t column);
  Term root_of_squares(const Term& a, const Term& b, const BrokenDimension& d, std::size_t column);
  // The angle of (x, y) from +x, −π … π: by y/x if |y| ≤ |x|, else by x/y; it jumps by 2π where y passes 0 with x < 0.
  Term direction(const Term& y, const Term& x, const BrokenDimension& d, std::size_t column);
  Term of_one(const std::string& name, const Term& a, std::size_t column);

  std::string_view text_;
  UnitError& error_;
  Formula made_;
  std::size_t at_ = 0;  // position in the text
  bool failed_ = false;
};

}  // namespace kurbel
