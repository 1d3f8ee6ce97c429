// newton_group.h — a group of any class by Newton's method on its closures, as series in the driving link's angle.
//
// Unknowns of each link: the displacement of one of its points and its rotation, both from the sketch. A pin gives two
// closures (differences in x and y), a slide two (difference of directions, distance of the point from the line). The
// least-squares solution allows redundant closures; the series follow from the same matrix, order by order (theory 9.18):
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
  long double pivot = 0;  // of Newton's matrix the smallest pivot over the greatest, 0 in a change point
};

// Adds the poses of the group's links. `shifts`: one for each link; on entry values near the solution, on return the
// series of the solution. `size` [m]: a characteristic length of the linkage.
GroupClosure close_by_newton(const AssurGroup& group, const std::vector<LinkageJoint>& joints, long double size,
                             LinkPoses& poses, std::vector<LinkShift>& shifts);

// Number of independent closures of all joints in the position of the sketch.
int closure_rank(const LinkageStructure& structure);

}  // namespace kurbel
