// oil_film.h — which friction it is in a pin: film parameter λ of its journal, by the Reynolds equation.
//                                                                                            (theory 8.16, 8.17)
// Plain journal bearing of finite length, full circumference, oil without pressure at its widest gap and at both ends,
// constant viscosity, laminar, rigid, journal and bore parallel; load and speed as they are at this position: squeezing and
// turning of the load against the bore are not counted, so that a pin that rocks has no film where it turns back.
#pragma once

#include <string>
#include <vector>

#include "engine/base/estimate.h"
#include "studies/forces/forces.h"

namespace kurbel {

// w = W c²/(η U L R²) = 1/(π S) [1], S Sommerfeld's number, at the relative eccentricity ε in (0, 1) of a bearing of length
// over diameter L/D > 0. Error: difference to a grid of half the cells. Throws std::invalid_argument outside the domain.
Estimate bearing_load_number(double eccentricity, double slenderness);
// The inverse: 1 − ε = h_min/c in [0, 1]; below least_gap 0, with least_gap as its error.
inline constexpr double least_gap = 1e-3;
Estimate least_film(double load_number, double slenderness);

// λ = h_min/√(R_q1² + R_q2²): boundary friction below 1, fluid above 3, mixed between; dry without oil.
inline constexpr double boundary_below = 1, fluid_above = 3;

// Of pins with film data, which are complete or dry.
std::vector<PinFilm> films_of(const MechanismJoints& joints, const ForceCycle& cycle);

}  // namespace kurbel
