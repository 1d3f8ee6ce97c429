// mirrored.h — a periodic table whose first half turn is the mirror image of its last.
//
//     f*(x) = ± f(c − x)   for 0 ≤ x < π,   else f(x)        with the period c ≥ 2π       (theory 4.19)
// The diagram of a cylinder that does not fire: from top dead centre at 0 on the charge expands as it was compressed. A
// pressure is even, a torque odd.
#pragma once

#include <string>

#include "engine/scene/keys.h"

namespace kurbel {

// Where both parts differ at π, the table jumps. Throws std::invalid_argument where it is a formula, and as
// CurveData::curve() does.
CurveData first_half_turn_mirrored(const CurveData& data, double period, bool odd);
// That it stands in for the diagram of a key.
std::string words_of_mirrored(const std::string& whose, const std::string& key);

}  // namespace kurbel
