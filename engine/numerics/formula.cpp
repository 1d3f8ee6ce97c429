// formula.cpp — interval arithmetic over a formula, the search for its kinks, and the program of each piece.
#include "engine/numerics/formula.h"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <utility>

#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/roots.h"

namespace kurbel {
namespace {

constexpr double most = 1e30;               // greater values cannot be computed with (engine/reading)
constexpr double least_part = 1e-9;         // of the whole range: nearer places are one
constexpr int most_intervals = 100'000;     // that are looked into …
constexpr int most_work = 10'000'000;       // … and operations for that
constexpr std::size_t most_knots = 10'000;  // of one formula
constexpr double most_angle = 1e12;         // [rad]: above this a double does not resolve the position in a turn

struct Interval {
  double low, high;
};

Interval hull(std::initializer_list<double> values) { return {std::min(values), std::max(values)}; }

// sin over an interval: its ends, and the crests and troughs between them.
Interval sine(const Interval& a) {
  if (!(a.high - a.low < 2 * pi)) return {-1, 1};
  Interval s = hull({std::sin(a.low), std::sin(a.high)});
  const auto holds = [&](double place) { return std::ceil((a.low - place) / (2 * pi)) * 2 * pi + place <= a.high; };
  if (holds(pi / 2)) s.high = 1;
  if (holds(-pi / 2)) s.low = -1;
  return s;
}

// A power of whole exponent n ≥ 0.
Interval whole_power(const Interval& a, double n) {
  const Interval ends = hull({std::pow(a.low, n), std::pow(a.high, n)});
  const bool even = std::fmod(n, 2) == 0;
  return even && n > 0 && a.low < 0 && a.high > 0 ? Interval{0, ends.high} : ends;
}

// Image of an interval within the domain of a function of one operand.
Interval image(FormulaOp op, const Interval& a, double n) {
  switch (op) {
    case FormulaOp::power:
      if (n >= 0 && n == std::round(n)) return whole_power(a, n);
      if (n == std::round(n)) {
        const Interval p = whole_power(a, -n);
        return hull({1 / p.low, 1 / p.high});
      }
      return hull({std::pow(a.low, n), std::pow(a.high, n)});
    case FormulaOp::negate:
      return {-a.high, -a.low};
    case FormulaOp::sin:
      return sine(a);
    case FormulaOp::cos:
      return sine({a.low + pi / 2, a.high + pi / 2});
    case FormulaOp::tan:
      return {std::tan(a.low), std::tan(a.high)};
    case FormulaOp::asin:
      return {std::asin(a.low), std::asin(a.high)};
    case FormulaOp::acos:
      return {std::acos(a.high), std::acos(a.low)};
    case FormulaOp::atan:
      return {std::atan(a.low), std::atan(a.high)};
    case FormulaOp::tanh:
      return {std::tanh(a.low), std::tanh(a.high)};
    case FormulaOp::exp:
      return {std::exp(std::min(a.low, 700.0)), std::exp(std::min(a.high, 700.0))};
    case FormulaOp::log:
      return {std::log(a.low), std::log(a.high)};
    default:
      return {std::sqrt(a.low), std::sqrt(a.high)};
  }
}

// Whether function and slope are finite on the whole interval.
bool allows(FormulaOp op, const Interval& a, double n) {
  switch (op) {
    case FormulaOp::power:
      if (n == std::round(n)) return n >= 0 || a.low > 0 || a.high < 0;
      return n > 1 ? a.low >= 0 : a.low > 0;
    case FormulaOp::sin:
    case FormulaOp::cos:
      return a.low >= -most_angle && a.high <= most_angle;
    case FormulaOp::tan:
      return a.low >= -most_angle && a.high <= most_angle &&
             std::floor(a.low / pi + 0.5) == std::floor(a.high / pi + 0.5);
    case FormulaOp::asin:
    case FormulaOp::acos:
      return a.low > -1 && a.high < 1;
    case FormulaOp::log:
    case FormulaOp::sqrt:
      return a.low > 0;
    case FormulaOp::exp:
      return a.high < 700;
    default:
      return true;
  }
}

// Whether the slope is finite at the edge of the domain, as for x² to the power of 1.5.
bool may_touch(const Formula::Node& node) {
  return node.op == FormulaOp::power && node.number > 1 && node.number != std::round(node.number);
}

// Undefined at one point, defined on both sides of it.
bool has_pole(const Formula::Node& node) {
  return node.op == FormulaOp::divide || node.op == FormulaOp::tan || (node.op == FormulaOp::power && node.number < 0);
}

// Reason why a function of one operand has no value there; empty: it has one.
std::string not_defined(FormulaOp op, double a, double n) {
  switch (op) {
    case FormulaOp::power:
      if (n != std::round(n) && a < 0) return fmt::format("{:.4g} to the power of {:.4g}", a, n);
      return n < 0 && a == 0 ? fmt::format("0 to the power of {:.4g}", n) : "";
    case FormulaOp::asin:
    case FormulaOp::acos:
      return std::abs(a) > 1 ? fmt::format("{} of {:.4g}", op == FormulaOp::asin ? "asin" : "acos", a) : "";
    case FormulaOp::log:
      return a <= 0 ? fmt::format("logarithm of {:.4g}", a) : "";
    case FormulaOp::sqrt:
      return a < 0 ? fmt::format("root of {:.4g}", a) : "";
    case FormulaOp::exp:
      return a > 700 ? fmt::format("exp of {:.4g}", a) : "";
    case FormulaOp::sin:
    case FormulaOp::cos:
    case FormulaOp::tan:
      return std::abs(a) > most_angle ? fmt::format("{} of {:.4g} rad, beyond ± {:g}",
                                                    op == FormulaOp::sin   ? "sin"
                                                    : op == FormulaOp::cos ? "cos"
                                                                           : "tan",
                                                    a, most_angle)
                                      : "";
    default:
      return "";
  }
}

// Fault at the edge of the domain of an operation that is just reached by its operand.
std::string edge_of(const Formula::Node& n) {
  const bool broken = n.op == FormulaOp::power && n.number != std::round(n.number);
  if (n.op == FormulaOp::divide) return "division by 0";
  if (n.op == FormulaOp::tan) return "pole of tan";
  if (n.op == FormulaOp::log || (n.op == FormulaOp::power && n.number < 0)) return "an infinite value";
  if (n.op == FormulaOp::sqrt || n.op == FormulaOp::asin || n.op == FormulaOp::acos || (broken && n.number < 1))
    return "an infinite slope";
  return fmt::format("a value beyond ± {:g}", most);
}

// Whether a node is part of the result with these values of the nodes, not only of a condition.
bool is_part(const Formula& whole, int node, const std::vector<double>& values) {
  std::vector<char> part(whole.size(), 0);
  part.back() = 1;
  for (std::size_t k = whole.size(); k-- > 0;) {
    if (!part[k]) continue;
    const Formula::Node& n = whole[static_cast<int>(k)];
    const bool chooses = n.op == FormulaOp::choose;
    const bool yes = chooses && values[static_cast<std::size_t>(n.a)] >= 0;
    for (const int operand : {chooses ? (yes ? n.b : n.c) : n.a, chooses ? -1 : n.b})
      if (operand >= 0) part[static_cast<std::size_t>(operand)] = 1;
  }
  return part[static_cast<std::size_t>(node)];
}

// As its pieces' programs compute it: of an angle of many turns no other form of a function gives the same.
double apply(FormulaOp op, double a, double n) {
  if (op == FormulaOp::sin) return std::sin(a);
  if (op == FormulaOp::cos) return std::cos(a);
  return image(op, {a, a}, n).low;
}

}  // namespace

void FormulaProgram::push(Step step) {
  steps_.push_back(step);
  switch (step.op) {
    case FormulaOp::number:
    case FormulaOp::variable:
      depth_ = std::max(depth_, ++held_);
      break;
    case FormulaOp::add:
    case FormulaOp::subtract:
    case FormulaOp::multiply:
    case FormulaOp::divide:
      --held_;
      break;
    default:
      break;
  }
}

FormulaProgram FormulaProgram::mirrored() const {
  FormulaProgram other;
  for (const Step& step : steps_) {
    other.push(step);
    if (step.op == FormulaOp::variable) other.push({FormulaOp::negate, 0});
  }
  other.push({FormulaOp::negate, 0});
  return other;
}

int Formula::add(const Node& node) {
  nodes_.push_back(node);
  return static_cast<int>(nodes_.size()) - 1;
}

std::size_t Formula::depth() const {
  std::vector<std::size_t> holds;
  const auto of = [&](int node) { return holds[static_cast<std::size_t>(node)]; };
  for (const Node& node : nodes_) {
    if (node.op == FormulaOp::choose)
      holds.push_back(std::max(of(node.b), of(node.c)));
    else if (node.b >= 0)
      holds.push_back(std::max(of(node.a), of(node.b) + 1));
    else
      holds.push_back(node.a >= 0 ? of(node.a) : 1);
  }
  return holds.empty() ? 0 : holds.back();
}

Formula::Range Formula::choose_over(const Node& node, const std::vector<Range>& all) const {
  const Range &asked = all[static_cast<std::size_t>(node.a)], &yes = all[static_cast<std::size_t>(node.b)],
              &no = all[static_cast<std::size_t>(node.c)];
  const bool known = asked.outside < 0 && (asked.low >= 0 || asked.high < 0);
  Range r;
  if (known) {
    r = asked.low >= 0 ? yes : no;
    r.split = r.split || asked.split;
    return r;
  }
  r = {std::min(yes.low, no.low), std::max(yes.high, no.high), true, std::max(yes.outside, no.outside)};
  if (asked.outside < 0) return r;
  // A condition must be computable on every branch; its slope is not needed.
  r.outside = asked.outside;
  r.split = asked.split || !has_pole(nodes_[static_cast<std::size_t>(asked.outside)]);
  return r;
}

Formula::Range Formula::over(double low, double high) const {
  std::vector<Range> all(nodes_.size());
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Node& node = nodes_[k];
    Range& r = all[k];
    if (node.op == FormulaOp::number) {
      r = {node.number, node.number};
      continue;
    }
    if (node.op == FormulaOp::variable) {
      r = {low, high};
      continue;
    }
    if (node.op == FormulaOp::choose) {
      r = choose_over(node, all);
      continue;
    }
    const Range& a = all[static_cast<std::size_t>(node.a)];
    const Range b = node.b >= 0 ? all[static_cast<std::size_t>(node.b)] : Range{};
    r = {-most, most, a.split || b.split, std::max(a.outside, b.outside)};
    if (r.outside >= 0) continue;
    Interval image_of{};
    if (node.op == FormulaOp::add) {
      image_of = {a.low + b.low, a.high + b.high};
    } else if (node.op == FormulaOp::subtract) {
      image_of = {a.low - b.high, a.high - b.low};
    } else if (node.op == FormulaOp::multiply && node.a == node.b) {
      image_of = whole_power({a.low, a.high}, 2);
    } else if (node.op == FormulaOp::multiply) {
      image_of = hull({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
    } else if (node.op == FormulaOp::divide) {
      if (b.low <= 0 && b.high >= 0) {
        r.outside = static_cast<int>(k);
        continue;
      }
      image_of = hull({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high});
    } else if (allows(node.op, {a.low, a.high}, node.number)) {
      image_of = image(node.op, {a.low, a.high}, node.number);
    } else {
      r.outside = static_cast<int>(k);
      continue;
    }
    if (!(std::max(std::abs(image_of.low), std::abs(image_of.high)) <= most)) r.outside = static_cast<int>(k);
    r.low = std::clamp(image_of.low, -most, most), r.high = std::clamp(image_of.high, -most, most);
  }
  return all.back();
}

Formula::Points Formula::at(double x) const {
  Points p{std::vector<double>(nodes_.size(), 0.0), std::vector<int>(nodes_.size(), -1)};
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Node& node = nodes_[k];
    if (node.op == FormulaOp::number || node.op == FormulaOp::variable) {
      p.value[k] = node.op == FormulaOp::number ? node.number : x;
      continue;
    }
    const auto a = static_cast<std::size_t>(node.a);
    auto b = static_cast<std::size_t>(std::max(node.b, 0));
    p.fault[k] = p.fault[a];
    if (p.fault[k] >= 0) continue;
    if (node.op == FormulaOp::choose) {
      if (p.value[a] < 0) b = static_cast<std::size_t>(node.c);
      p.value[k] = p.value[b], p.fault[k] = p.fault[b];
      continue;
    }
    if (node.b >= 0) p.fault[k] = p.fault[b];
    if (p.fault[k] >= 0) continue;
    const double u = p.value[a], v = p.value[b];
    double& value = p.value[k];
    if ((node.op == FormulaOp::divide && v == 0) || !not_defined(node.op, u, node.number).empty()) {
      p.fault[k] = static_cast<int>(k);
      continue;
    }
    value = node.op == FormulaOp::add        ? u + v
            : node.op == FormulaOp::subtract ? u - v
            : node.op == FormulaOp::multiply ? u * v
            : node.op == FormulaOp::divide   ? u / v
                                             : apply(node.op, u, node.number);
    if (!(std::abs(value) <= most)) p.fault[k] = static_cast<int>(k);
  }
  return p;
}

std::vector<char> Formula::choices(double x) const {
  const Points p = at(x);
  // Nodes on which the result depends, from the last node downwards.
  std::vector<char> needed(nodes_.size(), 0), taken(nodes_.size(), 0);
  needed.back() = 1;
  for (std::size_t k = nodes_.size(); k-- > 0;) {
    if (!needed[k]) continue;
    const Node& node = nodes_[k];
    const auto need = [&](int operand) {
      if (operand >= 0) needed[static_cast<std::size_t>(operand)] = 1;
    };
    need(node.a);
    if (node.op != FormulaOp::choose) {
      need(node.b);
      continue;
    }
    const bool yes = p.value[static_cast<std::size_t>(node.a)] >= 0;
    taken[k] = yes ? 1 : 2;
    need(yes ? node.b : node.c);
  }
  return taken;
}

FormulaFault Formula::fault_at(double x, int node) const {
  const Node& n = nodes_[static_cast<std::size_t>(node)];
  const Points p = at(x);
  const double a = n.a >= 0 ? p.value[static_cast<std::size_t>(n.a)] : 0;
  std::string text = not_defined(n.op, a, n.number);
  if (text.empty()) text = edge_of(n);
  return {x, n.column, text};
}

std::optional<FormulaFault> Formula::value(double x, double& value) const {
  const Points p = at(x);
  value = p.value.back();
  if (p.fault.back() < 0) return {};
  return fault_at(x, p.fault.back());
}

std::optional<FormulaFault> Formula::look_into(double low, double high, double least, int& left,
                                               std::vector<std::pair<double, double>>& near) const {
  std::vector<std::pair<double, double>> open = {{low, high}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    Deadline::check();
    if (--left < 0) return FormulaFault{a, 0, "kinks or edges of a domain without end"};
    const Range r = over(a, b);
    if (!r.split && r.outside < 0) continue;
    const double middle = 0.5 * (a + b);
    if (b - a > least) {
      open.push_back({middle, b});
      open.push_back({a, middle});
      continue;
    }
    bool computed = r.outside >= 0;  // what is outside, on whichever branch
    for (const double x : {a, middle, b}) {
      const Points p = at(x);
      if (p.fault.back() >= 0) return fault_at(x, p.fault.back());
      computed = computed && (!r.split || is_part(*this, r.outside, p.value));
    }
    if (computed && !may_touch(nodes_[static_cast<std::size_t>(r.outside)]))
      return fault_at(std::abs(a - low) < least ? a : b, r.outside);
    if (!near.empty() && a - near.back().second <= 0.5 * least)
      near.back().second = b;
    else
      near.push_back({a, b});
  }
  return {};
}

std::optional<FormulaFault> Formula::knots(double from, double to, std::vector<double>& knots) const {
  const double least = least_part * (to - from);
  std::vector<std::pair<double, double>> near;
  int left = std::min(most_intervals, most_work / static_cast<int>(nodes_.size()));
  for (const double x : {from, to})
    if (const Points p = at(x); p.fault.back() >= 0) return fault_at(x, p.fault.back());
  if (auto fault = look_into(from, to, least, left, near)) return fault;
  knots = {from};
  for (const auto& [low, high] : near) {
    // Within: the last place, to a digit, where the answers are those of the begin.
    const std::vector<char> before = choices(low);
    if (choices(high) == before) continue;
    const double b = halved({low, high}, INT_MAX, [&](double x) { return choices(x) == before; }).high;
    if (b - knots.back() > 4 * least && to - b > 4 * least) knots.push_back(b);
    if (knots.size() > most_knots) return FormulaFault{b, 0, fmt::format("more than {} kinks", most_knots)};
  }
  knots.push_back(to);
  return {};
}

void Formula::emit(int node, const std::vector<double>& farthest, FormulaProgram& to) const {
  const Node& n = nodes_[static_cast<std::size_t>(node)];
  if (n.op == FormulaOp::choose) return emit(farthest[static_cast<std::size_t>(n.a)] >= 0 ? n.b : n.c, farthest, to);
  if (n.op == FormulaOp::power && n.number == 0) return to.push({FormulaOp::number, 1});  // also of 0: n vⁿ⁻¹ is 0·∞
  if (n.a >= 0) emit(n.a, farthest, to);
  if (n.b >= 0) emit(n.b, farthest, to);
  to.push({n.op, n.number});
}

// A condition keeps its sign on the piece, but may touch 0 there, as x² does: its branch is taken at the sample farthest
// from 0.
FormulaProgram Formula::program(double from, double to) const {
  constexpr double golden = 0.6180339887498949;  // spreads places over the piece
  constexpr int places = 12;
  std::vector<double> farthest(nodes_.size(), 0.0);
  for (int i = 0; i < places; ++i) {
    const Points p = at(from + (to - from) * std::fmod(0.5 + golden * i, 1.0));
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (p.fault[k] < 0 && std::abs(p.value[k]) > std::abs(farthest[k])) farthest[k] = p.value[k];
  }
  FormulaProgram made;
  emit(static_cast<int>(nodes_.size()) - 1, farthest, made);
  return made;
}

}  // namespace kurbel
