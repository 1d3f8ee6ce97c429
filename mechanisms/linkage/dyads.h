// dyads.h — the five dyads in closed form, from the motion of the links that their outer joints stand on (theory 9.17).
//
//     RRR   two circles about the outer pins cut each other in the inner one        sine: of the angle between the links
//     RRP   a circle about the outer pin and the inner pin's line                    of the first link against its normal
//     RPR   the triangle of both outer pins and the slide's offset                   of the reach along the slide
//     PRP   the inner pin's two lines                                                of the angle between them
//     RPP   two shifts that add up to the way of the outer pin                       of the angle between them
//
// The branch is that of the sketch: the determinant of the closures keeps its sign. Its sine, squared where it comes from
// a root, is the margin: 1 far from a dead position, 0 in it, and < 0 where the dyad cannot be closed.
#pragma once

#include <vector>

#include "mechanisms/linkage/assur_groups.h"

namespace kurbel {

// Poses of the links, of which a group adds its own; the frame stands.
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

// Adds the poses of the dyad's links and returns the margin; where that is not > 0 the poses are none.
long double close_dyad(const AssurGroup& dyad, const std::vector<LinkageJoint>& joints, LinkPoses& poses);

// "coupler and rocker lie in one line": what the margin 0 means.
std::string dead_position_of(const AssurGroup& dyad, const LinkageSketch& sketch);

}  // namespace kurbel
