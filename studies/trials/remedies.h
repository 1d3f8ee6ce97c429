// remedies.h — what would mend a verdict is computed before it is said: the machine with that value holds, and with one
// worse by 1 % it does not.
#pragma once

#include "studies/findings/result.h"
#include "studies/run/simulate.h"

namespace kurbel {

// Of every verdict of a complete run that is exceeded and that a key of the scene mends, the farthest beyond its limit first:
// the value is sought by runs without errors, all within the processor time that the run took, and kept in
// `remedies_tried`. Without one the remedy stays an estimate. An interrupt ends it.
void try_remedies(Result& run, const SimulateOptions& options);

}  // namespace kurbel
