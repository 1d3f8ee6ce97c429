// formula_test.cpp — formulas of scenes: their values and slopes against arithmetic of this file's own, their kinks, and
// what is wrong with sixty of them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "engine/numerics/curve.h"
#include "engine/values/formula_reader.h"

namespace kurbel::formula_test {
namespace {

FormulaNames names_of_x() {
  FormulaNames names;
  names.variable = {"x"};
  names.constants["p0"] = {1e5, {{1, -1, -2, 0, 0}}};
  names.constants["A"] = {0.01, {{0, 2, 0, 0, 0}}};
  names.constants["s0"] = {0.02, {{0, 1, 0, 0, 0}}};
  names.constants["n"] = {1.3, {}};
  return names;
}

Curve curve_of(const std::string& text, double from, double to, const FormulaNames& names = names_of_x()) {
  UnitError error;
  const auto read = read_formula(text, names, error);
  EXPECT_TRUE(read) << text << ": " << error.text << " at " << error.column;
  if (!read) return {};
  std::vector<double> knots;
  const auto fault = read->formula.knots(from, to, knots);
  EXPECT_FALSE(fault) << text << ": " << fault->text << " at x = " << fault->x;
  if (fault) return {};
  std::vector<FormulaProgram> programs;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) programs.push_back(read->formula.program(knots[i], knots[i + 1]));
  return Curve(knots, std::move(programs));
}

std::string fault_of(const std::string& text, double from, double to) {
  UnitError error;
  const auto read = read_formula(text, names_of_x(), error);
  if (!read) return error.text;
  std::vector<double> knots;
  const auto fault = read->formula.knots(from, to, knots);
  return fault ? fault->text : "";
}

// --- a value with its slope, in long double ---

struct Own {
  long double v = 0, d = 0;
};
Own operator+(Own a, Own b) { return {a.v + b.v, a.d + b.d}; }
Own operator-(Own a, Own b) { return {a.v - b.v, a.d - b.d}; }
Own operator*(Own a, Own b) { return {a.v * b.v, a.d * b.v + a.v * b.d}; }
Own operator/(Own a, Own b) { return {a.v / b.v, (a.d * b.v - a.v * b.d) / (b.v * b.v)}; }
Own of(Own a, long double f, long double slope) { return {f, slope * a.d}; }

// A random expression as text and as arithmetic.
struct Expression {
  std::string text;
  std::function<Own(Own)> value;
};

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  int upto(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
  double number() { return std::round(std::uniform_real_distribution<double>(-3, 3)(random_) * 100) / 100; }

 private:
  std::mt19937 random_;
};

Expression leaf(Dice& dice) {
  if (dice.upto(3) > 0) return {"x", [](Own x) { return x; }};
  const double c = dice.number();
  const std::string text = c < 0 ? fmt::format("({})", c) : fmt::format("{}", c);
  return {text, [c](Own) { return Own{static_cast<long double>(std::stod(fmt::format("{}", c))), 0}; }};
}

Expression of_two(Dice& dice, const Expression& a, const Expression& b) {
  const auto f = a.value, g = b.value;
  switch (dice.upto(6)) {
    case 0:
      return {fmt::format("({} + {})", a.text, b.text), [=](Own x) { return f(x) + g(x); }};
    case 1:
      return {fmt::format("({} - {})", a.text, b.text), [=](Own x) { return f(x) - g(x); }};
    case 2:
      return {fmt::format("{}*{}", a.text, b.text), [=](Own x) { return f(x) * g(x); }};
    case 3:
      return {fmt::format("{}/(2 + sin({}))", a.text, b.text), [=](Own x) {
                const Own u = g(x);
                return f(x) / (Own{2, 0} + of(u, std::sin(u.v), std::cos(u.v)));
              }};
    case 4:
      return {fmt::format("max({}, {})", a.text, b.text), [=](Own x) {
                const Own u = f(x), w = g(x);
                return u.v >= w.v ? u : w;
              }};
    default:
      return {fmt::format("if({} < {}, {}, 2*{})", a.text, b.text, b.text, a.text), [=](Own x) {
                const Own u = f(x), w = g(x);
                return u.v < w.v ? w : Own{2, 0} * u;
              }};
  }
}

Expression of_one(Dice& dice, const Expression& a) {
  const auto f = a.value;
  const auto with = [&](const char* form, auto rule) {
    return Expression{fmt::format(fmt::runtime(form), a.text), [=](Own x) { return rule(f(x)); }};
  };
  const Own one{1, 0};
  switch (dice.upto(10)) {
    case 0:
      return with("sin({})", [](Own u) { return of(u, std::sin(u.v), std::cos(u.v)); });
    case 1:
      return with("exp(tanh({}))", [](Own u) {
        const long double h = std::tanh(u.v);
        return of(u, std::exp(h), std::exp(h) * (1 - h * h));
      });
    case 2:
      return with("log(1 + ({})^2)", [one](Own u) {
        const Own w = one + u * u;
        return of(w, std::log(w.v), 1 / w.v);
      });
    case 3:
      return with("sqrt(1 + ({})^2)", [one](Own u) {
        const Own w = one + u * u;
        return of(w, std::sqrt(w.v), 0.5L / std::sqrt(w.v));
      });
    case 4:
      return with("abs({})", [](Own u) { return u.v >= 0 ? u : Own{-u.v, -u.d}; });
    case 5:
      return with("atan({})/1 [rad]", [](Own u) { return of(u, std::atan(u.v), 1 / (1 + u.v * u.v)); });
    case 6:
      return with("-({})^3", [](Own u) { return of(u, -u.v * u.v * u.v, -3 * u.v * u.v); });
    case 7:
      return with("(1.5 + cos({}))^2.5", [](Own u) {
        const long double b = 1.5L + std::cos(u.v);
        return of(u, std::pow(b, 2.5L), -2.5L * std::pow(b, 1.5L) * std::sin(u.v));
      });
    case 8:
      return with("min({}, 1)", [](Own u) { return u.v < 1 ? u : Own{1, 0}; });
    default:
      return with("2^tanh({})", [](Own u) {
        const long double h = std::tanh(u.v), f2 = std::pow(2.0L, h);
        return of(u, f2, f2 * std::log(2.0L) * (1 - h * h));
      });
  }
}

Expression random_expression(Dice& dice, int depth) {
  if (depth == 0) return leaf(dice);
  const Expression a = random_expression(dice, depth - 1);
  if (dice.upto(2) == 0) return of_one(dice, a);
  return of_two(dice, a, random_expression(dice, depth - 1));
}

TEST(Formula, ValuesAndSlopesOfAHundredRandomOnesAreThoseOfArithmeticAndOfDifferences) {
  int compared = 0, kinks = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    Dice dice(seed);
    const Expression e = random_expression(dice, 3);
    UnitError error;
    const auto read = read_formula(e.text, names_of_x(), error);
    ASSERT_TRUE(read) << e.text << ": " << error.text << " at " << error.column;
    std::vector<double> knots;
    if (read->formula.knots(-1.7, 2.3, knots)) continue;  // reported, e.g. where it grows beyond what can be computed
    const Curve curve = curve_of(e.text, -1.7, 2.3);
    kinks += static_cast<int>(curve.x().size()) - 2;
    for (std::size_t i = 0; i + 1 < curve.x().size(); ++i)
      for (const double part : {0.03, 0.31, 0.5, 0.77, 0.98}) {
        const double a = curve.x()[i], b = curve.x()[i + 1], x = a + part * (b - a);
        const Own exact = e.value({x, 1});
        const Dual<3> got = curve.value(Dual<3>::input(x, 1));
        const auto size = static_cast<double>(1 + std::abs(exact.v) + std::abs(exact.d));
        EXPECT_NEAR(got.value, static_cast<double>(exact.v), 1e-12 * size) << e.text << " at " << x;
        EXPECT_NEAR(got.d[1], static_cast<double>(exact.d), 1e-11 * size) << e.text << " at " << x;
        EXPECT_EQ(got.d[0], 0);
        // Differences of fourth order, within the piece.
        const double h = 1e-4 * (b - a);
        const auto y = [&](double places) { return curve.value_in(static_cast<int>(i), x + places * h); };
        const double slope = (8 * (y(1) - y(-1)) - (y(2) - y(-2))) / (12 * h);
        EXPECT_NEAR(slope, got.d[1], 1e-6 * size + 1e-14 * size / h) << e.text << " at " << x;
        ++compared;
      }
  }
  EXPECT_GT(compared, 400);
  EXPECT_GT(kinks, 30);
}

