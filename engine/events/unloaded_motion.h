// unloaded_motion.h — how all shafts stand and turn with one of them before any load acts: what a start is made of.
#pragma once

#include <optional>
#include <vector>

#include "engine/model/model.h"

namespace kurbel {

struct UnloadedMotion {
  std::vector<double> angle;  // of every shaft [rad]
  std::vector<double> speed;  // of every shaft, over that of the reduction link in the usual motion
  std::vector<double> bend;  // its derivative by the angle of the reduction link [1/rad]: acceleration at ω² = 1, ε = 0
  std::vector<double> twist;  // of every elastic joint [rad]
};

// What is known beforehand: the angle of one shaft, which leads; twists; or the angles of all shafts.
struct KnownMotion {
  int shaft = 0;
  double angle = 0;                                // [rad]
  std::vector<std::optional<double>> twists = {};  // per elastic joint, where given
  std::vector<double> angles = {};                 // of every shaft; empty: sought
};

// One walk from the leading shaft outwards, through elastic joints (each at its unloaded twist, which for a universal
// joint hangs on the angle) and relations alike, so that both Σ gain φ = 0, Σ gain ω = 0 and the kinematics of every
// connection hold to round-off. Where a relation leaves a choice its members keep the shares of the usual motion.
UnloadedMotion unloaded_motion(const Model& model, const KnownMotion& known);

}  // namespace kurbel
