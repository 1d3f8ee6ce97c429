// mechanism_inertia.h — reduced inertia of the executive mechanisms over a cycle.
#pragma once

#include "engine/base/piecewise.h"

namespace kurbel {

// I_em over the breaks of the cycle.
struct MechanismInertia {
  Piecewise value, slope;  // [kg·m²], [kg·m²/rad]
};

}  // namespace kurbel
