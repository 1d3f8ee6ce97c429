// holding.h — torque reserve of closed clutches and limiters.
//
//     torque_reserve = M_s/max |τ|     τ: transmitted while it is closed for good and does not slip; given if this
//                                      exceeds a millionth of M_s
#pragma once

#include <vector>

#include "studies/findings/result.h"

namespace kurbel {

// Largest torques held by clutches, located together with the other extremes.
std::vector<ExtremeOf> held_torques_of(const Model& model);
// From the held torques found in the run.
void report_reserves(const Model& model, FigureReporter& report);

}  // namespace kurbel
