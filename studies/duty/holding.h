// holding.h — with how much reserve closed clutches and limiters hold.
//
//     torque_reserve = M_s/max |τ|     τ: what it transmits while it is closed for good and does not slip; told where that
//                                      is more than a millionth of M_s
#pragma once

#include <vector>

#include "studies/findings/result.h"

namespace kurbel {

// Largest torques that clutches hold, to be looked for along with the others.
std::vector<ExtremeOf> held_torques_of(const Model& model);
// From those that the run is known to have held.
void tell_reserves(const Model& model, FigureTeller& tell);

}  // namespace kurbel
