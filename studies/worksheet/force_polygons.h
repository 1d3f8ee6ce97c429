// force_polygons.h — the polygon of the forces on every link at a position: closed, as it is in equilibrium (theory 9.6).
//
//     F + G + (−m a_S) + T + Σ R = 0
#pragma once

#include <string>
#include <vector>

#include "studies/forces/forces.h"
#include "studies/sheet/vector_plan.h"

namespace kurbel {

// Of each link, in their order, side by side in the order of drawing. Symbols of reactions: those of the joints,
// "R_12"; on link 1 that is "R_21". `linkage`: at any angle, with its gravity as it acts.
std::vector<VectorPlan> force_polygons(const LinkageForces& forces, const PlanarLinkage& linkage,
                                       const std::string& label);

// "R_12": the reaction of link 1 on link 2; the frame is 0.
std::string reaction_symbol(const LinkageForces& forces, const std::string& from, const std::string& on);

}  // namespace kurbel
