// dyads.h — the five dyads in closed form, from the motion of the links of their outer joints (theory 9.17).
//
//     RRR   two circles about the outer pins intersect in the inner pin             sine: of the angle between the links
//     RRP   a circle about the outer pin and the line of the inner pin               of the first link to its normal
//     RPR   the triangle of both outer pins and the slide's offset                   of the reach along the slide
//     PRP   the two lines of the inner pin                                           of the angle between them
//     RPP   two displacements whose sum is the displacement of the outer pin         of the angle between them
//
// The branch is that of the sketch: the closure determinant keeps its sign. The sine, squared where it is from a square
// root, is the margin: 1 far from a dead position, 0 in it, < 0 where the dyad cannot be closed.
#pragma once

#include <vector>

#include "mechanisms/linkage/assur_groups.h"

namespace kurbel {

// Poses of the links; each group adds its own. The frame is fixed.
class LinkPoses {
 public:
  explicit LinkPoses(std::size_t links) : poses_(links) {}
  const LinkPose& operator[](int body) const {
    return body == LinkageSketch::frame ? frame_ : poses_[static_cast<std::size_t>(body)];
  }
  LinkPose& of(int link) { return poses_[static_cast<std::size_t>(link)]; }
  std::size_t size() const { return poses_.size(); }

 private:
  LinkPose frame_;
  std::vector<LinkPose> poses_;
};

// Adds the poses of the dyad's links and returns the margin; the poses are valid only if it is > 0.
long double close_dyad(const AssurGroup& dyad, const std::vector<LinkageJoint>& joints, LinkPoses& poses);

// Description of the margin 0, such as "coupler and rocker lie in one line".
std::string dead_position_of(const AssurGroup& dyad, const LinkageSketch& sketch);

}  // namespace kurbel
