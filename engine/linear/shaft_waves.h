// shaft_waves.h — discretisation error of the elements of continuous shafts in the modes, by their exact dynamic
// stiffness (theory 5.22).
#pragma once

#include <Eigen/Core>

#include "engine/linear/linearise.h"

namespace kurbel {

// Error of the frequency of a mode, with the shape of the coordinates: one step of Newton's method,
//     δω = Σ uᵀ (D_exact − D_element) u/(2 ω qᵀ M q)                                       (theory 5.21)
// over the ends u of all elastic continuous shafts [rad/s].
double wave_error(const LinearDrive& drive, const Eigen::VectorXd& shape, double omega);

// Number of undamped modes below ω of the drive with continuous shafts, with rigid ones (Wittrick and Williams 1971):
// negative eigenvalues of D_exact(ω), and modes below ω of the shafts with both ends held.
int continuous_modes_below(const LinearDrive& drive, double omega);

}  // namespace kurbel
