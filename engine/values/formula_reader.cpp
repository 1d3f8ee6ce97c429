// formula_reader.cpp — a parser by recursive descent; constants are folded, dimensions compared as it goes.
#include "engine/values/formula_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "engine/scene/keys.h"
#include "engine/scene/messages.h"
#include "engine/scene/text.h"
#include "engine/values/formula_builder.h"

namespace kurbel {
namespace {

constexpr std::size_t longest = 2000;  // characters of a formula
constexpr int deepest = 32;            // of parentheses, functions, signs and powers within each other

const std::vector<std::string>& function_names() {
  static const std::vector<std::string> names = {"sin",   "cos",   "tan",   "asin", "acos", "atan", "tanh",
                                                 "exp",   "log",   "log10", "sqrt", "abs",  "min",  "max",
                                                 "clamp", "hypot", "atan2", "sign", "step", "if"};
  return names;
}

class FormulaParser : private FormulaBuilder {
 public:
  FormulaParser(std::string_view text, const FormulaNames& names, UnitError& error)
      : FormulaBuilder(text, error), names_(names) {}

  std::optional<ReadFormula> parse() {
    if (text_.size() > longest) return stop(fmt::format("more than {} characters", longest), longest), std::nullopt;
    const Term whole = sum();
    if (!failed_ && (skip(), at_ < text_.size())) fail_unexpected("an operator or the end");
    if (failed_) return std::nullopt;
    // The whole is the last node.
    if (whole.node + 1 != static_cast<int>(made_.size())) {
      Formula ordered;
      for (int k = 0; k <= whole.node; ++k) ordered.add(made_[k]);
      made_ = std::move(ordered);
    }
    if (made_.depth() > most_formula_depth)
      return stop(fmt::format("holds more than {} values at once; name its parts in [constants], or turn sums around",
                              most_formula_depth),
                  0),
             std::nullopt;
    return ReadFormula{std::move(made_), whole.dimension, whole.zero};
  }

 private:
  Term fail_unexpected(const char* wanted) {
    if (at_ >= text_.size()) return stop(fmt::format("the formula ends where {} should follow", wanted), at_);
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with("\u2212")) return stop("the minus sign must be the plain \"-\"", at_);
    if (rest[0] == ',' && depth_ == 0) return stop("unexpected comma; decimals are written with a point", at_);
    std::size_t end = 1;
    while (end < rest.size() && !begins_character(rest[end])) ++end;
    if (is_letter(rest[0]) || is_digit(rest[0])) end = word_at(at_).size();
    return stop(
        fmt::format("unexpected {}; expected {}", in_quotes(rest.substr(0, std::max<std::size_t>(end, 1))), wanted),
        at_);
  }