// Of functions of several values: against the C library and its derivatives, on a curve all round the origin.
TEST(Formula, DirectionAndLengthOfAPointAreThoseOfTheLibrary) {
  // (x, y) = (cos u + 0.3, 1.2 sin u − 0.1) encircles the origin.
  const std::string px = "(cos(x) + 0.3)", py = "(1.2*sin(x) - 0.1)";
  const Curve direction = curve_of(fmt::format("atan2({}, {})/1 [rad]", py, px), -2.9, 4.5);
  const Curve length = curve_of(fmt::format("hypot({}, {})", px, py), -2.9, 4.5);
  EXPECT_TRUE(direction.jumps());
  for (double u = -2.87; u < 4.5; u += 0.0713) {
    const long double a = std::cos(static_cast<long double>(u)) + 0.3L,
                      b = 1.2L * std::sin(static_cast<long double>(u)) - 0.1L;
    const long double a1 = -std::sin(static_cast<long double>(u)), b1 = 1.2L * std::cos(static_cast<long double>(u));
    const Dual<3> w = direction.value(Dual<3>::input(u, 1)), r = length.value(Dual<3>::input(u, 1));
    EXPECT_NEAR(w.value, static_cast<double>(std::atan2(b, a)), 1e-14) << u;
    EXPECT_NEAR(w.d[1], static_cast<double>((a * b1 - b * a1) / (a * a + b * b)), 1e-13) << u;
    EXPECT_NEAR(r.value, static_cast<double>(std::hypot(a, b)), 1e-14) << u;
    EXPECT_NEAR(r.d[1], static_cast<double>((a * a1 + b * b1) / std::hypot(a, b)), 1e-13) << u;
  }
  for (const double y : {-2.0, -0.0, 0.0, 1.0})
    for (const double x : {-3.0, -1.0, 0.0, 2.0})
      if (x != 0 || y != 0) {
        const std::string text = fmt::format("atan2({}, {})/1 [rad] + 0*x", y, x);
        EXPECT_NEAR(curve_of(text, 0, 1).value(0.5), std::atan2(y == 0 ? 0.0 : y, x), 1e-15) << text;
      }
  EXPECT_NE(fault_of("atan2(0, 0)/1 [rad] + x", 0, 1).find("division by 0"), std::string::npos);
}

