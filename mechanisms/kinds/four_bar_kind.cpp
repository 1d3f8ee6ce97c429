// four_bar_kind.cpp — the four-bar linkage's keys.
#include "mechanisms/kinds/kinds.h"
#include "mechanisms/kinds/mechanism_keys.h"

namespace kurbel {
namespace {

using FourBar = FourBarData;

Fields<FourBar> four_bar_linkage() {
  return Fields<FourBar>()
      .add(required("crank", "m", positive, "crank length, from the crank axis to the crank pin",
                    "variable_inertia multibody"),
           &FourBar::crank)
      .add(required("coupler", "m", positive, "coupler length, between crank and rocker"), &FourBar::coupler)
      .add(required("rocker", "m", positive, "rocker length, from its bearing to the coupler"), &FourBar::rocker)
      .add(required("ground", "m", positive, "distance of the two bearings"), &FourBar::ground)
      .add(choice("branch", "open",
                  "how the loop is assembled: coupler pin left of the line from crank pin to rocker bearing, or right; "
                  "of links that pass change points, for 0 < φ < 180 deg"),
           &FourBar::crossed, {{"open", false}, {"crossed", true}})
      .add(pivoted_link("crank", "from the axis towards the pin; negative: counterweighted"), &FourBar::crank_body)
      .add(floating_link("coupler", "from the crank pin"), &FourBar::coupler_body, in_the_middle_of(&FourBar::coupler))
      .add(pivoted_link("rocker", "from its bearing towards the coupler; negative: counterweighted"),
           &FourBar::rocker_body)
      .add(gravity_key(), &FourBar::gravity)
      .add(defaulted("ground_angle", "rad", "0 deg", any_number,
                     "direction from the crank axis to the rocker's bearing, above the horizontal"),
           &FourBar::ground_angle);
}

Fields<Mounted<FourBar>> four_bar_fields() {
  return mounted(four_bar_linkage(), mounting("torque on the rocker, or a list of them", rocker_loads()));
}

}  // namespace

Kind four_bar_kind() {
  return mounted_kind<four_bar_fields>(
      "four-bar",
      "crank, coupler and rocker on the ground link: crank–rocker, drag link (both turn), parallelogram, kite; a crank "
      "that cannot turn fully rocks within its arc, where the run ends if it is reached; the loads act on the rocker; "
      "φ = 0 with the crank towards the rocker's bearing");
}

}  // namespace kurbel
