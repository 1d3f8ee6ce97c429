// diagnosis.h — message why a run cannot continue: time, state and element, last events, remedy.
#pragma once

#include <optional>
#include <string>

#include "engine/run/run.h"

namespace kurbel {

// Reason why a run ended early.
struct Breakdown {
  enum class Kind {
    not_finite,  // a value is not finite, even with the shortest step
    collapse,    // the step size fell to round-off
    budget,
    restless,  // unlimited events at one instant
    other      // an element without solution; interrupted by the user
  };
  Kind kind = Kind::other;
  double t = 0;
  std::string why = {};
  std::optional<std::size_t> state = {};  // worst one
  std::string element = {};               // of the unlimited events
};

// One sentence each: "stopped at t = …: why; the state …; last events: …; try …". Names parameters with their values.
std::string diagnosis(const Breakdown& broken, Equations& equations, const RunOptions& options,
                      const RunOutcome& outcome);

}  // namespace kurbel