TEST(Formula, ClampHoldsBetweenItsEnds) {
  const Curve c = curve_of("clamp(x^3, -1, 8)", -3, 3);
  ASSERT_EQ(c.x().size(), 4u);
  EXPECT_NEAR(c.x()[1], -1, 1e-15);
  EXPECT_NEAR(c.x()[2], 2, 1e-15);
  EXPECT_EQ(c.value(-2.0), -1);
  EXPECT_EQ(c.value(1.5), 3.375);
  EXPECT_EQ(c.value(2.5), 8);
}

TEST(Formula, KinksAndJumpsAreFoundToTheLastDigit) {
  const Curve rectified = curve_of("abs(sin(x))", 1, 10);
  ASSERT_EQ(rectified.x().size(), 5u);
  for (std::size_t k = 1; k <= 3; ++k) EXPECT_NEAR(rectified.x()[k], static_cast<double>(k) * std::numbers::pi, 1e-14);
  const Curve step = curve_of("if(x^2 > 2, 5, x)", 0, 3);
  ASSERT_EQ(step.x().size(), 3u);
  EXPECT_NEAR(step.x()[1], std::sqrt(2.0), 4e-16);
  EXPECT_EQ(step.value(1.5), 5);
  EXPECT_EQ(step.value(1.4), 1.4);
  EXPECT_TRUE(step.jumps());
  EXPECT_FALSE(rectified.jumps());
}

