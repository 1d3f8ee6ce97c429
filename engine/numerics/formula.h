// formula.h — a law of one variable given by an expression: positions of its kinks and jumps, and each piece between them
// as a straight-line program for plain and dual numbers.
//
//     Formula  ──knots(from, to)──▶  x₀ < x₁ < … < xₙ  ──program(between two knots)──▶  FormulaProgram
//
// Every branch of abs, min, max, sign, step, if depends on the sign of some d(x). The changes of sign are found by interval
// arithmetic (Moore 1966): an interval on which every d keeps its sign contains none; others are bisected. So none is
// missed, and each piece has known branches: its program has no branches. The same search proves that no logarithm, root
// or quotient leaves its domain.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/numerics/dual.h"

namespace kurbel {

enum class FormulaOp : std::uint8_t {
  number,
  variable,
  add,
  subtract,
  multiply,
  divide,
  negate,
  power,  // by a constant exponent
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  tanh,
  exp,
  log,
  sqrt,
  choose  // b where a ≥ 0, else c
};

// Maximum stack depth of a program.
inline constexpr std::size_t most_formula_depth = 32;

// One piece of a formula as a stack program without branches. It is evaluated within its piece; arguments that leave a
// domain by rounding are limited to its edge.
class FormulaProgram {
 public:
  struct Step {
    FormulaOp op = FormulaOp::number;
    double number = 0;  // value of a constant; exponent of a power
  };

  void push(Step step);
  // Maximum stack depth.
  std::size_t depth() const { return depth_; }
  // −f(−x)
  FormulaProgram mirrored() const;

  template <class T>
  T operator()(const T& x) const {
    return depth_ <= 6 ? run<6>(x) : run<most_formula_depth>(x);
  }

 private:
  static double chain(double, double value, double) { return value; }
  template <int N>
  static Dual<N> chain(const Dual<N>& x, double value, double slope) {
    return x.chain(value, slope);
  }

  template <std::size_t depth, class T>
  T run(const T& x) const {
    T stack[depth] = {};
    std::size_t top = 0;  // number of values in use
    for (const Step& step : steps_) switch (step.op) {
        case FormulaOp::number:
          stack[top++] = T(step.number);
          break;
        case FormulaOp::variable:
          stack[top++] = x;
          break;
        case FormulaOp::add:
          --top, stack[top - 1] = stack[top - 1] + stack[top];
          break;
        case FormulaOp::subtract:
          --top, stack[top - 1] = stack[top - 1] - stack[top];
          break;
        case FormulaOp::multiply:
          --top, stack[top - 1] = stack[top - 1] * stack[top];
          break;
        case FormulaOp::divide:
          --top, stack[top - 1] = value_of(stack[top]) == 0 ? T(far) : stack[top - 1] / stack[top];
          break;
        case FormulaOp::negate:
          stack[top - 1] = -stack[top - 1];
          break;
        default:
          stack[top - 1] = of_one(step, stack[top - 1]);
      }
    return stack[0];
  }
  template <class T>
  static T of_one(const Step& step, const T& a) {
    const double v = value_of(a);
    switch (step.op) {
      case FormulaOp::power:
        return power(a, step.number);
      case FormulaOp::sin:
        return chain(a, std::sin(v), std::cos(v));
      case FormulaOp::cos:
        return chain(a, std::cos(v), -std::sin(v));
      case FormulaOp::tan:
        return chain(a, std::tan(v), 1 + std::tan(v) * std::tan(v));
      case FormulaOp::asin:
        return chain(a, std::asin(within_one(v)), 1 / root_of_rest(v));
      case FormulaOp::acos:
        return chain(a, std::acos(within_one(v)), -1 / root_of_rest(v));
      case FormulaOp::atan:
        return chain(a, std::atan(v), 1 / (1 + v * v));
      case FormulaOp::tanh:
        return chain(a, std::tanh(v), 1 - std::tanh(v) * std::tanh(v));
      case FormulaOp::exp:
        return chain(a, std::exp(v), std::exp(v));
      case FormulaOp::log: {
        const double held = v > near ? v : near;
        return chain(a, std::log(held), 1 / held);
      }
      default: {  // sqrt
        const double root = std::sqrt(v > near ? v : near);
        return chain(a, v > near ? root : 0, 0.5 / root);
      }
    }
  }
  template <class T>
  static T power(const T& a, double n) {
    const double v = value_of(a);
    if (n != std::round(n) && v <= 0) return chain(a, n > 0 ? 0 : far, n > 1 ? 0 : far);
    if (n < 0 && v == 0) return T(far);
    return chain(a, std::pow(v, n), n * std::pow(v, n - 1));
  }
  static double within_one(double v) { return v < -1 ? -1 : v > 1 ? 1 : v; }
  static double root_of_rest(double v) {
    constexpr double digit = 0x1p-53;  // rounding error of v near ±1
    const double rest = (1 - v) * (1 + v);
    return std::sqrt(rest > digit ? rest : digit);
  }
  static constexpr double near = 1e-200, far = 1e200;  // instead of 0 and of quotients by it

  std::vector<Step> steps_;
  std::size_t depth_ = 0, held_ = 0;
};

// A position at which a formula cannot be computed.
struct FormulaFault {
  double x = 0;            // the position
  std::size_t column = 0;  // of its text, from 0
  std::string text;        // why: "logarithm of -2"
};

class Formula {
 public:
  struct Node {
    FormulaOp op = FormulaOp::number;
    int a = -1, b = -1, c = -1;  // operands, with smaller indices
    double number = 0;           // value of a constant; exponent of a power
    std::size_t column = 0;      // in the text
  };

  int add(const Node& node);  // returns its index; the last node is the whole formula
  const Node& operator[](int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  std::size_t size() const { return nodes_.size(); }
  std::size_t depth() const;  // maximum stack depth of its programs

  // The value at x, or the fault there.
  std::optional<FormulaFault> value(double x, double& value) const;
  // Ascending knots from `from` to `to`, both included, between which the formula is smooth and can be computed; or the
  // fault that prevents it.
  std::optional<FormulaFault> knots(double from, double to, std::vector<double>& knots) const;
  // The piece between two knots.
  FormulaProgram program(double from, double to) const;

 private:
  struct Range {
    double low = 0, high = 0;
    bool split = false;  // a branch depends on the position of x in the interval
    int outside = -1;    // the node whose domain it may leave
  };
  struct Points {
    std::vector<double> value;
    std::vector<int> fault;  // node at fault, −1: none
  };
  Range over(double low, double high) const;
  Range choose_over(const Node& node, const std::vector<Range>& all) const;
  Points at(double x) const;
  std::vector<char> choices(double x) const;  // the branches taken, in the order of the nodes
  FormulaFault fault_at(double x, int node) const;
  void emit(int node, const std::vector<double>& farthest, FormulaProgram& to) const;
  std::optional<FormulaFault> look_into(double low, double high, double least, int& left,
                                        std::vector<std::pair<double, double>>& near) const;

  std::vector<Node> nodes_;
};

}  // namespace kurbel
