// linkage.h — a planar linkage over the angle of its driving link: poses of the links, range of the driving link.
//
// φ is the angle of the driving link from +x of the sketch, counter-clockwise, measured at the line from its bearing to the
// next of its points. Axes of the mechanism: origin in that bearing; +x along the output's direction, for a rocking output
// +x of the sketch.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanisms/linkage/assur_groups.h"
#include "mechanisms/linkage/dyads.h"
#include "mechanisms/linkage/newton_group.h"
#include "mechanisms/loops/loops.h"

namespace kurbel {

// The minimum margin of a dyad along the motion (dyads.h), and its φ.
struct LeastMargin {
  long double margin = 1, phi = 0;  // 1, [rad]
};

class Linkage {
 public:
  // Finds the structure, follows the motion over a turn of the driving link, fills faults(); takes some milliseconds.
  explicit Linkage(LinkageSketch sketch);

  const LinkageFaults& faults() const { return faults_; }
  const LinkageSketch& sketch() const { return sketch_; }

  // --- for linkages without faults ---
  const LinkageStructure& structure() const { return structure_; }
  long double drawn_at() const { return drawn_at_; }           // φ of the sketch [rad]
  const std::optional<CrankArc>& arc() const { return arc_; }  // range of a driving link that locks, else empty
  int turns() const { return turns_; }                         // turns of the driving link in a cycle
  // Poses of all links. Throws std::runtime_error with the group and φ if the linkage cannot be closed there.
  LinkPoses poses(long double phi) const;

  // Of a linkage that passes change points, a sine with simple zeros there; else empty.
  std::optional<Taylor> change_sine(const LinkPoses& poses) const;
  bool change_turns_over() const;  // whether the determinant of its closures changes its sign with it

  SketchSpot spot_of(int point) const;      // a point of the sketch in the mechanism's axes [m]
  SketchSpot centre_of(int link) const;     // centre of mass [m]
  SketchSpot direction_of(int link) const;  // unit vector from its first to its second point; +x if it has one point
  int output_point() const;                 // of a rocking output: its bearing, else its first point
  const std::vector<LeastMargin>& least_margins() const { return least_; }  // in the order of the groups; only dyads

  // Names of a link and of a joint ("pin A", "slide ram"), valid as long as the program runs.
  const char* link_name(int link) const { return link_names_[static_cast<std::size_t>(link)]; }
  const char* joint_name(std::size_t joint) const { return joint_names_[joint]; }

  // "class II: RRR (coupler, rocker), RRP (rod, ram); degrees of freedom 3·5 − 2·7 = 1"
  std::string structure_in_words() const;
  // Position in which the driving link locks, such as "coupler and rocker lie in one line".
  std::string locks_in_words() const;
  // What of the sketch was moved within its rounding, and why; empty: nothing.
  const std::string& moved_in_words() const { return moved_; }
  // "transmission angle of RRR (coupler, rocker) at least 41.2° (φ = 0°)"
  std::vector<std::string> transmission_in_words() const;

 private:
  using Shifts = std::vector<std::vector<LinkShift>>;  // by group; empty of one that is not followed by Newton's method
  struct Node {
    long double phi = 0;
    Shifts shifts;
  };
  struct Closed {
    explicit Closed(std::size_t links) : poses(links) {}
    LinkPoses poses;
    Shifts shifts;
    std::vector<long double> margin;  // by group; of groups solved by Newton's method the square of its pivot
    int failed = -1;                  // the group that cannot be closed
  };
  bool check();
  bool check_links();
  Closed close(long double phi, const Shifts& start) const;
  bool close_group(std::size_t k, Closed& out) const;
  Shifts predicted(const Node& from, long double phi) const;
  Shifts start_near(long double phi) const;
  bool start_at_sketch(Node& node);
  void take_as_parallel();
  void find_change_point(AssurGroup& group, const LinkPoses& drawn, std::optional<Taylor>& first) const;
  void close_in_parallel();
  struct Way {
    std::vector<Node> nodes;
    std::optional<Closed> stopped;  // the position that could not be closed
  };
  Way march(const Node& from, long double angle) const;
  void explore();
  bool comes_back(const Node& begin, const Node& end) const;
  void find_margins();
  void refuse(const std::string& at, std::string text) { faults_.push_back({at, std::move(text)}); }
  bool touches(const Way& way, long double sense) const;
  // Of the size, and of a radian.
  bool is_near(const std::vector<LinkShift>& a, const std::vector<LinkShift>& b, long double apart) const;
  int first_astray(const Closed& closed, const Shifts& start, long double apart) const;
  std::string undetermined(const AssurGroup& group) const;
  void refuse_stop(const Closed& stopped, long double phi);
  void refuse_change_point(int group, long double phi);
  std::string stop_in_words(const Closed& stopped) const;

  LinkageSketch sketch_;
  LinkageStructure structure_;
  LinkageFaults faults_;
  std::vector<const char*> link_names_, joint_names_;
  long double drawn_at_ = 0, size_ = 0;
  std::vector<Node> nodes_;  // ascending in φ; over the cycle if the driving link turns fully
  std::optional<CrankArc> arc_;
  std::string lower_lock_, upper_lock_, moved_;
  int turns_ = 1;
  std::vector<LeastMargin> least_;
};

// Data of this kind of mechanism; copies share the linkage.
struct LinkageData {
  std::shared_ptr<const Linkage> linkage;  // without faults
  double gravity = 0;                      // [m/s²], ≥ 0
};
std::vector<double> values_of(const LinkageData& data);  // all of them
std::optional<CrankArc> arc_of(const LinkageData& data);
std::string locks_of(const LinkageData& data);
int turns_of(const LinkageData& data);
// φ of the sketch, of one in a change point beside it [rad]
double drawn_at(const LinkageData& data);
// The reason why reactions are undetermined; empty: they are determined.
std::string undetermined_reactions(const LinkageData& data);

}  // namespace kurbel