// A branch that is constant has the slope 0, whatever is made of it: never NaN, where 0 vⁿ⁻¹ of a base 0 is 0·∞.
TEST(Formula, WhatIsConstantOnItsPieceHasNoSlope) {
  for (const std::string zero : {"min(0, x)", "max(0, -x)", "clamp(x, -2, 0)", "if(x >= -1, 0, 3 + x)", "0*x"})
    for (const char* of : {"({})^0",           "({})^log10(1)", "(2*{})^0",
                           "({})^1",           "({})^2",        "({})^3",
                           "({})^1.5",         "({})^2.5",      "abs({})",
                           "sign({})",         "step({})",      "sin({})",
                           "cos({})",          "tan({})",       "asin({})",
                           "acos({})",         "atan({})",      "tanh({})",
                           "exp({})",          "log(1 + {})",   "log10(({})^0)",
                           "sqrt(1 + {})",     "(1 + {})^-2",   "1/(1 + {})",
                           "hypot({}, 1)",     "max({}, 1)",    "atan2({}, 1)/1 [rad]",
                           "(({0})^0)^({0})^0"}) {
      const std::string text = fmt::format(fmt::runtime(of), zero);
      const Dual<1> got = curve_of(text, 0.1, 1).value(Dual<1>::input(0.3, 0));
      EXPECT_TRUE(std::isfinite(got.value)) << text;
      EXPECT_EQ(got.d[0], 0) << text;
    }
  for (const double x : {-0.5, 0.0, 0.7}) EXPECT_EQ(curve_of("x^0", -1, 1).value(Dual<1>::input(x, 0)).d[0], 0) << x;
}

// By its nodes, which look for kinks and give values where it is read, and by its pieces, which run.
TEST(Formula, NodesAndPiecesComputeTheSameOfAnglesOfManyTurns) {
  for (const char* text : {"cos(x + 1e11)", "sin(x - 7^exp(2.6))", "cos(x + 1e9)", "sin(1e9*x)", "tan(x + 1e9)"}) {
    UnitError error;
    const auto read = read_formula(text, names_of_x(), error);
    ASSERT_TRUE(read) << text;
    for (double x = 0.01; x < 1; x += 0.0917) {
      double by_nodes = 0;
      ASSERT_FALSE(read->formula.value(x, by_nodes)) << text;
      EXPECT_EQ(read->formula.program(0.01, 1)(x), by_nodes) << text << " at " << x;
    }
  }
}

TEST(Formula, WhatOnlyTouchesZeroHasNoKink) {
  EXPECT_EQ(curve_of("abs(x^2)", -1, 1).x().size(), 2u);
  EXPECT_EQ(curve_of("abs((x - 0.3)^2)", -1, 1).x().size(), 2u);
  EXPECT_EQ(curve_of("max(0, if(x < 1, 0, x - 1))", 0, 2).x().size(), 3u);
}

