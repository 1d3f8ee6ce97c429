// slider_state.h — motion of a mechanism's output as its loads see it, and the end that they count from.
#pragma once

#include "engine/elements/event_kind.h"

namespace kurbel {

// Motion of the slider as its loads see it.
template <class T>
struct SliderState {
  T phi;           // crank angle [rad]
  T x;             // position of the output [m]
  T v;             // speed [m/s]
  int travel = 0;  // sign of v, fixed between events; 0 = crank at standstill
  int mode = 0;    // piece of the load's law, fixed between events
};

// What a load on an output is, and the members that belong to each, with its local motion s.
//   template <class T> T value(const SliderState<T>&) const;   every load: F [N]
//   bool uses_speed() const;                                   whether F depends on v
//   .holds, always with .opposes       Hold hold(s) const: range of forces at standstill [N]
//   .in_pieces                         void guard(s, double* g) const: both ends of the piece that is the mode;
//                                      int first_mode(s), int next_mode(s, int which), std::string mode_name(s) const
//   .turns_back                        int turned_mode(s) const: the piece after the sense of travel has changed
struct LoadTraits {
  bool opposes = false;  // turns round with the sense of travel
  bool holds = false;
  bool in_pieces = false;
  bool turns_back = false;
  EventKind kind = EventKind::law;  // of the event that ends a piece
};

// Where the working end lies.
struct WorkingEnd {
  double position = 0;  // x of that end [m]
  int side = 1;         // +1 extended, −1 folded

  template <class T>
  T distance(const T& x) const {
    return static_cast<double>(side) * (position - x);
  }
  bool approached(int travel) const { return travel * side > 0; }
};

}  // namespace kurbel
