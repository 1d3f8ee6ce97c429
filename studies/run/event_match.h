// event_match.h — matches the events of two runs, with their differences in time.
#pragma once

#include <optional>
#include <vector>

#include "engine/events/equations.h"

namespace kurbel {

struct EventMatch {
  // One for each event of the finer run: |Δt| to its partner in the coarser one; empty: it has none.
  std::vector<std::optional<double>> error;
  std::size_t only_in_fine = 0, only_in_coarse = 0;
};

// Partners are of one kind: component, what, and the mode before. If both runs have the same number of a kind, they
// are matched in order; otherwise (one more contact change, for example) by mutually nearest times.
EventMatch match_events(const std::vector<Event>& coarse, const std::vector<Event>& fine);

// Raises the errors of a run's event times [s] to `weight` times the difference to a witness, with what it may hide by
// chance if they differ by more than rounding, and at least to that; empty if any witness has no such event. `errors` is
// empty before the first witness.
void add_event_errors(const std::vector<Event>& events, const std::vector<Event>& witness, double weight, double hidden,
                      std::vector<std::optional<double>>& errors);

}  // namespace kurbel
