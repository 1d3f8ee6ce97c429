// periodicity.h — the smallest common period of all laws of a machine, over angle and time.
#pragma once

#include "engine/model/model.h"

namespace kurbel {

// Periods of the machine's laws.
struct Periodicity {
  double angle = 0;            // of the reduction link [rad]; 2π if no law depends on an angle
  bool angle_matters = false;  // some law depends on an angle
  bool by_time = false;        // some law depends on time, or a speed is prescribed
  double time = 0;             // common period of the laws over time [s]
  bool clocked = false;        // some law over time repeats, besides the turns of a prescribed speed
  double settled_from = 0;     // time from which non-periodic laws are constant [s]
};

// `clocked`: false for a sequence that does not keep to its clock. Throws std::invalid_argument if the periods are not
// commensurable.
Periodicity periodicity_of(const Model& model, bool clocked = true);

// The period is the duration of the steps.
inline bool repeats_freely(const Sequence& sequence, bool clocked) {
  return sequence.repeats_freely() || (sequence.repeat && !clocked);
}

// Common period of the laws over time and of a sequence that repeats by the clock [s]; 0: there are none, or they have no common
// period. A speed prescribed as a constant is none.
double clock_of(const Model& model);

// Least time from one repetition of a clocked sequence to the next [s]: `every`, or what its steps wait at least. 0: no
// clock.
double least_repetition(const Sequence& sequence);

// The node with prescribed speed, except the frame; −1: none. Throws std::invalid_argument if there are
// two.
int prescribed_node(const Model& model);

}  // namespace kurbel