// Where a branch touches what it is compared with, right in the middle of its piece, its answer is that beside it.
TEST(Formula, ABranchThatTouchesInTheMiddleIsTheOneBesideIt) {
  for (const char* text :
       {"max(0, x^2)", "max(0, x^20)", "clamp(x^2, 0, 9)", "if(x^2 > 0, x^2, 0)", "0 - min(-x^2, 0)"}) {
    const Curve c = curve_of(text, -1, 1);
    const double power = std::string(text).find("20") == std::string::npos ? 2 : 20;
    for (const double x : {-0.9, -0.3, 0.2, 0.8}) EXPECT_NEAR(c.value(x), std::pow(x, power), 1e-15) << text;
  }
  const Curve shifted = curve_of("max(1, 1 + x^20)", -1, 1);  // the same to the last digit over a part of its piece
  EXPECT_NEAR(shifted.value(0.9), 1 + std::pow(0.9, 20), 1e-15);
}

// Hertz: F = k d^1.5 in contact, nothing apart; its root is evaluated where there is contact only.
TEST(Formula, ABranchThatIsNotTakenNeedNoValue) {
  const Curve hertz = curve_of("if(x > 2, (x - 2)^1.5, 0)", 0, 4);
  EXPECT_EQ(hertz.value(1.0), 0);
  EXPECT_NEAR(hertz.value(3.0), 1, 1e-15);
  EXPECT_NEAR(curve_of("if(x >= 1, log(x), 0)", -5, 5).value(std::numbers::e), 1, 1e-15);
}

TEST(Formula, LeavingItsDomainIsReportedBeforeAnyRun) {
  EXPECT_NE(fault_of("1/x", -1, 1).find("division by 0"), std::string::npos);
  EXPECT_NE(fault_of("max(x - 1, x/x)", -2, 2).find("division by 0"), std::string::npos);  // at the middle of its range
  EXPECT_EQ(fault_of("if(x > 0, 1/x, 0)", -2, 2), "");                                     // not on the branch taken
  EXPECT_EQ(fault_of("if(sqrt(x) > 1, 1, x)", 0, 3), "");
  EXPECT_NE(fault_of("1/(x - 0.3)", -1, 1).find("division by 0"), std::string::npos);
  EXPECT_NE(fault_of("log(x)", -1, 1).find("logarithm of -1"), std::string::npos);
  EXPECT_NE(fault_of("sqrt(1 - x)", 0, 2).find("root of -"), std::string::npos);
  EXPECT_NE(fault_of("sqrt(x)", 0, 2).find("infinite slope"), std::string::npos);
  EXPECT_NE(fault_of("x^0.5", 0, 2).find("infinite slope"), std::string::npos);
  EXPECT_NE(fault_of("(x^3 + 2)^1.5", -2, 2).find("to the power of 1.5"), std::string::npos);
  EXPECT_NE(fault_of("tan(x)", 0, 2).find("pole of tan"), std::string::npos);
  EXPECT_NE(fault_of("cos(x + 1e3^7)", 0, 2).find("cos of 1e+21 rad, beyond ± 1e+12"), std::string::npos);
  EXPECT_NE(fault_of("asin(x)", 0, 1.5).find("asin of"), std::string::npos);
  EXPECT_NE(fault_of("exp(x)", 0, 1000).find("exp of"), std::string::npos);
  EXPECT_NE(fault_of("1e20*x^10", 0, 1e3).find("beyond"), std::string::npos);
  // What is compared with something is refused as it is alone.
  EXPECT_NE(fault_of("min(log10(x*x), 0.5)", -2, 3).find("an infinite value"), std::string::npos);
  EXPECT_NE(fault_of("abs(asin(sin(x)))/1 [rad]", 0, 3).find("an infinite slope"), std::string::npos);
  EXPECT_NE(fault_of("max(sqrt(x^2), -1) - x", -2, 3).find("an infinite slope"), std::string::npos);
  EXPECT_EQ(fault_of("if(sqrt(x^2) > 1, x, 1)", -2, 3), "");
  EXPECT_EQ(fault_of("max(sqrt(x^2), 0.1) - x", -2, 3), "");  // nothing of it is left where its slope is infinite
  EXPECT_EQ(fault_of("x^1.5", 0, 2), "");
  EXPECT_EQ(fault_of("1/(x - 0.3)", 0.31, 1), "");
}

