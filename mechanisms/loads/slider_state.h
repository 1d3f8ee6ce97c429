// slider_state.h — motion of a mechanism's output for its loads, and the end from which they are measured.
#pragma once

#include "engine/elements/element.h"

namespace kurbel {

// Sign of a speed: 0 of an output that stands still.
inline int direction_of(double v) { return (v > 0) - (v < 0); }

// Motion of the slider for its loads.
template <class T>
struct SliderState {
  T phi;           // crank angle [rad]
  T x;             // position of the output [m]
  T v;             // speed [m/s]
  int travel = 0;  // sign of v, fixed between events; 0: it stands still
  int mode = 0;    // piece of the load's law, fixed between events
};

// Position of the working end.
struct WorkingEnd {
  double position = 0;  // x of that end [m]
  int side = 1;         // +1 extended, −1 folded

  template <class T>
  T distance(const T& x) const {
    return static_cast<double>(side) * (position - x);
  }
  bool approached(int travel) const { return travel * side > 0; }
  // Static force up to `force` against motion towards this end; up to `more` > 0, the excess of the resistance in that
  // direction over the other.
  Hold hold(double force) const { return side > 0 ? Hold{-force, 0} : Hold{0, force}; }
  Hold hold_beyond(double more) const { return more <= 0 ? Hold{} : hold(more); }
};

}  // namespace kurbel
