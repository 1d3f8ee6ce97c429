// quantity_reader.h — reads one number of a scene file and checks its unit, its domain and its size.
#pragma once

#include <cmath>
#include <string>

#include "engine/scene/document.h"
#include "engine/scene/keys.h"
#include "engine/scene/units.h"

namespace kurbel {

// Allowed sizes in SI units: products and quotients of ten such values are still finite (1e±300).
inline constexpr double least_size = 1e-30, greatest_size = 1e30;

inline bool is_number(const DocumentValue& v) {
  return v.type == DocumentValue::Type::integer || v.type == DocumentValue::Type::number;
}
inline bool is_whole(const DocumentValue& v) { return is_number(v) && v.number == std::floor(v.number); }  // 1e3 is

// Value in SI of a text such as "4 kN*m"; false with a message if it is invalid or has another dimension than `unit`.
bool read_quantity(const DocumentValue& value, const std::string& unit, const Domain& domain, const std::string& what,
                   Messages& messages, double& result);

// A value with any unit; 1, with a message, if it is invalid.
Quantity read_constant(const DocumentValue& value, const std::string& what, Messages& messages);

// The allowed size of a value in SI, in addition to its domain, to avoid over- and underflow; empty: it is satisfied.
std::string size_allowed(double value, const Dimension& dimension, const Domain& domain);

// Location of a fault within a text in quotes, by the number of bytes before it.
Location place_within(const DocumentValue& text, std::size_t bytes);

}  // namespace kurbel
