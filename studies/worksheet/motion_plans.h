// motion_plans.h — plans of velocity and acceleration of any planar linkage at its positions; polygons of
// the forces on its links (theory 9.6).
//
// Of a point P of a link that has the point B and turns with ω and ε, and of a slide's point P and the point Q of the
// carrying link that it covers:
//     v_P = v_B + ω × BP            a_P = a_B − ω² BP + ε × BP          normal, tangential
//     v_P = v_Q + v_PQ              a_P = a_Q + 2 ω × v_PQ + aʳ_PQ      Coriolis, relative along the slide
// B is the link's fixed bearing where it has one, else its first joint.
#pragma once

#include <string>
#include <vector>

#include "studies/forces/forces.h"
#include "studies/sheet/mechanism_sheets.h"
#include "studies/sheet/vector_plan.h"

namespace kurbel {

// At one position of the link that turns; points a, b … and centres of mass s_2, from the pole p_v [m/s].
VectorPlan velocity_plan(const MechanismOnSheet& mechanism, const LinkAt& at, const std::string& label);
// a′, b′ … from p_a [m/s²].
VectorPlan acceleration_plan(const MechanismOnSheet& mechanism, const LinkAt& at, const std::string& label);

void add_motion_plans(Sheets& sheets, const MechanismOnSheet& mechanism, const SheetMotion& motion,
                      const std::string& speed);

// The polygon of the forces on each link, closed as it is in equilibrium: F + G + (−m a_S) + T + Σ R = 0. In their
// order, side by side in the order of drawing. Symbols of reactions: those of the joints,
// "R_12"; on link 1 that is "R_21". `linkage`: at any angle, with its gravity as it acts.
std::vector<VectorPlan> force_polygons(const LinkageForces& forces, const PlanarLinkage& linkage,
                                       const std::string& label);

// "R_12": the reaction of link 1 on link 2; the frame is 0.
std::string reaction_symbol(const LinkageForces& forces, const std::string& from, const std::string& on);

}  // namespace kurbel
