// remedies.h — remedies are computed before they are reported: the machine with that value meets the limit, and with
// one worse by 1 % it does not.
#pragma once

#include "studies/findings/result.h"
#include "studies/run/simulate.h"

namespace kurbel {

// For every exceeded verdict of a complete run with a remedy by a key of the scene, in descending order of excess:
// the value is sought by runs without errors, all within the processor time of the run, and stored in
// `remedies_tried`. Otherwise the remedy remains an estimate. An interruption ends the search.
void try_remedies(Result& run, const SimulateOptions& options);

}  // namespace kurbel
