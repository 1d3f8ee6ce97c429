// family.h — solutions that are one of a family, as motions with a conserved quantity are, and Newton's method that keeps to
// one of them.
#pragma once

#include <optional>

#include "engine/return_map/return_map.h"

namespace kurbel {

// Of a family x(s₁, s₂, …) of solutions of r(x) = 0: its tangents, and the slopes of the quantities Q that tell its members
// apart and that x ↦ x + r(x) keeps, as many, in columns; scaled so that quantityᵀ tangent = 1. Steps with quantityᵀ Δx = 0
// stay with one member.
struct Family {
  Eigen::MatrixXd tangent, quantity;
  // Without what r(x) changes by more than `unchanged` of the quantities.
  Family kept(const Eigen::VectorXd& residual, double unchanged) const;
};
// Null vectors of a derivative ∂r/∂x whose entries are good to `uncertain`, eight at most; none where it has none, or where
// Q is stationary along them.
std::optional<Family> family_of(const Eigen::MatrixXd& derivative, double uncertain);

// solve(), where r may know a family: a member is kept, since Newton's own step along it is round-off. `uncertain`: what the
// entries of the last derivative are good for.
NewtonOutcome solve_in_family(const NewtonSystem& system, const Eigen::VectorXd& guess, double enough,
                              std::function<double()> uncertain);

// Whether a fixed point of a family is the member that the section's run belongs to. to_come of the point then says by how
// much it may be another: what is left to the run's own, and what a run with looser steps comes to.
bool is_member_of_run(const ReturnMap& map, SteadyPoint& point);

// What the member of a family that the section's run belongs to is uncertain by: where a run from the scene's start with steps
// 100 times looser is at the section's time or angle, less what lies along the motion itself.
Eigen::VectorXd uncertainty_of_member(ReturnMap& map);

// What is said of a search whose last trial had no residual: `why` tells of that trial, not of the machine.
std::string trial_ended(const NewtonOutcome& search, const std::string& why);

}  // namespace kurbel
