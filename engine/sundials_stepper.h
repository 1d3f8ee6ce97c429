// sundials_stepper.h — the implicit and multistep integrators of SUNDIALS as Steppers; no SUNDIALS type is seen
// outside.
#pragma once

#include <memory>

#include "engine/stepper.h"

namespace kurbel {

// ARKStep with the six-stage, fourth-order, stiffly accurate, L-stable ESDIRK4(3)6L[2]SA of Kennedy and Carpenter
// (2016), Newton's iteration and KLU.
std::unique_ptr<Stepper> make_esdirk_stepper(OdeSystem& system, const ErrorControl& control);

// CVODE: backward differentiation formulas of order 1…5, Newton's iteration and KLU.
std::unique_ptr<Stepper> make_bdf_stepper(OdeSystem& system, const ErrorControl& control);

// CVODE: Adams–Moulton formulas of order 1…12, fixed-point iteration.
std::unique_ptr<Stepper> make_adams_stepper(OdeSystem& system, const ErrorControl& control);

}  // namespace kurbel
