// assur_groups.h — a linkage taken apart: its joints, and the Assur groups that its links form behind the driving link.
//
// A group is a set of links that adds no degree of freedom, 3 n = 2 p with its joints to the links before it, and holds no
// smaller one (Assur, 1914; theory 9.16). Two links make a dyad, named by its joints from outside to outside: RRR, RRP,
// RPR, PRP, RPP (R a pin, P a slide). A set with 3 n < 2 p has more joints than it needs; it moves if its lengths allow it.
#pragma once

#include <string>
#include <vector>

#include "mechanisms/linkage/link_pose.h"
#include "mechanisms/linkage/sketch.h"

namespace kurbel {

// From the sketch's axes to the mechanism's: origin in the driving link's bearing, +x along the output's direction.
class SketchAxes {
 public:
  SketchAxes() = default;
  SketchAxes(const LinkageSketch& sketch, int bearing);
  SketchSpot spot(double x, double y) const;  // [m] → [m]
  SketchSpot direction(double angle) const;   // [rad] → unit vector
  double turned() const { return turned_; }   // +x of the mechanism from the sketch's [rad]

 private:
  long double x_ = 0, y_ = 0, cos_ = 1, sin_ = 0;
  double turned_ = 0;
};

// Between two bodies; `a` comes before `b` in the order of the groups.
struct LinkageJoint {
  int a = LinkageSketch::frame, b = 0;
  bool slides = false;
  int point = 0;     // of the sketch: the pin, or what slides
  int carrier = 0;   // the body that has it; of a slide the other one has the line
  SketchSpot at;     // the point
  SketchSpot along;  // of the line, a unit vector

  int other(int body) const { return a == body ? b : a; }
};

struct AssurGroup {
  enum class Form { rrr, rrp, rpr, prp, rpp, newton };
  Form form = Form::newton;
  std::vector<int> links;   // of a dyad: its first and its second
  std::vector<int> joints;  // of a dyad: the first's outer one, the inner one, the second's outer one
  int group_class = 2;      // II: dyads; III: a link with three joints or more; IV …: sides of the closed contour
  int order = 2;            // joints to the links before it
  int superfluous = 0;      // 2 p − 3 n: equations that say nothing new if the linkage moves at all

  bool is_dyad() const { return form != Form::newton; }
};

struct LinkageStructure {
  int bearing = -1;  // point of the driving link's bearing
  SketchAxes axes;
  std::vector<LinkageJoint> joints;  // the driving link's bearing first, then those that others have on that link
  std::vector<AssurGroup> groups;
  std::vector<int> order;  // links: the driving one, then group by group
  int freedom = 0;         // 3 n − 2 p of the whole linkage
};

// Joints and groups. What keeps the driving link from moving all others, and nothing else, goes into the faults.
LinkageStructure structure_of(const LinkageSketch& sketch, LinkageFaults& faults);

// "RRR", "class III of order 3"
std::string name_of(const AssurGroup& group);
// "1 closure more than they need"
std::string superfluous_of(const AssurGroup& group);
// "coupler, rocker"
std::string links_of(const AssurGroup& group, const LinkageSketch& sketch);

}  // namespace kurbel
