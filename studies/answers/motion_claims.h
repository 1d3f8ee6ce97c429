// motion_claims.h — does the machine do its work at all? What the motion of a run and the state at its end say.
#pragma once

#include <optional>

#include "studies/answers/slip_recorder.h"
#include "studies/findings/result.h"

namespace kurbel {

// A reduction link that is held at the end although something drives it, or whose motor stands under torque.
struct Stall {
  std::string link, motor;  // motor: of those that stand under torque the first; empty: none is told
  double angle = 0;         // of the link [rad]
  double time = 0;          // of its rest [s]
  double torque = 0;        // that drives, reduced to the link [N·m]
  std::string holders;      // who holds it: "the load", "\"bearing\""
};
// Nothing: it moves, it is meant to rest, or a brake that is on holds it. `equations`: in the modes of the run's end.
std::optional<Stall> stalled(Equations& equations, const RunOutcome& outcome);
std::string in_words(const Stall& stall);

// Of a run that came to its end: what of the motion is bad news, who holds the link, what slips (contact_claims.h).
// `result` has its periods, figures, and the errors of its final state.
Claims motion_claims(Equations& equations, const RunOutcome& outcome, const Result& result, const SlipRecorder& slips);

}  // namespace kurbel
