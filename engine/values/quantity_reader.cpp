// quantity_reader.cpp — what is wrong with a number, and what is allowed.
#include "engine/values/quantity_reader.h"
#include "engine/scene/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace kurbel {
namespace {

using Type = DocumentValue::Type;

// An angle's last digit is 1e-7 rad here.
constexpr double greatest_angle = 1e9;

// A number and its unit for people: "-3 kN*m/rad" → "-3 kN·m/rad".
std::string pretty_quantity(const DocumentValue& value) {
  if (value.type != Type::text) return value.describe();
  const std::size_t unit = std::min(value.text.find(' '), value.text.size());
  return value.text.substr(0, unit) + pretty_unit(value.text.substr(unit));
}

// What may stand in place of a value that was refused: "4 kN*m/rad", 0.05.
std::string write_instead(const std::string& unit) { return "write e.g. " + examples_of(unit); }

// "4 kN*m" for a stiffness: says what it is, what it must be, and where only the angle is missing or too many.
std::string wrong_dimension(const DocumentValue& value, const Quantity& got, const Unit& wanted,
                            const std::string& unit) {
  if (got.dimension == Dimension{}) return fmt::format("{} has no unit; {}", value.describe(), write_instead(unit));
  Dimension without_angle = got.dimension, wanted_without = wanted.dimension;
  without_angle.exponent[3] = wanted_without.exponent[3] = 0;
  return fmt::format(
      "{} is {}; must be {}, e.g. {}{}{}", value.describe(), name_of(got.dimension), name_of(wanted.dimension),
      examples_of(unit),
      without_angle == wanted_without && !unit.empty() ? " (the angle counts as a dimension: rad, deg, rev)" : "",
      value.type == Type::text ? force_meant(value.text, got.dimension, wanted.dimension) : "");
}

}  // namespace

Location place_within(const DocumentValue& text, std::size_t bytes) {
  return {text.at.line, text.at.column + 1 + static_cast<int>(characters(text.text.substr(0, bytes)))};
}

bool read_quantity(const DocumentValue& value, const std::string& unit, const Domain& domain, const std::string& what,
                   Messages& messages, double& result) {
  const auto refuse = [&](Location at, const std::string& text) {
    messages.add(at, fmt::format("{} = {}", what, text));
    return false;
  };
  if (is_number(value)) {
    if (!std::isfinite(value.number)) return refuse(value.at, fmt::format("{}; must be finite", value.describe()));
    if (!unit.empty())
      return refuse(value.at,
                    fmt::format("{} has no unit; write it with one, e.g. {}", value.describe(), examples_of(unit)));
    result = value.number;
  } else if (value.computed) {
    if (value.computed->faulty) return false;
    UnitError error;
    const auto wanted = parse_unit(unit, error);
    const Quantity& got = value.computed->quantity;
    if (got.dimension != wanted->dimension && !value.computed->zero)
      return refuse(value.at, wrong_dimension(value, got, *wanted, unit));
    result = got.value;
  } else if (value.type == Type::text) {
    UnitError error;
    const auto wanted = parse_unit(unit, error);
    auto quantity = parse_quantity(value.text, error);
    if (!quantity) {
      const bool suggests = error.text.ends_with('?');
      return refuse(place_within(value, error.column),
                    fmt::format("{}: {}{}", value.describe(), error.text, suggests ? "" : "; " + write_instead(unit)));
    }
    quantity = wanted_as(*quantity, wanted->dimension);
    if (quantity->dimension != wanted->dimension)
      return refuse(value.at, wrong_dimension(value, *quantity, *wanted, unit));
    result = quantity->value;
  } else {
    return refuse(value.at,
                  fmt::format("{}; must be {}, e.g. {}", value.describe(),
                              unit.empty() ? "a number" : "a number with its unit in quotes", examples_of(unit)));
  }
  if (!domain.contains(result))
    return refuse(value.at, fmt::format("{}; must be {}", pretty_quantity(value), domain.describe(unit)));
  UnitError none;
  if (const std::string allowed = size_allowed(result, parse_unit(unit, none)->dimension, domain); !allowed.empty())
    return refuse(value.at,
                  fmt::format("{}; must be {}; check its unit and power of ten", pretty_quantity(value), allowed));
  return true;
}

Quantity read_constant(const DocumentValue& value, const std::string& what, Messages& messages) {
  const auto refuse = [&](Location at, const std::string& text) {
    messages.add(at, fmt::format("{} = {}", what, text));
    return Quantity{1, {}};
  };
  if (value.computed) return value.computed->faulty ? Quantity{1, {}} : value.computed->quantity;
  Quantity got;
  if (is_number(value)) {
    got.value = value.number;
  } else if (value.type == Type::text) {
    UnitError error;
    const auto quantity = parse_quantity(value.text, error);
    if (!quantity)
      return refuse(place_within(value, error.column), fmt::format("{}: {}", value.describe(), error.text));
    got = *quantity;
  } else {
    return refuse(value.at, fmt::format("{}; must be a number, with its unit in quotes", value.describe()));
  }
  if (!(std::abs(got.value) <= greatest_size))
    return refuse(value.at, fmt::format("{}; must be within ± {:g} in SI units", value.describe(), greatest_size));
  return got;
}

std::string size_allowed(double value, const Dimension& dimension, const Domain& domain) {
  const double size = std::abs(value);
  const bool angle = dimension == Dimension{{0, 0, 0, 1, 0}};
  if (angle && size > greatest_angle) return fmt::format("within ± {:g} rad", greatest_angle);
  if (size > greatest_size) return fmt::format("within ± {:g} in SI units", greatest_size);
  const bool is_place = angle && domain.contains(0);  // on a turn, which nothing is divided by
  if (size > 0 && size < least_size && !is_place)
    return domain.contains(0) ? fmt::format("0 or of a size of {:g} or more in SI units", least_size)
                              : fmt::format("of a size of {:g} or more in SI units", least_size);
  return {};
}

}  // namespace kurbel
