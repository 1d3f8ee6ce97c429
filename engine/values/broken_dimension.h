// broken_dimension.h — dimensions within a formula, with fractional exponents for roots.
#pragma once

#include <array>
#include <string>

#include "engine/scene/units.h"

namespace kurbel {

// Exponents of kilogram, metre, second, radian, ampere; halves for roots.
using BrokenDimension = std::array<double, 5>;
inline constexpr BrokenDimension plain_number{};

BrokenDimension broken(const Dimension& dimension);
bool same_dimension(const BrokenDimension& a, const BrokenDimension& b);
std::string name_of(const BrokenDimension& dimension);

}  // namespace kurbel
