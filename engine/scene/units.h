// units.h — quantities as engineers write them ("1500 rpm", "4 kN*m/rad") and their values in SI.
//
// The angle is a separate dimension: "4 kN*m" is a torque and not a torsional stiffness, "5 1/s" is not an angular velocity.
// As is customary, frequencies per minute or in Hz given for a speed are turns: "60 1/min" is 60 rpm, "1 Hz" is 1 rev/s;
// "1/s" could mean turns or radians and is rejected. A motor's constant may be a torque per current or a voltage per speed:
// "0.9 N*m/A" = "0.9 V*s/rad".
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
  bool counted = false;  // written with min or Hz: as a speed it counts turns
};

struct Quantity {
  double value = 0;  // SI
  Dimension dimension;
  bool counted = false;
  std::size_t unit_at = 0;  // begin of the unit in its text, or of blanks before it
};

// A fault in a quantity's text with its column (0-based).
struct UnitError {
  std::string text;
  std::size_t column = 0;
};

// "kN*m/rad", "kg m2", "kg·m²", "N*m*s/rad", "1/s", "°", "". Factors are separated by *, · or a blank; / divides by the
// next factor only, which may be a product in brackets, "N*m/(rad/s)^2"; exponents as ^2, 2, ², ^-1.
std::optional<Unit> parse_unit(std::string_view text, UnitError& error);

// "1500 rpm" → 157.08 rad/s. The number comes first, or a fraction as "1/80"; a missing unit is a dimensionless
// quantity.
std::optional<Quantity> parse_quantity(std::string_view text, UnitError& error);

// If a speed is wanted, a frequency in Hz or per minute is converted to turns; if a torque per current is, a voltage per speed
// is it; other quantities are unchanged.
Quantity wanted_as(Quantity quantity, const Dimension& wanted);
Unit wanted_as(Unit unit, const Dimension& wanted);

// Hint if a unit would be the wanted one with a force instead of its unit of mass: "; "lb" is a mass — did you mean
// "lbf"?". Else empty.
std::string force_meant(std::string_view unit, const Dimension& got, const Dimension& wanted);

// Common units of this dimension, for messages: "rad/s" → "rpm, rad/s, deg/s".
std::string examples_of(std::string_view si_unit);

// Name of a dimension, for messages: "a torque (N·m)", "a plain number".
std::string name_of(const Dimension& dimension);

// 1234.5, "N*m" → "1234.5 N·m"; by default six significant digits.
std::string with_unit(double value, std::string_view unit, int digits = 6);

// "N*m*s/rad" → "N·m·s/rad", for reports.
std::string pretty_unit(std::string_view unit);

// The candidate nearest to `word` by edit distance, if it is near enough to be a typing error.
std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace kurbel
