// slider_state.h — motion of a mechanism's output as its loads see it, and the end that they count from.
#pragma once

#include "engine/elements/element.h"

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

// Where the working end lies.
struct WorkingEnd {
  double position = 0;  // x of that end [m]
  int side = 1;         // +1 extended, −1 folded

  template <class T>
  T distance(const T& x) const {
    return static_cast<double>(side) * (position - x);
  }
  bool approached(int travel) const { return travel * side > 0; }
  // What holds the output from going on towards this end with up to `force`, and with `more` > 0, of what resists that
  // way more than the other.
  Hold hold(double force) const { return side > 0 ? Hold{-force, 0} : Hold{0, force}; }
  Hold hold_beyond(double more) const { return more <= 0 ? Hold{} : hold(more); }
};

}  // namespace kurbel
