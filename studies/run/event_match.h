// event_match.h — which events of two runs are the same, and how far apart in time.
#pragma once

#include <optional>
#include <vector>

#include "engine/events/equations.h"

namespace kurbel {

struct EventMatch {
  // One for each event of the finer run: |Δt| to its partner in the coarser one; nothing: it has none.
  std::vector<std::optional<double>> error;
  std::size_t only_in_fine = 0, only_in_coarse = 0;
};

// Partners are of one kind: component, what, and the mode before. As many of a kind in both runs: in their order.
// Otherwise (a contact that flickers once more): those that are the nearest in time to each other.
EventMatch match_events(const std::vector<Event>& coarse, const std::vector<Event>& fine);

// Raises the errors of a run's event times [s] to `weight` times what a witness differs by, and at least to rounding;
// nothing where any witness has no such event. `errors` is empty before the first witness.
void add_event_errors(const std::vector<Event>& events, const std::vector<Event>& witness, double weight,
                      std::vector<std::optional<double>>& errors);

}  // namespace kurbel
