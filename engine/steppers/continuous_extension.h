// continuous_extension.h — dense output for a Runge–Kutta table without one.
//
// Bootstrapping (W. H. Enright, K. R. Jackson, S. P. Nørsett, P. G. Thomsen, ACM Trans. Math. Software 12, 1986):
// the Hermite cubic through both ends of the step has a local error O(h⁴). The slope at one point of it, times h, has the
// error O(h⁵) and gives a quartic; slopes at two points of the quartic give a quintic, and so on. All coefficients are of
// order one, so that events are located to round-off; published extensions with fewer stages have coefficients of 1e5.
#pragma once

#include "engine/steppers/butcher_tables.h"

namespace kurbel {

// Appends 1 + 2 + … + n stages, n ≤ 4 the number of passes, and the dense output, of local order 4 + n, to a table that
// ends with the slope at the step's end.
EmbeddedTable with_continuous_extension(EmbeddedTable table, int rounds);

}  // namespace kurbel
