// continuous_extension.h — a dense output for a Runge–Kutta table that comes without one.
//
// Bootstrapping (W. H. Enright, K. R. Jackson, S. P. Nørsett, P. G. Thomsen, ACM Trans. Math. Software 12, 1986):
// Hermite's cubic through both ends of the step has a local error O(h⁴). The slope at one point of it, times h, is good
// to O(h⁵) and makes a quartic of it; slopes at two points of the quartic make a quintic, and so on. Every coefficient
// stays of order one, so that events are located to round-off; published extensions with fewer stages have coefficients
// of 1e5.
#pragma once

#include "engine/steppers/butcher_tables.h"

namespace kurbel {

// Appends 1 + 2 + … + rounds stages and the dense output, of local order 4 + rounds, to a table that ends with the
// slope at the step's end. 1 ≤ rounds ≤ 4.
EmbeddedTable with_continuous_extension(EmbeddedTable table, int rounds);

}  // namespace kurbel
