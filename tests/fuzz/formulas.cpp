// formulas.cpp — expressions grown from their grammar, and their values and slopes.
#include "tests/fuzz/formulas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "engine/numerics/deadline.h"
#include "engine/values/formula_reader.h"

namespace kurbel::fuzz {
namespace {

FormulaNames names_of_x() {
  FormulaNames names;
  names.variable = {"x"};
  names.constants["p0"] = {1e5, {{1, -1, -2, 0, 0}}};
  names.constants["s0"] = {0.02, {{0, 1, 0, 0, 0}}};
  names.constants["n"] = {1.3, {}};
  return names;
}

std::string operand(Random& random) {
  static const std::vector<std::string> some = {"x",    "x",      "n",  "0",     "1",      "2",        "0.5",
                                                "1e-3", "pi",     "20", "p0",    "s0",     "x/s0",     "7",
                                                "3 mm", "2 [kN]", "p",  "1e400", "5 kN*m", "0.1 [1/s]"};
  return random.one_of(some);
}

std::string grown(Random& random, int depth) {
  static const std::vector<std::string> of_one = {"sin", "cos",   "tan",  "asin", "acos", "atan", "tanh", "exp",
                                                  "log", "log10", "sqrt", "abs",  "sign", "step", "(",    "-"};
  static const std::vector<std::string> of_two = {"min", "max", "hypot", "atan2"};
  static const std::vector<std::string> between = {"+", "-", "*", "/", "^", " + ", "*", "-"};
  static const std::vector<std::string> compares = {"<", "<=", ">", ">="};
  if (depth == 0 || random.chance(0.15)) return operand(random);
  const auto part = [&] { return grown(random, depth - 1); };
  const double kind = random.uniform();
  if (kind < 0.45) {
    const std::string left = part(), sign = random.one_of(between);
    return left + sign + part();
  }
  if (kind < 0.8) {
    const std::string& name = random.one_of(of_one);
    return name == "-" ? "-" + part() : (name == "(" ? "" : name) + "(" + part() + ")";
  }
  if (kind < 0.9) {
    const std::string& name = random.one_of(of_two);
    const std::string first = part();
    return fmt::format("{}({}, {})", name, first, part());
  }
  const std::string a = part(), b = part(), c = part();
  if (kind < 0.95) return fmt::format("clamp({}, {}, {})", a, b, c);
  return fmt::format("if({} {} {}, {}, {})", a, random.one_of(compares), b, c, part());
}

// --- what must be true of a piece ---

// Central differences give a slope where those of two widths agree.
std::string fault_of_slope(const FormulaProgram& program, double x, double room) {
  constexpr double width = 1e-4, alike = 1e-4, same = 1e-3, least = 1e-290;
  const auto slope = [&](double h) { return (program(x + h) - program(x - h)) / (2 * h); };
  const double wide = slope(width * room), narrow = slope(0.37 * width * room);
  const double dual = program(Dual<1>::input(x, 0)).d[0];
  const double size = std::max(std::abs(wide), std::abs(narrow));
  // Of the values, in the differences: their last digits, and those of a one from which they may be what is left; where
  // they do not change at all, the root of those.
  const double noise = (1e-10 * std::abs(program(x)) + (size == 0 ? 1e-8 : 1e-15)) / (width * room);
  const double digit = std::abs(program(Dual<1>::input(x * (1 + 1e-14), 0)).d[0] - dual);  // of x, in the slope
  if (!std::isfinite(size) || std::abs(wide - narrow) > alike * size) return {};
  if (std::abs(dual - narrow) <= same * size + noise + digit + least) return {};
  return fmt::format("slope {:.17g} at x = {:.17g}, by differences {:.17g}", dual, x, narrow);
}

std::string fault_of_piece(const Formula& formula, double from, double to) {
  const FormulaProgram program = formula.program(from, to);
  for (const double part : {0.1, 0.37, 0.5, 0.81}) {
    const double x = from + part * (to - from), by_program = program(x);
    double by_nodes = 0;
    if (formula.value(x, by_nodes)) return fmt::format("no value at x = {:.17g} within a piece", x);
    if (!std::isfinite(by_program)) continue;  // a curve refuses that
    // Powers of powers magnify the last digit of x, roots that of a zero.
    const double one_digit = std::abs(program(x * (1 + 1e-14)) - by_program);
    if (std::abs(by_program - by_nodes) > 1e-12 * std::abs(by_nodes) + 10 * one_digit + 1e-7)
      return fmt::format("{:.17g} and {:.17g} at x = {:.17g}", by_program, by_nodes, x);
    if (std::string fault = fault_of_slope(program, x, std::min(part, 1 - part) * (to - from)); !fault.empty())
      return fault;
  }
  return {};
}

}  // namespace

std::string formula_input(std::uint64_t seed, const MutationStyle&) {
  Random random(seed);
  const std::string text = grown(random, 1 + static_cast<int>(random.index(5)));
  return random.chance(0.3) ? mutated_formula(text, random) : text;
}

std::string mutated_formula(const std::string& text, Random& random, const MutationStyle&) {
  static const std::string letters = "()+-*/^,<>=[] .x0e1nsifp\x80";
  std::string changed = text;
  for (std::size_t i = 0, n = 1 + random.index(4); i < n; ++i) {
    const std::size_t at = random.index(changed.size() + 1);
    const char letter = letters[random.index(letters.size())];
    if (random.chance(0.4) || at == changed.size())
      changed.insert(at, 1, letter);
    else if (random.chance(0.5))
      changed.erase(at, 1 + random.index(3));
    else
      changed[at] = letter;
  }
  return changed;
}

std::string judge_formula(const std::string& text) {
  UnitError error;
  const auto read = read_formula(text, names_of_x(), error);
  if (!read) {
    if (error.text.empty()) return "a refusal without words";
    return error.column > text.size() ? fmt::format("column {} of {} letters", error.column, text.size()) : "";
  }
  const auto number = Random(std::hash<std::string>()(text)).bits();
  const double from = number % 3 == 0 ? 0 : -2, to = number % 2 == 0 ? 3 : 0.5;
  const Deadline deadline(1);
  try {
    std::vector<double> knots;
    if (const auto fault = read->formula.knots(from, to, knots)) {
      if (fault->text.empty() || fault->column > text.size()) return "a fault without words or place";
      return fault->x >= from && fault->x <= to ? "" : fmt::format("a fault at {:.17g}, out of its range", fault->x);
    }
    if (knots.size() < 2 || knots.front() != from || knots.back() != to) return "knots that do not span the range";
    for (std::size_t i = 0; i + 1 < knots.size(); ++i)
      if (std::string fault = fault_of_piece(read->formula, knots[i], knots[i + 1]); !fault.empty()) return fault;
  } catch (const OutOfTime&) {
  } catch (const std::invalid_argument& refused) {
    return std::string(refused.what()).empty() ? "a refusal without words" : "";
  }
  return {};
}

}  // namespace kurbel::fuzz
