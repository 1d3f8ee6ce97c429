// sundials_stepper.h — the implicit and multistep integrators of SUNDIALS as Steppers, without SUNDIALS types in the
// interface.
#pragma once

#include <memory>

#include "engine/steppers/stepper.h"

namespace kurbel {

// ARKStep with the stiffly accurate, L-stable ESDIRK3(2)5L[2]SA, ESDIRK4(3)6L[2]SA or ESDIRK5(4)7L[2]SA2 of Kennedy and
// Carpenter (NASA/TM-2016-219173; the last one 2019), by their order 3, 4 or 5; Newton's iteration and KLU.
std::unique_ptr<Stepper> make_esdirk_stepper(int order, OdeSystem& system, const ErrorControl& control);

// CVODE: backward differentiation formulas of order 1…5, Newton's iteration and KLU.
std::unique_ptr<Stepper> make_bdf_stepper(OdeSystem& system, const ErrorControl& control);

// CVODE: Adams–Moulton formulas of order 1…12, fixed-point iteration.
std::unique_ptr<Stepper> make_adams_stepper(OdeSystem& system, const ErrorControl& control);

}  // namespace kurbel
