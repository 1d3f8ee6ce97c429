// stopping.h — how long the reduction link takes to stand, and how far it still turns, from the signal that stops it.
//
// Commands that drive: a motor or a clutch that is given more than 0, a brake that is let go. Commands that stop: a motor
// or a clutch that is taken away, a motor that is reversed against what it was told, a brake that is set. The signal is
// the first that stops after whatever drove last: a command, a clutch that locked, the link that began to move. What is
// told to loads is none.
#pragma once

#include <optional>

#include "engine/events/event.h"
#include "engine/model/model.h"

namespace kurbel {

struct Stopping {
  double time = 0, angle = 0;  // of the link [s], [rad]
  double at = 0;               // it stands then [s]
};
// The first stop of a run; empty: the link does not come to rest, or nothing tells it to.
std::optional<Stopping> first_stopping(const Model& model, const EventLog& events);

}  // namespace kurbel
