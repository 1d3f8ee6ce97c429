// units.cpp — a table of units and a small parser over it.
#include "engine/scene/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "engine/numerics/angles.h"
#include "engine/scene/messages.h"
#include "engine/scene/text.h"

namespace kurbel {
namespace {

struct UnitEntry {
  std::string_view symbol;
  double factor;
  std::array<int, 5> exponent;  // kg m s rad A
  bool prefixes;                // takes SI prefixes (k, M, m, …)
};

// clang-format off
constexpr UnitEntry unit_table[] = {
    {"kg",   1,            {1, 0, 0, 0, 0}, false}, {"g",    1e-3,        {1, 0, 0, 0, 0}, false},
    {"t",    1000,         {1, 0, 0, 0, 0}, false}, {"lb",   0.45359237,  {1, 0, 0, 0, 0}, false},
    {"m",    1,            {0, 1, 0, 0, 0}, true},  {"in",   0.0254,      {0, 1, 0, 0, 0}, false},
    {"ft",   0.3048,       {0, 1, 0, 0, 0}, false}, {"s",    1,           {0, 0, 1, 0, 0}, true},
    {"min",  60,           {0, 0, 1, 0, 0}, false}, {"h",    3600,        {0, 0, 1, 0, 0}, false},
    {"Hz",   1,            {0, 0, -1, 0, 0}, true}, {"rad",  1,           {0, 0, 0, 1, 0}, true},
    {"deg",  pi / 180,     {0, 0, 0, 1, 0}, false}, {"°",    pi / 180,    {0, 0, 0, 1, 0}, false},
    {"rev",  2 * pi,       {0, 0, 0, 1, 0}, false}, {"rpm",  pi / 30,     {0, 0, -1, 1, 0}, false},
    {"N",    1,            {1, 1, -2, 0, 0}, true}, {"lbf",  4.4482216152605, {1, 1, -2, 0, 0}, false},
    {"kgf",  9.80665,      {1, 1, -2, 0, 0}, false},{"kp",   9.80665,     {1, 1, -2, 0, 0}, false},
    {"gf",   9.80665e-3,   {1, 1, -2, 0, 0}, false},{"ozf",  0.27801385095378125, {1, 1, -2, 0, 0}, false},
    {"daN",  10,           {1, 1, -2, 0, 0}, false},{"daNm", 10,          {1, 2, -2, 0, 0}, false},
    {"J",    1,            {1, 2, -2, 0, 0}, true}, {"Nm",   1,           {1, 2, -2, 0, 0}, true},
    {"W",    1,            {1, 2, -3, 0, 0}, true}, {"hp",   745.69987158227022, {1, 2, -3, 0, 0}, false},
    {"PS",   735.49875,    {1, 2, -3, 0, 0}, false},{"Pa",   1,           {1, -1, -2, 0, 0}, true},
    {"bar",  1e5,          {1, -1, -2, 0, 0}, true},{"psi",  6894.757293168361, {1, -1, -2, 0, 0}, false},
    {"A",    1,            {0, 0, 0, 0, 1}, true},  {"V",    1,           {1, 2, -3, 0, -1}, true},
    {"Ohm",  1,            {1, 2, -3, 0, -2}, true},{"Ω",    1,           {1, 2, -3, 0, -2}, true},
    {"Ω",    1,            {1, 2, -3, 0, -2}, true},  // the ohm sign; above the Greek letter
    {"H",    1,            {1, 2, -2, 0, -2}, true},{"l",    1e-3,        {0, 3, 0, 0, 0}, false},
    {"%",    0.01,         {0, 0, 0, 0, 0}, false}, {"1",    1,           {0, 0, 0, 0, 0}, false},
};
constexpr std::pair<std::string_view, double> prefix_table[] = {
    {"n", 1e-9}, {"u", 1e-6}, {"µ", 1e-6}, {"μ", 1e-6}, {"m", 1e-3}, {"c", 1e-2}, {"d", 1e-1}, {"k", 1e3}, {"M", 1e6}, {"G", 1e9},
};
// clang-format on

// The symbol as it stands, else with a prefix: "mm" is a millimetre, "min" a minute.
std::optional<Unit> look_up(std::string_view symbol) {
  for (const UnitEntry& entry : unit_table)
    if (entry.symbol == symbol) return Unit{entry.factor, {entry.exponent}};
  for (const auto& [prefix, scale] : prefix_table) {
    if (!symbol.starts_with(prefix)) continue;
    for (const UnitEntry& entry : unit_table)
      if (entry.prefixes && entry.symbol == symbol.substr(prefix.size()))
        return Unit{scale * entry.factor, {entry.exponent}};
  }
  return std::nullopt;
}

std::vector<std::string> all_symbols() {
  std::vector<std::string> symbols;
  for (const UnitEntry& entry : unit_table) symbols.emplace_back(entry.symbol);
  for (const char* common : {"mm", "cm", "kN", "kNm", "kW", "MW", "kPa", "MPa", "GPa", "ms", "kJ", "mH", "mrad"})
    symbols.emplace_back(common);
  return symbols;
}

// Reads one unit expression from left to right.
class UnitParser {
 public:
  UnitParser(std::string_view text, UnitError& error) : text_(text), error_(error) {}

