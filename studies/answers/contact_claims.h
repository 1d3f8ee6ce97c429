// contact_claims.h — contacts that slip where they should hold, and brakes that should stop the machine and do not.
#pragma once

#include "studies/answers/slip_recorder.h"
#include "studies/findings/result.h"

namespace kurbel {

// For a completed run, with the modes at its end: closed clutches and belts that slip to the end or temporarily; a
// brake that is applied and does not stop its shaft; only in the list of claims: clutches that engage, are opened by
// command, or overrun. `result` contains the errors of its final state.
Claims contact_claims(Equations& equations, const RunOutcome& outcome, const Result& result, const SlipRecorder& slips);

// Springs between shafts of which only one has a start speed in the scene, while that of the other differs by more
// than a tenth of the usual speed.
Claims start_claims(const std::shared_ptr<const Model>& model);

}  // namespace kurbel
