// contact_answers.h — what slips where it should hold, and what should stop the machine and does not.
#pragma once

#include <vector>

#include "engine/run/run.h"
#include "studies/conclusions/conclusion.h"

namespace kurbel {

// Of a run that came to its end, in the modes of its end: closed clutches and belts that slip to the end; a brake that
// is on and does not stop its shaft; and, no bad news by itself, closed clutches, limiters and belts that let go on the
// way.
std::vector<Answer> contact_answers(Equations& equations, const RunOutcome& outcome);

}  // namespace kurbel
