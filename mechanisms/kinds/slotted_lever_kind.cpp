// slotted_lever_kind.cpp — the keys of the inverted slider-crank.
#include "mechanisms/kinds/kinds.h"
#include "mechanisms/kinds/mechanism_keys.h"

namespace kurbel {
namespace {

using Lever = SlottedLeverData;

Fields<Lever> slotted_lever_linkage() {
  return Fields<Lever>()
      .add(required("crank", "m", positive, "crank length r, from the crank axis to its pin, which carries the block",
                    "variable_inertia multibody"),
           &Lever::crank)
      .add(required("ground", "m", positive,
                    "distance d of the two bearings; > r: the lever rocks by 2 arcsin(r/d); < r: it rotates with the "
                    "crank; = r: once in two turns of the crank, through a change point"),
           &Lever::ground)
      .add(pivoted_link("crank", "from the axis towards the pin; negative: counterweighted"), &Lever::crank_body)
      .add(pivoted_link("lever", "from its bearing along the slot; negative: counterweighted"), &Lever::lever_body)
      .add(mass_key("block_mass", "mass of the block on the crank pin"), &Lever::block_mass)
      .add(defaulted("block_inertia", "kg*m2", "0 kg*m2", not_negative,
                     "of the block about the pin; it turns with the lever"),
           &Lever::block_inertia)
      .add(gravity_key(), &Lever::gravity)
      .add(defaulted("ground_angle", "rad", "0 deg", any_number,
                     "direction from the crank axis to the lever's bearing, above the horizontal"),
           &Lever::ground_angle);
}

Fields<Mounted<Lever>> slotted_lever_fields() {
  return mounted(slotted_lever_linkage(), mounting("torque on the lever, or a list of them", rocker_loads()));
}

}  // namespace

Kind slotted_lever_kind() {
  return mounted_kind<slotted_lever_fields>("inverted slider-crank",
                                            "crank, block on its pin and slotted lever, which the loads act on; φ = 0 "
                                            "with the crank towards the lever's bearing");
}

}  // namespace kurbel