  // --- characters ---
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
  void skip() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n')) ++at_;
  }
  bool take(std::string_view token) {
    skip();
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    return true;
  }
  std::string_view word_at(std::size_t begin) const {
    std::size_t end = begin;
    while (end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end]))) ++end;
    return text_.substr(begin, end - begin);
  }

  // --- grammar ---
  struct Deeper {
    explicit Deeper(FormulaParser& p) : parser(p) {
      if (++p.depth_ > deepest) p.stop(fmt::format("nested more than {} deep", deepest), p.at_);
    }
    ~Deeper() { --parser.depth_; }
    FormulaParser& parser;
  };

  Term sum() {
    Term left = product();
    while (!failed_) {
      skip();
      const std::size_t column = at_;
      const bool plus = take("+");
      if (!plus && !take("-")) break;
      const Term right = product();
      const BrokenDimension d = common(left, right, column, plus ? "cannot add" : "cannot subtract");
      left = two(plus ? FormulaOp::add : FormulaOp::subtract, left, right, d, column);
    }
    return left;
  }
  Term product() {
    Term left = sign();
    while (!failed_) {
      skip();
      const std::size_t column = at_;
      const bool times = take("*") || take("·");
      if (!times && !take("/")) break;
      const Term right = sign();
      left = two(times ? FormulaOp::multiply : FormulaOp::divide, left, right,
                 combined(left.dimension, right.dimension, times ? 1 : -1), column);
    }
    return left;
  }
  Term sign() {
    skip();
    const std::size_t column = at_;
    if (take("-")) {
      const Deeper deeper(*this);
      const Term of_this = sign();
      Term t = one(FormulaOp::negate, of_this, of_this.dimension, column);
      t.zero = of_this.zero;
      return t;
    }
    return power();
  }
  Term power() {
    const Term base = operand();
    skip();
    const std::size_t column = at_;
    if (failed_ || !take("^")) return base;
    const Deeper deeper(*this);
    const Term exponent = sign();
    if (failed_ || !demand(exponent, plain_number, "an exponent", "a plain number")) return {};
    if (constant(exponent)) {
      const double n = of(exponent).number;
      BrokenDimension d = base.dimension;
      for (double& e : d) e *= n;
      return one(FormulaOp::power, base, d, column, n);
    }
    if (!same_dimension(base.dimension, plain_number))
      return stop(fmt::format("{} to a power that varies; must be a plain number", name_of(base.dimension)), column);
    return one(
        FormulaOp::exp,
        two(FormulaOp::multiply, exponent, one(FormulaOp::log, base, plain_number, column), plain_number, column),
        plain_number, column);
  }
  Term operand() {
    skip();
    const std::size_t column = at_;
    if (at_ >= text_.size()) return fail_unexpected("a number, a name or a parenthesis");
    if (is_digit(text_[at_]) || text_[at_] == '.') return quantity();
    if (is_letter(text_[at_])) return named();
    if (!take("(")) return fail_unexpected("a number, a name or a parenthesis");
    const Deeper deeper(*this);
    Term inner = sum();
    if (!failed_ && !take(")")) return unclosed(column);
    inner.column = column;
    return inner;
  }
  Term unclosed(std::size_t column) {
    if (at_ < text_.size()) return fail_unexpected("an operator or \")\"");
    return stop("this parenthesis is not closed", column);
  }
  Term quantity() {
    const std::size_t column = at_;
    double value = 0;
    const auto [end, status] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (status != std::errc{} || !std::isfinite(value))
      return stop(status == std::errc::result_out_of_range ? "the number is out of range (1e-308 … 1e308)"
                                                           : "this is no number",
                  column);
    at_ = static_cast<std::size_t>(end - text_.data());
    std::string_view unit;
    std::size_t unit_at = at_;
    if (take("[")) {
      unit_at = at_;
      const std::size_t close = text_.find(']', at_);
      if (close == std::string_view::npos) return stop("this bracket is not closed", unit_at - 1);
      unit = text_.substr(at_, close - at_);
      at_ = close + 1;
    } else if (skip(), at_ < text_.size() && (is_letter(text_[at_]) || static_cast<unsigned char>(text_[at_]) >= 0x80 ||
                                              text_[at_] == '%')) {
      if (text_.substr(at_).starts_with("·") || text_.substr(at_).starts_with("\u2212"))
        return number(value, plain_number, column, true);
      unit_at = at_;
      while (at_ < text_.size() &&
             (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '%' ||
              (static_cast<unsigned char>(text_[at_]) >= 0x80 && !text_.substr(at_).starts_with("·"))))
        ++at_;
      unit = text_.substr(unit_at, at_ - unit_at);
    } else {
      return number(value, plain_number, column, true);
    }
    return with_unit_of(value, unit, unit_at, column);
  }
  Term with_unit_of(double value, std::string_view unit, std::size_t unit_at, std::size_t column) {
    UnitError error;
    const auto read = parse_unit(unit, error);
    if (!read) {
      const bool is_name = names_.constants.count(std::string(unit)) > 0 || is_variable(unit) || unit == "pi";
      return stop(
          is_name ? fmt::format("{} follows a number; write {} * {}", in_quotes(unit), value, unit) : error.text,
          unit_at + (is_name ? 0 : error.column));
    }
    if (text_.substr(at_).starts_with("^"))
      return stop(fmt::format("a power of a unit or of a quantity? Write {0} [{1}^…] or ({0} {1})^…", value, unit),
                  at_);
    const double si = value * read->factor;
    if (!std::isfinite(si)) return stop("the number is out of range (1e-308 … 1e308)", column);
    return number(si, broken(read->dimension), column);
  }
  bool is_variable(std::string_view name) const {
    return std::find(names_.variable.begin(), names_.variable.end(), name) != names_.variable.end();
  }
  Term named() {
    const std::size_t column = at_;
    const std::string name(word_at(at_));
    at_ += name.size();
    skip();
    const auto& functions = function_names();
    const bool is_function = std::find(functions.begin(), functions.end(), name) != functions.end();
    if (at_ < text_.size() && text_[at_] == '(') {
      if (!is_function) return unknown(name, column, "function", functions);
      return call(name, column);
    }
    if (is_function) return stop(fmt::format("{} is a function; write {}(…)", name, name), column);
    if (is_variable(name))
      return {made_.add({.op = FormulaOp::variable, .column = column}), broken(names_.variable_dimension), false,
              column};
    if (const auto found = names_.constants.find(name); found != names_.constants.end())
      return number(found->second.value, broken(found->second.dimension), column);
    if (name == "pi") return number(std::numbers::pi, plain_number, column);
    std::vector<std::string> known = names_.variable;
    for (const auto& constant : names_.constants) known.push_back(constant.first);
    known.emplace_back("pi");
    return unknown(name, column, "name", known);
  }
  Term unknown(const std::string& name, std::size_t column, const char* what, const std::vector<std::string>& known) {
    UnitError error;
    const bool is_unit = parse_unit(name, error).has_value();
    return stop(fmt::format("unknown {} {}{}; known: {}{}", what, in_quotes(name), suggestion(name, known),
                            shortened_list(known, "and"),
                            is_unit ? "; a unit of several parts is written in brackets, 20 [N*m]" : ""),
                column);
  }

  // --- functions ---
  Term call(const std::string& name, std::size_t column) {
    const Deeper deeper(*this);
    take("(");
    if (name == "if") return alternative(column);
    std::vector<Term> args = {sum()};
    while (!failed_ && take(",")) args.push_back(sum());
    if (!failed_ && !take(")")) return unclosed(column + name.size());
    if (failed_) return {};
    if (name == "clamp" || name == "hypot" || name == "atan2") return of_several(name, args, column);
    const bool of_two = name == "min" || name == "max";
    if (of_two ? args.size() < 2 : args.size() != 1)
      return stop(fmt::format("{} of {} value{}; must be {}", name, args.size(), args.size() == 1 ? "" : "s",
                              of_two ? "two or more" : "one"),
                  column);
    if (of_two) return extreme(name == "max", args, column);
    return of_one(name, args.front(), column);
  }
  Term alternative(std::size_t column) {
    const Term left = sum();
    skip();
    const std::size_t sign_at = at_;
    const char* const found[] = {"<=", ">=", "<", ">"};
    const auto sign = std::find_if(std::begin(found), std::end(found), [&](const char* s) { return take(s); });
    if (!failed_ && sign == std::end(found)) return fail_unexpected("a comparison <, <=, > or >=");
    const Term right = sum();
    const BrokenDimension compared = common(left, right, sign_at, "cannot compare");
    if (!failed_ && !take(",")) return fail_unexpected("a comma and the value where it holds");
    Term yes = sum();
    if (!failed_ && !take(",")) return fail_unexpected("a comma and the value where it does not hold");
    Term no = sum();
    if (!failed_ && !take(")")) return unclosed(column + 2);
    const BrokenDimension d = common(yes, no, no.column, "alternatives of");
    if (failed_) return {};
    // All as "difference ≥ 0": a < b where not a − b ≥ 0.
    const std::string_view s = *sign;
    const bool left_first = s == "<" || s == ">=";
    const Term asked = left_first ? two(FormulaOp::subtract, left, right, compared, sign_at)
                                  : two(FormulaOp::subtract, right, left, compared, sign_at);
    const bool holds_where_not = s == "<" || s == ">";
    Term t = holds_where_not ? choose(asked, no, yes, d, column) : choose(asked, yes, no, d, column);
    t.dimension = d;
    return t;
  }

  const FormulaNames& names_;
  int depth_ = 0;
};

}  // namespace

std::optional<ReadFormula> read_formula(std::string_view text, const FormulaNames& names, UnitError& error) {
  return FormulaParser(text, names, error).parse();
}

std::string wrong_constant_name(const std::string& name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  bool good = !name.empty() && letter(name[0]) && name.size() <= 60;
  for (const char c : name) good = good && (letter(c) || (c >= '0' && c <= '9'));
  if (!good) return "letters, digits and _ make a name, a letter first";
  if (name == "pi") return "pi is known";
  const auto& functions = function_names();
  if (std::find(functions.begin(), functions.end(), name) != functions.end()) return "it is a function";
  return "";
}

}  // namespace kurbel