  std::optional<Unit> parse() {
    std::optional<Unit> unit = read_product();
    if (unit && at_ < text_.size()) return fail_unexpected();  // a bracket that closes nothing
    return unit;
  }

 private:
  std::optional<Unit> fail(std::string text) {
    error_ = {std::move(text), at_};
    return std::nullopt;
  }
  std::optional<Unit> fail_unexpected() {
    if (text_[at_] == ',') return fail("unexpected comma; decimals are written with a point");
    return fail(fmt::format("unexpected {} in a unit", in_quotes(text_.substr(at_))));
  }
  bool take(std::string_view token) {
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    return true;
  }
  bool skip_blanks() {
    const std::size_t before = at_;
    while (take(" ") || take("\t") || take("\u00a0") || take("\u202f")) {
    }
    return at_ > before;
  }

  // Up to the end or to the bracket that closes.
  std::optional<Unit> read_product() {
    Unit product;
    int sign = 1;
    skip_blanks();
    while (!is_end_of_product()) {
      const std::optional<Unit> factor = read_factor();
      if (!factor) return std::nullopt;
      product.factor *= sign > 0 ? factor->factor : 1 / factor->factor;
      for (std::size_t i = 0; i < 5; ++i) product.dimension.exponent[i] += sign * factor->dimension.exponent[i];
      product.counted = product.counted || factor->counted;
      const bool blank = skip_blanks();
      if (is_end_of_product()) return product;
      if (take("/")) {
        sign = -1;
      } else if (take("*") || take("·") || take("⋅") || blank) {
        sign = 1;
      } else {
        return fail_unexpected();
      }
      skip_blanks();
      if (is_end_of_product()) return fail("the unit ends in an operator");
    }
    return product;
  }
  bool is_end_of_product() const { return at_ >= text_.size() || text_[at_] == ')'; }

  // "(rad/s)", without its exponent.
  std::optional<Unit> read_bracket() {
    const std::size_t begin = at_ - 1;
    if (in_bracket_) at_ = begin;
    if (in_bracket_ || (at_ < text_.size() && text_[at_] == ')')) return fail_unexpected();
    in_bracket_ = true;
    const std::optional<Unit> inner = read_product();
    in_bracket_ = false;
    if (!inner || take(")")) return inner;
    at_ = begin;
    return fail("a bracket is not closed");
  }
  std::optional<Unit> read_symbol() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_end_of_symbol()) ++at_;
    const std::string_view symbol = text_.substr(begin, at_ - begin);
    std::optional<Unit> unit = look_up(symbol);
    if (!unit) {
      at_ = begin;
      if (symbol.empty() || symbol[0] == ',') return fail_unexpected();
      const auto near = suggest(symbol);
      return fail(fmt::format("unknown unit {}{}", in_quotes(symbol),
                              near ? fmt::format(" — did you mean \"{}\"?", *near) : ""));
    }
    unit->counted = symbol == "min" || symbol.ends_with("Hz");
    return unit;
  }
  std::optional<Unit> read_factor() {
    if (take("1")) return Unit{};
    std::optional<Unit> unit = take("(") ? read_bracket() : read_symbol();
    if (!unit) return std::nullopt;
    const std::optional<int> power = read_exponent();
    if (!power) return fail("an exponent must be a whole number from -9 to 9");
    unit->factor = std::pow(unit->factor, *power);
    for (int& e : unit->dimension.exponent) e *= *power;
    return unit;
  }
  bool is_end_of_symbol() const {
    const std::string_view rest = text_.substr(at_);
    const char c = rest[0];
    return c == ' ' || c == '\t' || rest.starts_with("\u00a0") || rest.starts_with("\u202f") || c == '*' || c == '/' ||
           c == '^' || c == '-' || c == '+' || c == '(' || c == ')' || (c >= '0' && c <= '9') ||
           rest.starts_with("·") || rest.starts_with("⋅") || rest.starts_with("²") || rest.starts_with("³");
  }
  std::optional<int> read_exponent() {
    if (take("²")) return 2;
    if (take("³")) return 3;
    const bool caret = take("^");
    int power = 1;
    const auto [end, status] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), power);
    if (status == std::errc::invalid_argument) return caret ? std::nullopt : std::optional<int>(1);
    if (status != std::errc{} || std::abs(power) > 9) return std::nullopt;
    at_ = static_cast<std::size_t>(end - text_.data());
    return power;
  }

  // "kgm" is "kg*m" with its product sign forgotten; else the nearest symbol.
  static std::optional<std::string> suggest(std::string_view symbol) {
    for (std::size_t i = symbol.size() - 1; i > 0 && symbol.size() < 8; --i)
      if (look_up(symbol.substr(0, i)) && look_up(symbol.substr(i)))
        return fmt::format("{}*{}", symbol.substr(0, i), symbol.substr(i));
    return symbol.size() < 20 ? nearest(symbol, all_symbols()) : std::nullopt;
  }

  std::string_view text_;
  UnitError& error_;
  std::size_t at_ = 0;
  bool in_bracket_ = false;
};

