// motion_answers.h — does the machine do its work at all? What the motion of a run and the state at its end say.
#pragma once

#include <optional>
#include <vector>

#include "engine/run/run.h"
#include "studies/findings/result.h"

namespace kurbel {

// A reduction link that is held at the end although something drives it, or whose motor stands under torque.
struct Stall {
  std::string link, motor;  // motor: of those that stand under torque the first; empty: none is told
  double angle = 0;         // of the link [rad]
  double time = 0;          // of its rest [s]
  double torque = 0;        // that drives, reduced to the link [N·m]
};
// Nothing: it moves, or it is meant to rest. `equations`: in the modes of the run's end.
std::optional<Stall> stalled(Equations& equations, const RunOutcome& outcome);
std::string in_words(const Stall& stall);

// In the order of how bad they are: it stalls; a brake does not stop it; it turns backwards against its drive; its motor
// hangs below its breakdown speed; it runs away; it never gets round; a clutch slips to the end although it is closed.
// Of a run that came to its end.
std::vector<Answer> motion_answers(Equations& equations, const RunOutcome& outcome, const Periods& periods,
                                   const std::vector<Figure>& figures, bool any_cycle, double begins_at);

}  // namespace kurbel
