// drawn_linkage.h — the places by which a linkage is drawn.
#pragma once

#include <string>
#include <vector>

#include "mechanisms/linkage/linkage.h"

namespace kurbel {

struct DrawnJoint {
  int body;       // it moves with
  SketchSpot at;  // in the position of the sketch, mechanism's axes [m]
  std::string name;
};
// In the order of LinkageDrawing's joints: the driving link's bearing and its next point first.
std::vector<DrawnJoint> drawn_joints(const Linkage& linkage);

}  // namespace kurbel
