// event_kind.h — what kinds of things happen in a run, for programs; words are for people.
#pragma once

#include "engine/base/enumerators.h"

namespace kurbel {

enum class EventKind {
  law,        // an element's law changes its piece
  load_edge,  // of those, a load's over the stroke or the angle
  flight,     // of those, joints with clearance: apart …
  touch,      // … and in contact
  impact,     // contact after flight
  rest,       // a shaft comes to rest and is held
  held,       // a gear is held by its own losses
  motion,     // it moves on
  lock,       // a clutch locks
  slip,       // it slips
  shares,     // who holds how much
  command,    // the operating sequence sets something
  window,     // something goes on or off at a time
  jam,        // friction stops a motion that has no way on
  note        // about the run itself
};

inline const char* name_of(EventKind kind) { return enumerator_words<EventKind::note>(kind); }

}  // namespace kurbel
