// rest_position.h — rest position of a machine that oscillates about it: a pendulum, a rocking crank.
//
// At rest the angle is fixed: weights and loads that depend on it act as springs, K = −∂M/∂φ. For a pendulum
//     ω² = m g l/J
#pragma once

#include <memory>

#include "engine/linear/base_motion.h"
#include "engine/orbit/orbit.h"

namespace kurbel {

struct RestPosition {
  double angle = 0;                         // of the reduction link [rad]
  std::shared_ptr<const MeanMotion> orbit;  // of its rest; null: found by the torque only
};

// Some crank cannot turn fully, so that there is no mean over its angle.
bool has_rocking_crank(const Model& model);
// The machine comes to rest without static friction, and its torques depend on the angle.
bool rests_by_its_angle(const Model& model, const Orbit& orbit);

// The position of a steady motion at rest; else the position to which the torques drive the machine from its start:
// Σ M = 0 with ∂M/∂φ < 0. Throws std::invalid_argument if there is none.
RestPosition position_of_rest(const std::shared_ptr<const Model>& model, const Orbit& orbit);

}  // namespace kurbel
