// event.h — what happened in a run, when, and to whom.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/elements/event_kind.h"

namespace kurbel {

struct Event {
  double t = 0;
  std::string component, what;
  std::string from = {};  // the mode before, where it has a name
  EventKind kind = EventKind::note;
  // What is now: a contact's sense, a command's value, on (1) or off (0). Empty: the words alone name the mode.
  std::optional<double> value = {};
  double angle = 0;  // of the reduction link then, turns counted [rad]
};
using EventLog = std::vector<Event>;

}  // namespace kurbel
