// parallel_group.h — groups of rods and cranks that move in parallel: coupled wheels, parallelograms, one behind another.
//
// Two known links F (base) and K (leader) are pinned together, T_F and T_K their rotations from the sketch. Rods keep the
// rotation of F, cranks that of K:
//     rod    x ↦ F.at + T_F x + (T_K − T_F) o,   o: from the bearing of each of its cranks to their common pin
//     crank  x ↦ F.at + T_K x + (T_K − T_F) o,   −o: the bearing
// If each pin agrees about the offsets o in the sketch, all joints are closed in every position, however many are redundant.
// Where all cranks lie along all rods, the closures lose rank: a change point. The motion above is smooth there.
#pragma once

#include <optional>
#include <vector>

#include "mechanisms/linkage/assur_groups.h"
#include "mechanisms/linkage/dyads.h"

namespace kurbel {

// The motion of a group in parallel, in the order of its links; empty: it has none. `poses`: of the links before it, in the
// sketch, which may be a change point; `size` [m]: of the linkage.
std::optional<ParallelMotion> parallel_motion(const AssurGroup& group, const LinkageSketch& sketch,
                                              const LinkageStructure& structure, const LinkPoses& poses,
                                              long double size);

// Pins to be moved [m, axes of the sketch] so that the group moves in parallel, if no more than the rounding of the
// sketch's coordinates prevents it; else empty.
struct MovedPoint {
  int point = 0;
  SketchSpot by;
};
std::optional<std::vector<MovedPoint>> parallel_pins(const AssurGroup& group, const LinkageSketch& sketch,
                                                     const LinkageStructure& structure, long double size);

// Adds the poses of the group's links.
void move_in_parallel(const AssurGroup& group, LinkPoses& poses);
// Of the angle from rods to cranks: 0 in a change point.
Taylor sine_of(const ParallelMotion& motion, const LinkPoses& poses);

}  // namespace kurbel