constexpr Dimension speed_dimension{{0, 0, -1, 1, 0}}, frequency_dimension{{0, 0, -1, 0, 0}};
constexpr Dimension torque_per_current{{1, 2, -2, 0, -1}}, voltage_per_speed{{1, 2, -2, -1, -1}};

// The number that the text begins with, an error if there is none.
std::optional<double> take_number(std::string_view text, std::size_t& at, UnitError& error) {
  double number = 0;
  const auto [end, status] = std::from_chars(text.data() + at, text.data() + text.size(), number);
  if (status != std::errc{}) {
    error = {status == std::errc::result_out_of_range ? "the number is out of range (1e-308 … 1e308)"
                                                      : "a number must come first",
             at};
    return std::nullopt;
  }
  if (!std::isfinite(number)) {
    error = {"the number must be finite", at};
    return std::nullopt;
  }
  at = static_cast<std::size_t>(end - text.data());
  return number;
}

// Behind "1" in "1/80": its divisor; 1 where no digit follows the stroke, which is the unit's then.
std::optional<double> take_divisor(std::string_view text, std::size_t& at, UnitError& error) {
  if (at + 1 >= text.size() || text[at] != '/' || text[at + 1] < '0' || text[at + 1] > '9') return 1;
  std::size_t digits = at + 1;
  const std::optional<double> divisor = take_number(text, digits, error);
  if (!divisor) return std::nullopt;
  if (*divisor == 0) {
    error = {"nothing can be divided by 0", at + 1};
    return std::nullopt;
  }
  at = digits;
  return divisor;
}

// How a unit's dimension is called, and how a value of it may be written; empty: by the unit alone.
struct UnitInWords {
  std::string_view unit, name, examples;
};
constexpr UnitInWords units_in_words[] = {
    {"rad/s", "an angular velocity", "\"1500 rpm\", \"157 rad/s\", \"25 rev/s\""},
    {"rad", "an angle", "\"30 deg\", \"0.5 rad\""},
    {"N*m/rad", "a torsional stiffness", "\"4 kN*m/rad\", \"70 N*m/deg\""},
    {"N*m*s/rad", "a torsional damping", "\"2 N*m*s/rad\""},
    {"kg*m2", "an inertia", "\"0.5 kg*m2\""},
    {"m", "a length", "\"120 mm\", \"0.12 m\""},
    {"kg", "a mass", "\"3 kg\""},
    {"s", "a time", "\"3 s\", \"20 ms\""},
    {"N*m", "a torque or energy", "\"200 N*m\", \"1.2 kN*m\""},
    {"N", "a force", "\"630 kN\""},
    {"W", "a power", "\"11 kW\", \"15 hp\""},
    {"Pa", "a pressure", "\"80 GPa\", \"6 bar\""},
    {"1/s", "a frequency", ""},
    {"m/s", "a velocity", ""},
    {"m/s2", "an acceleration", ""},
    {"kg/m3", "a density", ""},
    {"N/m", "a linear stiffness", ""},
    {"N*s/m", "a linear damping", ""},
    {"A", "a current", ""},
    {"V", "a voltage", ""},
    {"Ohm", "a resistance", ""},
    {"rad/s2", "an angular acceleration", ""},
    {"m2", "an area", ""},
    {"m3", "a volume", ""},
    {"N*m*s2/rad2", "", "\"0.02 N*m*s2/rad2\""},
    {"Hz", "", "\"5 Hz\""},
    {"", "", "0.05, \"5 %\""},
};

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Levenshtein, with a swap of neighbours counted as one slip.
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

}  // namespace

