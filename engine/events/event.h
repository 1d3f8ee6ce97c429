// event.h — an event of a run: time, component, change.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/elements/event_kind.h"

namespace kurbel {

struct Event {
  double t = 0;
  std::string component, what;
  std::string from = {};  // the mode before, if it has a name
  EventKind kind = EventKind::note;
  // The new state: direction of a contact, value of a command, on (1) or off (0). Empty: given by `what` only.
  std::optional<double> value = {};
  double angle = 0;  // of the reduction link at the event, including full turns [rad]
};
using EventLog = std::vector<Event>;

}  // namespace kurbel
