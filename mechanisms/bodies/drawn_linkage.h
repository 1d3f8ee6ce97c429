// drawn_linkage.h — the points of the drawing of a linkage.
#pragma once

#include <string>
#include <vector>

#include "mechanisms/linkage/linkage.h"

namespace kurbel {

struct DrawnJoint {
  int body;       // the body that it moves with
  SketchSpot at;  // in the position of the sketch, axes of the mechanism [m]
  std::string name;
};
// In the order of LinkageDrawing's joints: the driving link's bearing and its next point first.
std::vector<DrawnJoint> drawn_joints(const Linkage& linkage);

}  // namespace kurbel
