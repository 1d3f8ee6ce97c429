// unloaded_motion.h — angles and speeds of all shafts relative to one of them without load: the basis of a start.
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

// Given data: the angle of one leading shaft; twists; or the angles of all shafts.
struct KnownMotion {
  int shaft = 0;
  double angle = 0;                                // [rad]
  std::vector<std::optional<double>> twists = {};  // per elastic joint, if given
  std::vector<double> angles = {};                 // of every shaft; empty: to be computed
};

// Proceeds from the leading shaft outwards, through elastic joints (each at its unloaded twist, which for a universal
// joint depends on the angle) and relations, so that Σ gain φ = 0, Σ gain ω = 0 and the kinematics of every connection
// hold to round-off. If a relation leaves a choice, its members keep their ratios in the usual motion.
UnloadedMotion unloaded_motion(const Model& model, const KnownMotion& known);

}  // namespace kurbel
