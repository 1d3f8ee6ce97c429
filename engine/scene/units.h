// units.h — quantities as engineers write them ("1500 rpm", "4 kN*m/rad") and their values in SI.
//
// The angle is a dimension of its own: "4 kN*m" is a torque and no torsional stiffness, "5 1/s" is no angular velocity.
// One habit is heeded: where a speed is asked for, what is counted per minute or in Hz are turns. "60 1/min" is 60 rpm,
// "1 Hz" is 1 rev/s; "1/s" may mean turns or radians, and stays refused.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kurbel {

// Exponents of kilogram, metre, second, radian, ampere.
struct Dimension {
  std::array<int, 5> exponent{};
  friend bool operator==(const Dimension&, const Dimension&) = default;
};

struct Unit {
  double factor = 1;  // value in SI = factor · value in this unit
  Dimension dimension;
  bool counted = false;  // written with min or Hz: where it is a frequency, people count turns by it
};

struct Quantity {
  double value = 0;  // SI
  Dimension dimension;
  bool counted = false;
  std::size_t unit_at = 0;  // where in its text the unit begins, or blanks before it
};

// What was wrong in a quantity's text, and at which column of it (0-based).
struct UnitError {
  std::string text;
  std::size_t column = 0;
};

// "kN*m/rad", "kg m2", "kg·m²", "N*m*s/rad", "1/s", "°", "". Factors are joined by *, · or a blank; / divides by the
// next factor alone; exponents as ^2, 2, ², ^-1.
std::optional<Unit> parse_unit(std::string_view text, UnitError& error);

// "1500 rpm" → 157.08 rad/s. The number comes first, or a fraction as "1/80"; a missing unit is a dimensionless
// quantity.
std::optional<Quantity> parse_quantity(std::string_view text, UnitError& error);

// Where a speed is wanted: a frequency that is counted in Hz or per minute becomes one of whole turns. All else is as it
// was.
Quantity wanted_as(Quantity quantity, const Dimension& wanted);
Unit wanted_as(Unit unit, const Dimension& wanted);

// Where a unit of mass stands in a unit that were the wanted one, if it were a force: "; "lb" is a mass — did you mean
// "lbf"?". Else nothing.
std::string force_meant(std::string_view unit, const Dimension& got, const Dimension& wanted);

// A unit in which values of this dimension are commonly written, for messages: "rad/s" → "rpm, rad/s, deg/s".
std::string examples_of(std::string_view si_unit);

// What a dimension is, for messages: "a torque (N·m)", "a plain number".
std::string name_of(const Dimension& dimension);

// 1234.5, "N*m" → "1234.5 N·m"; six significant digits unless told.
std::string with_unit(double value, std::string_view unit, int digits = 6);

// "N*m*s/rad" → "N·m·s/rad", for people.
std::string pretty_unit(std::string_view unit);

// The candidate nearest to `word` by edit distance, if it is near enough to be a slip of the pen.
std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace kurbel