TEST(Formula, TrialStepsBeyondAPieceGoOnStraight) {
  const Curve c = curve_of("if(x < 1, x^1.5, 2 - x)", 0, 2);
  EXPECT_NEAR(c.value_in(0, 1.5), 1 + 1.5 * 0.5, 1e-15);
  EXPECT_NEAR(c.value_in(1, 0.5), 1.5, 1e-15);
  EXPECT_EQ(c.value_in(0, -0.5), 0);
  EXPECT_EQ(c.value(-3.0), 0);
  EXPECT_EQ(c.value(7.0), 0);
}

TEST(Formula, PowersBindToTheRightAndTighterThanASign) {
  EXPECT_EQ(curve_of("2^3^2 + 0*x", 0, 1).value(0.5), 512);
  EXPECT_EQ(curve_of("-x^2", 0, 3).value(2.0), -4);
  EXPECT_EQ(curve_of("2^-1*x", 0, 3).value(2.0), 1);
  EXPECT_EQ(curve_of("8/2/2 - 1 - 1 + 0*x", 0, 1).value(0.5), 0);
}

TEST(Formula, UnitsGoThroughEveryOperation) {
  UnitError error;
  const auto force = read_formula("p0*A*(s0/(s0 + x*1 m))^n", names_of_x(), error);
  ASSERT_TRUE(force) << error.text << " at " << error.column;
  EXPECT_EQ(name_of(force->dimension), "a force (N)");
  const auto speed = read_formula("sqrt(2*p0/(850 [kg/m3]))", names_of_x(), error);
  ASSERT_TRUE(speed) << error.text;
  EXPECT_EQ(name_of(speed->dimension), "a velocity (m/s)");
  EXPECT_NEAR(curve_of("5 mm/(1 m) + x", 0, 1).value(0.0), 0.005, 1e-18);
}

// --- sixty wrong ones ---

struct Wrong {
  const char* text;
  std::size_t column;
  const char* words;
};

