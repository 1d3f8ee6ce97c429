// torque_history.h — a torque of the simulated scene over time, and what it is made of.
#pragma once

#include "studies/modes/modes.h"

namespace kurbel {

// The model's scene run as an elastic machine with these effects, with samples enough for swings of up to `highest`
// [rad/s]; spectrum, orders and load cycles of the torque that `options` name. Throws std::invalid_argument where the
// scene has no such torque.
TorqueHistory simulate_torque(const Model& model, const Effects& effects, double highest, const ModesOptions& options);

}  // namespace kurbel