std::optional<Unit> parse_unit(std::string_view text, UnitError& error) { return UnitParser(text, error).parse(); }

std::optional<Quantity> parse_quantity(std::string_view text, UnitError& error) {
  std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) begin = text.size();
  std::size_t digits = begin;
  if (text.substr(begin).starts_with("\u2212")) {
    error = {"the minus sign must be the plain \"-\"", begin};
    return std::nullopt;
  }
  if (text.substr(begin).starts_with('+') && !text.substr(begin).starts_with("+-")) ++digits;  // unknown to from_chars
  std::size_t at = digits;
  const std::optional<double> number = take_number(text, at, error);
  if (!number) {
    error.column = begin;
    return std::nullopt;
  }
  const std::optional<double> divisor = take_divisor(text, at, error);
  if (!divisor) return std::nullopt;
  const std::optional<Unit> unit = parse_unit(text.substr(at), error);
  if (!unit) {
    error.column += at;
    return std::nullopt;
  }
  const double value = *number / *divisor * unit->factor;
  if (!std::isfinite(value)) {
    error = {"the number is out of range (1e-308 … 1e308)", begin};
    return std::nullopt;
  }
  return Quantity{value, unit->dimension, unit->counted, at};
}

Unit wanted_as(Unit unit, const Dimension& wanted) {
  if (wanted == torque_per_current && unit.dimension == voltage_per_speed) return {unit.factor, wanted};
  if (!unit.counted || wanted != speed_dimension || unit.dimension != frequency_dimension) return unit;
  return {2 * pi * unit.factor, wanted};
}

Quantity wanted_as(Quantity quantity, const Dimension& wanted) {
  const Unit unit = wanted_as(Unit{1, quantity.dimension, quantity.counted}, wanted);
  return {unit.factor * quantity.value, unit.dimension};
}

std::string force_meant(std::string_view unit, const Dimension& got, const Dimension& wanted) {
  Dimension as_force = got;
  as_force.exponent[1] += 1, as_force.exponent[2] -= 2;
  if (as_force != wanted) return {};
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  for (const std::string_view mass : {"lb", "kg", "g"})
    for (std::size_t at = unit.find(mass); at != std::string_view::npos; at = unit.find(mass, at + 1)) {
      const std::size_t end = at + mass.size();
      if ((at > 0 && is_letter(unit[at - 1])) || (end < unit.size() && is_letter(unit[end]))) continue;
      return fmt::format("; \"{0}\" is a mass — did you mean \"{0}f\"?", mass);
    }
  return {};
}

std::string examples_of(std::string_view si_unit) {
  for (const UnitInWords& words : units_in_words)
    if (words.unit == si_unit && !words.examples.empty()) return std::string(words.examples);
  return fmt::format("\"1 {}\"", si_unit);
}

std::string name_of(const Dimension& dimension) {
  if (dimension == Dimension{}) return "a plain number";
  UnitError error;
  for (const UnitInWords& named : units_in_words)
    if (!named.name.empty() && parse_unit(named.unit, error)->dimension == dimension)
      return fmt::format("{} ({})", named.name, pretty_unit(named.unit));
  static constexpr std::string_view base[] = {"kg", "m", "s", "rad", "A"};
  std::string text;
  for (std::size_t i = 0; i < 5; ++i) {
    const int e = dimension.exponent[i];
    if (e != 0) text += fmt::format("{}{}{}", text.empty() ? "" : "·", base[i], e == 1 ? "" : fmt::format("^{}", e));
  }
  return "a quantity in " + text;
}

std::string pretty_unit(std::string_view unit) {
  std::string pretty;
  for (const char c : unit) {
    if (c == '*') {
      pretty += "·";
    } else if (c == '^') {
      continue;
    } else if (c == '2') {
      pretty += "²";
    } else if (c == '3') {
      pretty += "³";
    } else {
      pretty += c;
    }
  }
  return pretty;
}

std::string with_unit(double value, std::string_view unit, int digits) {
  const std::string number = fmt::format("{:.{}g}", value, digits);
  return unit.empty() ? number : fmt::format("{} {}", number, pretty_unit(unit));
}

std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& candidates) {
  if (word.empty() || word.size() > 60) return std::nullopt;
  for (const std::string& candidate : candidates)
    if (equal_but_for_case(word, candidate)) return candidate;
  std::optional<std::string> best;
  std::size_t best_distance = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance && distance < candidate.size()) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace kurbel
