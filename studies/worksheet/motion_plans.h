// motion_plans.h — plans of velocity and acceleration of any planar linkage at its positions.
//
// Of a point P of a link that has the point B and turns with ω and ε, and of a slide's point P and the point Q of the
// carrying link that it covers:
//     v_P = v_B + ω × BP            a_P = a_B − ω² BP + ε × BP          normal, tangential
//     v_P = v_Q + v_PQ              a_P = a_Q + 2 ω × v_PQ + aʳ_PQ      Coriolis, relative along the slide
// B is the link's fixed bearing where it has one, else its first joint.
#pragma once

#include <string>
#include <vector>

#include "studies/sheet/mechanism_sheets.h"
#include "studies/sheet/vector_plan.h"

namespace kurbel {

// At one position of the link that turns; points a, b … and centres of mass s_2, from the pole p_v [m/s].
VectorPlan velocity_plan(const MechanismOnSheet& mechanism, const LinkAt& at, const std::string& label);
// a′, b′ … from p_a [m/s²].
VectorPlan acceleration_plan(const MechanismOnSheet& mechanism, const LinkAt& at, const std::string& label);

void add_motion_plans(Sheets& sheets, const MechanismOnSheet& mechanism, const SheetMotion& motion,
                      const std::string& speed);

}  // namespace kurbel
