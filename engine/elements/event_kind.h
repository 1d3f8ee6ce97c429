// event_kind.h — kinds of events of a run, for programs; the texts are for users.
#pragma once

#include "engine/base/enumerators.h"

namespace kurbel {

enum class EventKind {
  law,        // the law of an element changes to another piece
  load_edge,  // the same, for a load over the stroke or the angle
  flight,     // the same, for joints with clearance: apart …
  touch,      // … and in contact
  impact,     // contact after flight
  rest,       // a shaft comes to rest and is held
  held,       // a gear is held by its own losses
  motion,     // it moves again
  lock,       // a clutch locks
  slip,       // it slips
  shares,     // shares of the elements in a holding torque
  command,    // the operating sequence sets a command
  window,     // an element is switched on or off at a time
  jam,        // friction stops a motion that cannot continue
  note        // about the run itself
};

inline const char* name_of(EventKind kind) { return enumerator_words<EventKind::note>(kind); }

}  // namespace kurbel
