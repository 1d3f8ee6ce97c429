// rest_place.h — where a machine stands that swings about its rest: a pendulum, a crank that rocks.
//
// At rest the angle is no average: weights and loads that hang on it are springs, K = −∂M/∂φ there. Of a pendulum
//     ω² = m g l/J
#pragma once

#include <memory>

#include "engine/linear/base_motion.h"
#include "engine/orbit/orbit.h"

namespace kurbel {

struct RestPlace {
  double angle = 0;                         // of the reduction link [rad]
  std::shared_ptr<const MeanMotion> orbit;  // that it comes to rest in; null: found by its torque alone
};

// Some crank never comes round, so that there is no mean over its angle.
bool has_rocking_crank(const Model& model);
// The machine comes to rest with nothing held by friction, and its torques hang on the angle.
bool rests_by_its_angle(const Model& model, const Orbit& orbit);

// The rest of a steady motion at rest; else where torques drive the machine to from its start: Σ M = 0 with ∂M/∂φ < 0. Throws
// std::invalid_argument in words where there is none.
RestPlace place_of_rest(const std::shared_ptr<const Model>& model, const Orbit& orbit);

}  // namespace kurbel