const Wrong wrong_ones[] = {
    {"", 0, "ends where a number"},
    {"   ", 3, "ends where a number"},
    {"x +", 3, "ends where a number"},
    {"x + * 2", 4, "unexpected \"*\""},
    {"x 2", 2, "unexpected \"2\""},
    {"(x + 2", 0, "not closed"},
    {"x + 2)", 5, "unexpected \")\""},
    {"2*(x + (3)", 2, "not closed"},
    {"sin(x", 3, "not closed"},
    {"sin x", 0, "is a function"},
    {"sin", 0, "is a function"},
    {"sin()", 4, "unexpected \")\""},
    {"sin(x, 2)", 0, "sin of 2 values"},
    {"min(x)", 0, "min of 1 value"},
    {"max()", 4, "unexpected \")\""},
    {"sinn(x)", 0, "did you mean \"sin\"?"},
    {"system(x)", 0, "unknown function \"system\""},
    {"y + 1", 0, "unknown name \"y\""},
    {"2 N*m*y", 4, "; a unit of several parts is written in brackets"},
    {"1 + PO", 4, "unknown name \"PO\""},
    {"pO*A", 0, "did you mean \"p0\"?"},
    {"2 x", 2, "write 2 * x"},
    {"3 pi", 2, "write 3 * pi"},
    {"2 n*x", 2, "write 2 * n"},
    {"5 mmm", 2, "unknown unit"},
    {"5 [kN*mm/rd]", 9, "unknown unit \"rd\""},
    {"5 [kN", 2, "bracket is not closed"},
    {"5 [N**m]", 5, "unexpected"},
    {"2 m^2", 3, "2 [m^…]"},
    {"1e400", 0, "out of range"},
    {"1..2", 2, "unexpected"},
    {".", 0, "no number"},
    {"1,5*x", 1, "unexpected comma"},
    {"x − 1", 2, "plain \"-\""},
    {"x ** 2", 3, "unexpected \"*\""},
    {"x = 2", 2, "unexpected \"=\""},
    {"x; 2", 1, "unexpected \";\""},
    {"`ls`", 0, "unexpected"},
    {"$(x)", 0, "unexpected \"$\""},
    {"x[1]", 1, "unexpected \"[\""},
    {"x^", 2, "ends where a number"},
    {"x^(1 m)", 2, "an exponent of a length"},
    {"(1 m)^x", 5, "a length (m) to a power that varies"},
    {"p0 + A", 3, "cannot add a pressure (Pa) and an area (m²)"},
    {"1 + 2*s0", 2, "cannot add a plain number and a length"},
    {"s0 - 1 s", 3, "cannot subtract a length (m) and a time"},
    {"sin(1 m)", 4, "must be of an angle or a plain number"},
    {"exp(s0)", 4, "must be of a plain number"},
    {"log(2 [1/s])", 4, "must be of a plain number"},
    {"atan(1 rad)", 5, "must be of a plain number"},
    {"max(x, s0)", 7, "cannot compare a plain number and a length"},
    {"atan2(x)", 0, "atan2 of 1 value; must be two: y, x"},
    {"hypot(x, s0)", 9, "cannot compare a plain number and a length"},
    {"clamp(x, 1)", 0, "must be three: what, least, greatest"},
    {"clamp(x, 2, 1)", 0, "must not exceed the greatest"},
    {"if(x, 1, 2)", 4, "expected a comparison"},
    {"if(x < s0, 1, 2)", 5, "cannot compare"},
    {"if(x < 1, 2)", 11, "expected a comma"},
    {"if(x < 1, s0, A)", 14, "alternatives of a length (m) and an area"},
    {"if(x < 1, 2, 3", 2, "not closed"},
    {"x < 1", 2, "unexpected \"<\""},
    {"1/0", 1, "division by 0"},
    {"log(-2)", 0, "logarithm of -2"},
    {"sqrt(2 - 3)", 0, "root of -1"},
    {"(-8)^0.5", 4, "-8 to the power of 0.5"},
    {"asin(2)", 0, "asin of 2"},
    {"1e20^2", 4, "beyond"},
    {"((((((((((((((((((((((((((((((((((x))))))))))))))))))))))))))))))))))", 33, "nested more than 32 deep"},
};

TEST(Formula, SixtyWrongOnesAreReportedWithTheirColumn) {
  EXPECT_GE(std::size(wrong_ones), 60u);
  for (const Wrong& wrong : wrong_ones) {
    UnitError error;
    EXPECT_FALSE(read_formula(wrong.text, names_of_x(), error)) << wrong.text;
    EXPECT_EQ(error.column, wrong.column) << wrong.text << ": " << error.text;
    EXPECT_NE(error.text.find(wrong.words), std::string::npos) << wrong.text << ": " << error.text;
  }
}

TEST(Formula, LengthAndDepthAreBounded) {
  UnitError error;
  EXPECT_FALSE(read_formula(std::string(5000, '('), names_of_x(), error));
  EXPECT_NE(error.text.find("more than 2000 characters"), std::string::npos);
  EXPECT_FALSE(read_formula(std::string(1900, '-') + "x", names_of_x(), error));
  std::string abs_of_abs = "x";
  for (int k = 0; k < 30; ++k) abs_of_abs = "abs(" + abs_of_abs + " - 0.1)";
  EXPECT_NEAR(curve_of(abs_of_abs, 5, 6).value(5.5), 5.5 - 3.0, 1e-12);  // no doubling of the work per level
  std::string right = "x";
  for (int k = 0; k < 31; ++k) right = "1*x + 1*(" + right + ")";
  EXPECT_FALSE(read_formula(right, names_of_x(), error));
  EXPECT_NE(error.text.find("values at once"), std::string::npos) << error.text;
  EXPECT_NE(fault_of("abs(sin(1/x))", 1e-9, 1), "");
}

}  // namespace
}  // namespace kurbel::formula_test
