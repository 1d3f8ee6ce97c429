// energy_mass_sheet.h — ΔT over φ, I_em over φ and the energy–mass curve with its tangents, in one projection:
// Wittenbauer's diagram on paper.
#pragma once

#include "studies/sheet/scales.h"
#include "studies/worksheet/reduce_sheet.h"

namespace kurbel {

// tan ψ = ½ ω² μ_I/μ_T: slope of a tangent on paper.
struct TangentOnPaper {
  double psi = 0;        // [rad]
  double intercept = 0;  // on the axis I_em = 0, above ΔT = 0 [mm]
};
TangentOnPaper on_paper(const Tangent& tangent, double energy_of_origin, const Scale& energy, const Scale& inertia);

void add_energy_mass(Sheets& sheets, const ReduceSheet& sheet);

}  // namespace kurbel
