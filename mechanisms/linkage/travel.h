// travel.h — travel of a spring, force or torque within a linkage over the driving link's angle: a distance, a displacement,
// a path or a rotation.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanisms/linkage/linkage.h"

namespace kurbel {

// A force F along the travel s does the work F ds. It acts on `to`, and its reaction on `from`.
struct LinkageTravel {
  enum class Of {
    distance,  // |to − from| [m]; a positive force pushes the points apart
    way,       // of `to` along a fixed direction [m], from the driving link's bearing
    path,      // of `to` along its own path [m]: only its rate is defined
    rotation   // of the link of `to` relative to that of `from` [rad], 0 in the sketch
  };
  struct Place {
    int body = LinkageSketch::frame, point = -1;
  };
  Of of = Of::distance;
  Place from, to;
  double angle = 0;  // direction of a `way`, from +x of the sketch [rad]

  bool rocks() const { return of == Of::rotation; }
};

// s as a series in φ; for a path the value is 0. If the point of a path turns about a bearing or slides on the frame, the
// rate is signed and passes through zero; else it is the speed of the point.
Taylor travel_series(const Linkage& linkage, const LinkPoses& poses, const LinkageTravel& travel);

// Action on a body of a unit force or torque along a travel.
struct TravelAction {
  int body = 0;
  SketchSpot at, force;  // in the present pose, in the mechanism's axes [m], [1]
  long double moment = 0;
};
std::vector<TravelAction> travel_actions(const Linkage& linkage, const LinkPoses& poses, const LinkageTravel& travel);

// What guides the point of a path and gives its rate a sign: a bearing it turns about, a line it slides on, or neither.
struct PathGuide {
  std::optional<int> bearing;           // a point of the frame
  std::optional<SketchSpot> direction;  // a unit vector
};
PathGuide path_guide(const Linkage& linkage, const LinkageTravel& travel);

// The reason why the travel cannot be used, with the position; empty: it can. Checks a cycle; takes milliseconds.
std::string fault_of(const Linkage& linkage, const LinkageTravel& travel);

// Data of a mechanism without inertia, whose output is the travel.
struct LinkageTravelData {
  std::shared_ptr<const Linkage> linkage;  // without faults
  LinkageTravel travel;
  double gravity = 0;  // always 0
};
std::vector<double> values_of(const LinkageTravelData& data);
std::optional<CrankArc> arc_of(const LinkageTravelData& data);
std::string locks_of(const LinkageTravelData& data);

}  // namespace kurbel
