// contact_claims.h — what slips where it should hold, and what should stop the machine and does not.
#pragma once

#include "studies/answers/slip_recorder.h"
#include "studies/findings/result.h"

namespace kurbel {

// Of a run that came to its end, in the modes of its end: closed clutches and belts that slip to the end or on the way; a
// brake that is on and does not stop its shaft; in the list of claims alone clutches that engage, are open by command, or
// overrun. `result` has the errors of its final state.
Claims contact_claims(Equations& equations, const RunOutcome& outcome, const Result& result, const SlipRecorder& slips);

}  // namespace kurbel
