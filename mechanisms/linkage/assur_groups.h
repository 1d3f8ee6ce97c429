// assur_groups.h — structure of a linkage: its joints, and the Assur groups that its links form after the driving link.
//
// A group is a smallest set of links that adds no degree of freedom: 3 n = 2 p, with the joints to the links before it
// (Assur, 1914; theory 9.16). Two links form a dyad, named by its joints from one outer joint to the other: RRR, RRP,
// RPR, PRP, RPP (R: pin, P: slide). A set with 3 n < 2 p has redundant joints; it moves only for special lengths.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mechanisms/linkage/link_pose.h"
#include "mechanisms/linkage/sketch.h"

namespace kurbel {

// From the axes of the sketch to those of the mechanism: origin in the driving link's bearing, +x along the output.
class SketchAxes {
 public:
  SketchAxes() = default;
  SketchAxes(const LinkageSketch& sketch, int bearing);
  SketchSpot spot(double x, double y) const;  // [m] → [m]
  SketchSpot direction(double angle) const;   // [rad] → unit vector
  SketchSpot in_sketch(SketchSpot way) const { return {cos_ * way.x - sin_ * way.y, sin_ * way.x + cos_ * way.y}; }
  double turned() const { return turned_; }  // angle of the mechanism's +x in the sketch [rad]

 private:
  long double x_ = 0, y_ = 0, cos_ = 1, sin_ = 0;
  double turned_ = 0;
};

// Between two bodies; `a` comes before `b` in the order of the groups.
struct LinkageJoint {
  int a = LinkageSketch::frame, b = 0;
  bool slides = false;
  int point = 0;     // point of the sketch: the pin, or the sliding point
  int carrier = 0;   // the body with the point; for a slide, the other body has the line
  SketchSpot at;     // the point
  SketchSpot along;  // of the line, a unit vector

  int other(int body) const { return a == body ? b : a; }
};

// Motion of a group in parallel with two known links (parallel_group.h).
struct ParallelMotion {
  struct Link {
    bool rod = false;  // keeps the base's rotation, not the leader's
    SketchSpot offset;
  };
  int base = LinkageSketch::frame, leader = 0;
  std::array<Link, LinkageSketch::most_links> links = {};  // in the group's order
  // All rods lie along one line, all cranks along another (unit vectors): parallel in a change point.
  bool changes = false;
  SketchSpot along_rods = {}, along_cranks = {};
};

struct AssurGroup {
  enum class Form { rrr, rrp, rpr, prp, rpp, newton };
  Form form = Form::newton;
  std::vector<int> links;   // of a dyad: first and second link
  std::vector<int> joints;  // of a dyad: outer joint of the first link, inner joint, outer joint of the second link
  int group_class = 2;      // II: dyads; III: a link with three joints or more; IV …: sides of the closed contour
  int order = 2;            // number of joints to the links before it
  int superfluous = 0;      // 2 p − 3 n: number of redundant closure equations, if the linkage can move

  std::optional<ParallelMotion> parallel;  // the way it is closed, if it has one

  bool is_dyad() const { return form != Form::newton; }
  bool changes() const { return parallel && parallel->changes; }
};

struct LinkageStructure {
  int bearing = -1;  // point of the driving link's bearing
  SketchAxes axes;
  std::vector<LinkageJoint> joints;  // the driving link's bearing first, then its other joints
  std::vector<AssurGroup> groups;
  std::vector<int> order;  // links: the driving one, then group by group
  int freedom = 0;         // 3 n − 2 p of the whole linkage
};

// Joints and groups. `faults` receives only what prevents the driving link from moving all the others.
LinkageStructure structure_of(const LinkageSketch& sketch, LinkageFaults& faults);

// "RRR", "class III of order 3"
std::string name_of(const AssurGroup& group);
// "1 closure more than they need"
std::string superfluous_of(const AssurGroup& group);
// "coupler, rocker"
std::string links_of(const AssurGroup& group, const LinkageSketch& sketch);

}  // namespace kurbel
