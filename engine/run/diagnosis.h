// diagnosis.h — why a run cannot go on, in words: when, which state of which element, what happened last, what to try.
#pragma once

#include <optional>
#include <string>

#include "engine/run/run.h"

namespace kurbel {

// What broke a run off.
struct Breakdown {
  enum class Kind {
    not_finite,  // a value was lost, however short the step
    collapse,    // the step fell to round-off
    budget,
    restless,  // events without end at one instant
    other      // an element that knows no answer; the user
  };
  Kind kind = Kind::other;
  double t = 0;
  std::string why = {};
  std::optional<std::size_t> state = {};  // worst one
  std::string element = {};               // of the events without end
};

// One sentence each: "stopped at t = …: why; the state …; last events: …; try …". Names parameters with their values.
std::string diagnosis(const Breakdown& broken, Equations& equations, const RunOptions& options,
                      const RunOutcome& outcome);

}  // namespace kurbel
