// formula_builder.cpp — what is added, compared and called with what, and the nodes that come of it.
#include "engine/values/formula_builder.h"

#include <fmt/format.h>

#include <numbers>

namespace kurbel {
namespace {

struct NamedOp {
  std::string_view name;
  FormulaOp op;
};
constexpr NamedOp of_numbers[] = {{"asin", FormulaOp::asin}, {"acos", FormulaOp::acos}, {"atan", FormulaOp::atan},
                                  {"tanh", FormulaOp::tanh}, {"exp", FormulaOp::exp},   {"log", FormulaOp::log}};
constexpr NamedOp of_angles[] = {{"sin", FormulaOp::sin}, {"cos", FormulaOp::cos}, {"tan", FormulaOp::tan}};

const Dimension angle{{0, 0, 0, 1, 0}};
}  // namespace

FormulaBuilder::Term FormulaBuilder::stop(std::string text, std::size_t column) {
  if (!failed_) error_ = {std::move(text), column};
  failed_ = true;
  at_ = text_.size();
  return {};
}

FormulaBuilder::Term FormulaBuilder::number(double value, const BrokenDimension& dimension, std::size_t column,
                                            bool may_be_zero) {
  return {made_.add({.op = FormulaOp::number, .number = value, .column = column}), dimension, may_be_zero && value == 0,
          column};
}

FormulaBuilder::Term FormulaBuilder::make(Formula::Node node, const BrokenDimension& dimension) {
  bool known = true;
  for (const int k : {node.a, node.b, node.c}) known = known && (k < 0 || made_[k].op == FormulaOp::number);
  if (!known) return {made_.add(node), dimension, false, node.column};
  Formula alone;
  for (int* k : {&node.a, &node.b, &node.c})
    if (*k >= 0) *k = alone.add(made_[*k]);
  alone.add(node);
  double value = 0;
  if (const auto fault = alone.value(0, value)) return stop(fault->text, node.column);
  return number(value, dimension, node.column);
}

FormulaBuilder::Term FormulaBuilder::one(FormulaOp op, const Term& a, const BrokenDimension& dimension,
                                         std::size_t column, double exponent) {
  if (failed_) return {};
  return make({.op = op, .a = a.node, .number = exponent, .column = column}, dimension);
}

FormulaBuilder::Term FormulaBuilder::two(FormulaOp op, const Term& a, const Term& b, const BrokenDimension& dimension,
                                         std::size_t column) {
  if (failed_) return {};
  return make({.op = op, .a = a.node, .b = b.node, .column = column}, dimension);
}

FormulaBuilder::Term FormulaBuilder::choose(const Term& asked, const Term& yes, const Term& no,
                                            const BrokenDimension& dimension, std::size_t column) {
  if (failed_) return {};
  if (constant(asked)) return of(asked).number >= 0 ? yes : no;
  return {made_.add({.op = FormulaOp::choose, .a = asked.node, .b = yes.node, .c = no.node, .column = column}),
          dimension, false, column};
}

BrokenDimension FormulaBuilder::common(const Term& a, const Term& b, std::size_t column, const char* what) {
  if (failed_ || a.zero || same_dimension(a.dimension, b.dimension)) return b.dimension;
  if (b.zero) return a.dimension;
  stop(fmt::format("{} {} and {}", what, name_of(a.dimension), name_of(b.dimension)), column);
  return plain_number;
}

BrokenDimension FormulaBuilder::combined(const BrokenDimension& a, const BrokenDimension& b, double sign) {
  BrokenDimension sum = a;
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += sign * b[i];
  return sum;
}

bool FormulaBuilder::demand(const Term& t, const BrokenDimension& wanted, std::string_view who, const char* must) {
  if (failed_ || t.zero || same_dimension(t.dimension, wanted)) return true;
  stop(fmt::format("{} of {}; must be of {}", who, name_of(t.dimension), must), t.column);
  return false;
}

FormulaBuilder::Term FormulaBuilder::extreme(bool greatest, const std::vector<Term>& args, std::size_t column) {
  Term best = args.front();
  for (std::size_t k = 1; k < args.size() && !failed_; ++k) {
    const Term& next = args[k];
    const BrokenDimension d = common(best, next, next.column, "cannot compare");
    const bool both_zero = best.zero && next.zero;
    const Term more = two(FormulaOp::subtract, best, next, d, column);
    best = greatest ? choose(more, best, next, d, column) : choose(more, next, best, d, column);
    best.dimension = d, best.zero = both_zero;
  }
  return best;
}

FormulaBuilder::Term FormulaBuilder::of_several(const std::string& name, const std::vector<Term>& args,
                                                std::size_t column) {
  const std::size_t wanted = name == "clamp" ? 3 : 2;
  if (args.size() != wanted)
    return stop(fmt::format("{} of {} value{}; must be {}", name, args.size(), args.size() == 1 ? "" : "s",
                            name == "clamp"   ? "three: what, least, greatest"
                            : name == "atan2" ? "two: y, x"
                                              : "two"),
                column);
  if (name == "clamp") return clamped(args, column);
  const BrokenDimension d = common(args[0], args[1], args[1].column, "cannot compare");
  if (failed_) return {};
  return name == "hypot" ? root_of_squares(args[0], args[1], d, column) : direction(args[0], args[1], d, column);
}

FormulaBuilder::Term FormulaBuilder::clamped(const std::vector<Term>& args, std::size_t column) {
  if (!failed_ && constant(args[1]) && constant(args[2]) && of(args[1]).number > of(args[2]).number)
    return stop(fmt::format("clamp between {:.4g} and {:.4g}; the least value must not exceed the greatest",
                            of(args[1]).number, of(args[2]).number),
                column);
  return extreme(true, {args[1], extreme(false, {args[0], args[2]}, column)}, column);
}

FormulaBuilder::Term FormulaBuilder::root_of_squares(const Term& a, const Term& b, const BrokenDimension& d,
                                                     std::size_t column) {
  const BrokenDimension square = combined(d, d, 1);
  const auto squared = [&](const Term& t) { return two(FormulaOp::multiply, t, t, square, column); };
  return one(FormulaOp::sqrt, two(FormulaOp::add, squared(a), squared(b), square, column), d, column);
}

FormulaBuilder::Term FormulaBuilder::direction(const Term& y, const Term& x, const BrokenDimension& d,
                                               std::size_t column) {
  const BrokenDimension radians = broken(angle);
  const auto ratio = [&](const Term& a, const Term& b) {
    return one(FormulaOp::atan, two(FormulaOp::divide, a, b, plain_number, column), radians, column);
  };
  const auto from = [&](double quarters, FormulaOp op, const Term& t) {
    return two(op, number(quarters * std::numbers::pi / 2, radians, column), t, radians, column);
  };
  const auto magnitude = [&](const Term& t) {
    return choose(t, t, one(FormulaOp::negate, t, t.dimension, column), t.dimension, column);
  };
  // What depends on constants is computed where it is read: only on the side that is taken.
  const auto either = [&](const Term& asked, const auto& yes, const auto& no) {
    if (failed_) return Term{};
    if (constant(asked)) return of(asked).number >= 0 ? yes() : no();
    const Term a = yes(), b = no();
    return choose(asked, a, b, radians, column);
  };
  const auto flat = [&] {
    return either(
        x, [&] { return ratio(y, x); },
        [&] {
          return either(
              y, [&] { return from(2, FormulaOp::add, ratio(y, x)); },
              [&] { return from(-2, FormulaOp::add, ratio(y, x)); });
        });
  };
  const auto steep = [&] {
    return either(
        y, [&] { return from(1, FormulaOp::subtract, ratio(x, y)); },
        [&] { return from(-1, FormulaOp::subtract, ratio(x, y)); });
  };
  return either(two(FormulaOp::subtract, magnitude(x), magnitude(y), d, column), flat, steep);
}

FormulaBuilder::Term FormulaBuilder::of_one(const std::string& name, const Term& a, std::size_t column) {
  for (const NamedOp& f : of_numbers)
    if (f.name == name) {
      if (!demand(a, plain_number, name, "a plain number")) return {};
      const bool gives_angle = name == "asin" || name == "acos" || name == "atan";
      return one(f.op, a, gives_angle ? broken(angle) : plain_number, column);
    }
  for (const NamedOp& f : of_angles)
    if (f.name == name) {
      if (!same_dimension(a.dimension, plain_number) && !demand(a, broken(angle), name, "an angle or a plain number"))
        return {};
      return one(f.op, a, plain_number, column);
    }
  if (name == "log10") {
    if (!demand(a, plain_number, name, "a plain number")) return {};
    return two(FormulaOp::divide, one(FormulaOp::log, a, plain_number, column),
               number(std::numbers::ln10, plain_number, column), plain_number, column);
  }
  if (name == "sqrt") {
    BrokenDimension half = a.dimension;
    for (double& e : half) e *= 0.5;
    return one(FormulaOp::sqrt, a, half, column);
  }
  if (name == "abs") return choose(a, a, one(FormulaOp::negate, a, a.dimension, column), a.dimension, column);
  const Term yes = number(1, plain_number, column), no = number(name == "sign" ? -1 : 0, plain_number, column);
  return choose(a, yes, no, plain_number, column);
}

}  // namespace kurbel
