// periodicity.h — after what angle or time the laws of a machine repeat: the smallest common period of all.
#pragma once

#include "engine/model/model.h"

namespace kurbel {

// After what the machine's laws repeat.
struct Periodicity {
  double angle = 0;            // of the reduction link [rad]; 2π where no law depends on an angle
  bool angle_matters = false;  // some law does
  bool by_time = false;        // some law depends on time, or a speed is prescribed
  double time = 0;             // common period of all that does [s]
  double settled_from = 0;     // laws over time that do not repeat hold still from here on [s]
};

// Throws std::invalid_argument in words where the cycles never meet (periods that are not commensurable).
Periodicity periodicity_of(const Model& model);

// The node whose speed is prescribed, the frame's not counted; −1: none. Throws std::invalid_argument where there are
// two.
int prescribed_node(const Model& model);

}  // namespace kurbel
