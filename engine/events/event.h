// event.h — what happened in a run, when, and to whom.
#pragma once

#include <string>
#include <vector>

#include "engine/elements/event_kind.h"

namespace kurbel {

struct Event {
  double t = 0;
  std::string component, what;
  std::string from = {};  // the mode before, where it has a name
  double angle = 0;       // of the reduction link then, turns counted [rad]
  EventKind kind = EventKind::note;
};
using EventLog = std::vector<Event>;

}  // namespace kurbel
