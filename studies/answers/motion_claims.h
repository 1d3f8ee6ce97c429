// motion_claims.h — does the machine do its work at all? What the motion of a run and the state at its end say.
#pragma once

#include "studies/answers/link_recorder.h"
#include "studies/answers/slip_recorder.h"
#include "studies/findings/result.h"

namespace kurbel {

// Springs between shafts of which the scene gives a speed at the start to one alone, where the other one differs by more
// than a tenth of the usual speed.
Claims start_claims(const std::shared_ptr<const Model>& model);

// What of the motion is bad news, who holds the link, what slips (contact_claims.h); of a run that did not come to its end
// that it stalls, alone. `equations`: in the modes of the run's end; `result` has its periods, figures, and the errors of
// its final state.
Claims motion_claims(Equations& equations, const RunOutcome& outcome, const Result& result, const SlipRecorder& slips,
                     const LinkRecorder& link);

}  // namespace kurbel
