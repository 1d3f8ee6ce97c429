// link_pose.h — pose of a link: the image of its sketch, as a series in the angle of the driving link.
#pragma once

#include "mechanisms/loops/planar.h"
#include "mechanisms/loops/taylor.h"

namespace kurbel {

// A point or a direction of a link, in the position of the sketch and in the mechanism's axes [m].
using SketchSpot = Planar<long double>;

inline Taylor dot(const Path& a, const Path& b) { return a.x * b.x + a.y * b.y; }
inline Taylor cross(const Path& a, const Path& b) { return a.x * b.y - a.y * b.x; }
inline Path operator*(const Taylor& s, const Path& a) { return {s * a.x, s * a.y}; }

// The image of a spot s is at + turn · s; in the sketch at = 0, turn = 1.
struct LinkPose {
  Path at;
  Direction turn = Direction{Taylor(1), Taylor(0)};

  Path turned(SketchSpot s) const {
    const Taylor x(s.x), y(s.y);
    return {turn.cos * x - turn.sin * y, turn.sin * x + turn.cos * y};
  }
  Path operator()(SketchSpot s) const { return at + turned(s); }
  // The pose with this rotation in which the spot s is at `place`.
  static LinkPose through(const Direction& turn, SketchSpot s, const Path& place) {
    LinkPose pose;
    pose.turn = turn;
    pose.at = place - pose.turned(s);
    return pose;
  }
  // The rotation from the sketch's vector `from` to `to`, which has the same length.
  static Direction rotation(SketchSpot from, const Path& to) {
    const Taylor square(dot(from, from)), x(from.x), y(from.y);
    return {(to.x * x + to.y * y) / square, (to.y * x - to.x * y) / square};
  }
  LinkPose shifted(const Path& by) const { return {at + by, turn}; }
};

}  // namespace kurbel
