// motion_claims.h — does the machine do its work at all? Claims from the motion of a run and its final state.
#pragma once

#include "studies/answers/link_recorder.h"
#include "studies/answers/slip_recorder.h"
#include "studies/findings/result.h"

namespace kurbel {

inline constexpr double far_away = 1.5;  // times the usual speed: nothing in the scene tells of such a one

// Springs between shafts of which only one has a start speed in the scene, while that of the other differs by more
// than a tenth of the usual speed.
Claims start_claims(const std::shared_ptr<const Model>& model);

// Faults of the motion, what holds the link, what slips (contact_claims.h); for an incomplete run only that it
// stalls. `equations`: in the modes at the run's end; `result` contains its periods, figures, and the errors of its
// final state.
Claims motion_claims(Equations& equations, const RunOutcome& outcome, const Result& result, const SlipRecorder& slips,
                     const LinkRecorder& link);

}  // namespace kurbel
