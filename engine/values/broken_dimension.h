// broken_dimension.h — dimensions within a formula: of a root they may be of half a metre.
#pragma once

#include <array>
#include <string>

#include "engine/scene/units.h"

namespace kurbel {

// Exponents of kilogram, metre, second, radian, ampere: of a root they may be halves.
using BrokenDimension = std::array<double, 5>;
inline constexpr BrokenDimension plain_number{};

BrokenDimension broken(const Dimension& dimension);
bool same_dimension(const BrokenDimension& a, const BrokenDimension& b);
std::string name_of(const BrokenDimension& dimension);

}  // namespace kurbel
