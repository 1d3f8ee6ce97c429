// travel.h — what a spring, a force or a torque within a linkage works along: a distance, a way, a path or a rotation, over
// the driving link's angle.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanisms/linkage/linkage.h"

namespace kurbel {

// A force F along the travel s does the work F ds: on `to`, with its opposite on `from`.
struct LinkageTravel {
  enum class Of {
    distance,  // |to − from| [m]; a positive force pushes the points apart
    way,       // of `to` along a direction that stands [m], from the driving link's bearing
    path,      // of `to` along its own path [m]: only its rate is known, not where it began
    rotation   // of the link of `to` against that of `from` [rad], 0 in the sketch
  };
  struct Place {
    int body = LinkageSketch::frame, point = -1;
  };
  Of of = Of::distance;
  Place from, to;
  double angle = 0;  // of a way's direction, from +x of the sketch [rad]

  bool rocks() const { return of == Of::rotation; }
};

// s as a series in φ; of a path its value is 0. Where a path's point hangs on a bearing or slides on the frame the rate
// goes through zero with the motion; else it is the point's speed.
Taylor travel_series(const Linkage& linkage, const LinkPoses& poses, const LinkageTravel& travel);

// How a unit of force or torque along a travel acts on a body.
struct TravelAction {
  int body = 0;
  SketchSpot at, force;  // where the bodies stand, in the mechanism's axes [m], [1]
  long double moment = 0;
};
std::vector<TravelAction> travel_actions(const Linkage& linkage, const LinkPoses& poses, const LinkageTravel& travel);

// Where the path's rate is measured along: a bearing that the point turns about, a line that it slides on, or neither.
struct PathGuide {
  std::optional<int> bearing;           // a point of the frame
  std::optional<SketchSpot> direction;  // a unit vector
};
PathGuide path_guide(const Linkage& linkage, const LinkageTravel& travel);

// Why nothing can be computed along it, with the place; empty: it can. Looks at a cycle; costs milliseconds.
std::string fault_of(const Linkage& linkage, const LinkageTravel& travel);

// As a kind of mechanism without inertia, whose output is the travel.
struct LinkageTravelData {
  std::shared_ptr<const Linkage> linkage;  // without faults
  LinkageTravel travel;
  double gravity = 0;  // of none
};
std::vector<double> values_of(const LinkageTravelData& data);
std::optional<CrankArc> arc_of(const LinkageTravelData& data);
std::string locks_of(const LinkageTravelData& data);

}  // namespace kurbel
