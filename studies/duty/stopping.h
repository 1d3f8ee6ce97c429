// stopping.h — stopping time and stopping angle of the reduction link, from the signal that stops it.
//
// Driving commands: a motor or clutch receives more than 0, a brake is released. Stopping commands: a motor or clutch
// is switched off, a motor is reversed, a brake is applied. The signal is the first stopping command after the last
// driving event: a command, a clutch that locked, the start of the link. Commands to loads do not count, nor does a contact
// that slipped after the signal and locks again.
#pragma once

#include <optional>

#include "engine/events/event.h"
#include "engine/model/model.h"

namespace kurbel {

struct Stopping {
  double time = 0, angle = 0;  // of the link [s], [rad]
  double at = 0;               // time of standstill [s]
  double largest_angle = 0;    // of the two whose difference the angle is [rad]
};
// The first stop of a run; empty: the link does not come to rest, or no command stops it. `standstill`: when it finally rests.
std::optional<Stopping> first_stopping(const Model& model, const EventLog& events, std::optional<double> standstill);

}  // namespace kurbel
