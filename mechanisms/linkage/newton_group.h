// newton_group.h — a group of any class by Newton's method on its closures, with its series in the driving link's angle.
//
// Unknowns of each link: the shift of one of its points and its rotation, both from the sketch. A pin gives two closures
// (the places differ in x, in y), a slide two (the directions differ, the point leaves the line). Solved in the sense of
// least squares, so that closures that say nothing new do no harm; the series follow from the same matrix, order by order
// (theory 9.18):
//     J u_k = −(coefficient k of the closures with u_k = 0)
#pragma once

#include <vector>

#include "mechanisms/linkage/assur_groups.h"
#include "mechanisms/linkage/dyads.h"

namespace kurbel {

struct LinkShift {
  Taylor x, y, angle;  // [m], [m], [rad]
};

struct GroupClosure {
  bool closed = false;
  long double misfit = 0;  // of closures that are too many, where the others are kept best [m]
  bool singular = false;   // Newton's matrix has no full rank
};

// Adds the poses of the group's links. `shifts`: one for each of the links, near the solution by their values; then the
// solution's series. `size` [m]: a length of the linkage.
GroupClosure close_by_newton(const AssurGroup& group, const std::vector<LinkageJoint>& joints, long double size,
                             LinkPoses& poses, std::vector<LinkShift>& shifts);

// Independent closures of all joints in the position of the sketch.
int closure_rank(const LinkageStructure& structure);

}  // namespace kurbel
