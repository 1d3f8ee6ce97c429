// family.h — families of solutions, such as motions with a conserved quantity, and Newton's method for one member of a
// family.
#pragma once

#include <optional>

#include "engine/return_map/return_map.h"

namespace kurbel {

// A family x(s₁, s₂, …) of solutions of r(x) = 0: its tangents, and the gradients of as many quantities Q that distinguish
// its members and are conserved by x ↦ x + r(x), in columns; scaled so that quantityᵀ tangent = 1. Steps with
// quantityᵀ Δx = 0 stay on one member.
struct Family {
  Eigen::MatrixXd tangent, quantity;
  // Without the quantities that r(x) changes by more than `unchanged`.
  Family kept(const Eigen::VectorXd& residual, double unchanged) const;
};
// From the null vectors of a derivative ∂r/∂x with entries of accuracy `uncertain`, at most eight; empty if there are none,
// or if Q is stationary along them.
std::optional<Family> family_of(const Eigen::MatrixXd& derivative, double uncertain);

// solve() for an r that may have a family: it stays on one member, since Newton's step along the family is round-off.
// `uncertain`: accuracy of the entries of the last derivative.
NewtonOutcome solve_in_family(const NewtonSystem& system, const Eigen::VectorXd& guess, double enough,
                              std::function<double()> uncertain);

// Whether a fixed point of a family is the member of the section's run. to_come of the point is then the possible
// difference: the distance from the run's member, and the difference of a run with looser steps.
bool is_member_of_run(const ReturnMap& map, SteadyPoint& point);

// Uncertainty of the member of a family that the section's run belongs to: difference of a run from the scene's start with
// 100 times looser steps at the section's time or angle, without the part along the motion.
Eigen::VectorXd uncertainty_of_member(ReturnMap& map);

// Message for a search whose last trial had no residual: `why` is about this trial, not about the machine.
std::string trial_ended(const NewtonOutcome& search, const std::string& why);

}  // namespace kurbel
