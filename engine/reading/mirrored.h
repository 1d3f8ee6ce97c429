// mirrored.h — a periodic table whose first half turn is the mirror image of its last.
//
//     f*(x) = ± f(c − x)   for 0 ≤ x < π,   else f(x)        with the period c ≥ 2π       (theory 4.19)
// The diagram of a misfiring cylinder: from top dead centre at 0 the charge expands along its compression curve. A pressure
// is even, a torque odd.
#pragma once

#include <string>

#include "engine/scene/keys.h"

namespace kurbel {

// If both parts differ at π, the table has a jump. Throws std::invalid_argument for a formula, and as CurveData::curve().
CurveData first_half_turn_mirrored(const CurveData& data, double period, bool odd);
// Text: the mirrored diagram replaces the one of a key.
std::string words_of_mirrored(const std::string& whose, const std::string& key);

}  // namespace kurbel
