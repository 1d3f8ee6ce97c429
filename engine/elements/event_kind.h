// event_kind.h — what kinds of things happen in a run, for programs; words are for people.
#pragma once

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

inline const char* name_of(EventKind kind) {
  switch (kind) {
    case EventKind::law:
      return "law";
    case EventKind::load_edge:
      return "load edge";
    case EventKind::flight:
      return "flight";
    case EventKind::touch:
      return "touch";
    case EventKind::impact:
      return "impact";
    case EventKind::rest:
      return "rest";
    case EventKind::held:
      return "held";
    case EventKind::motion:
      return "motion";
    case EventKind::lock:
      return "lock";
    case EventKind::slip:
      return "slip";
    case EventKind::shares:
      return "shares";
    case EventKind::command:
      return "command";
    case EventKind::window:
      return "window";
    case EventKind::jam:
      return "jam";
    case EventKind::note:
      break;
  }
  return "note";
}

}  // namespace kurbel
