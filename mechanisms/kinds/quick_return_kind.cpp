// quick_return_kind.cpp — the keys of shaper and Whitworth mechanism.
#include "mechanisms/kinds/kinds.h"
#include "mechanisms/kinds/mechanism_keys.h"

namespace kurbel {
namespace {

using Shaper = QuickReturnData;

Fields<Shaper> lengths() {
  return Fields<Shaper>()
      .add(required("radius", "m", positive, "crank radius r", "variable_inertia multibody"), &Shaper::radius)
      .add(required("pivot_distance", "m", positive,
                    "d of the lever's bearing from the crank axis, square to the stroke; > r: the lever rocks, sin γ = "
                    "r/d, forward and return take π + 2γ and π − 2γ; < r: it turns fully"),
           &Shaper::pivot_distance)
      .add(required("lever", "m", positive, "from the lever's bearing to its end, which the link is pinned to"),
           &Shaper::lever)
      .add(defaulted("lever_angle", "rad", "0 deg", any_number,
                     "of that end ahead of the slot; 180 deg in Whitworth's form"),
           &Shaper::lever_angle)
      .add(required("link", "m", positive,
                    "from the lever's end to the ram, longer than that end is ever away from the guide"),
           &Shaper::link)
      .add(defaulted("guide_height", "m", "0 m", any_number, "of the ram's line above the lever's bearing"),
           &Shaper::guide_height)
      .add(choice("branch", "forward", "direction of the link along the stroke, from the lever's end to the ram"),
           &Shaper::backward, {{"forward", false}, {"backward", true}});
}

Fields<Shaper> shaper_linkage() {
  return lengths()
      .add(pivoted_link("crank", "from the axis towards the pin; negative: counterweighted"), &Shaper::crank_body)
      .add(pivoted_link("lever", "from its bearing along the slot"), &Shaper::lever_body)
      .add(mass_key("block_mass", "mass of the block on the crank pin"), &Shaper::block_mass)
      .add(defaulted("block_inertia", "kg*m2", "0 kg*m2", not_negative,
                     "of the block about the pin; it turns with the lever"),
           &Shaper::block_inertia)
      .add(floating_link("link", "from the lever's end"), &Shaper::link_body, in_the_middle_of(&Shaper::link))
      .add(mass_key("ram_mass", "mass of the ram and what moves with it"), &Shaper::ram_mass)
      .add(gravity_key(), &Shaper::gravity)
      .add(defaulted("stroke_angle", "rad", "0 deg", any_number,
                     "direction of the stroke above the horizontal; the lever's bearing lies 90 deg behind it"),
           &Shaper::stroke_angle);
}

Fields<Mounted<Shaper>> quick_return_fields() {
  return mounted(shaper_linkage(), mounting("force on the ram, or a list of them", slider_loads()));
}

}  // namespace

Kind quick_return_kind() {
  return mounted_kind<quick_return_fields>(
      "quick-return",
      "crank and slotted lever that drive a ram: shaper (pivot_distance > radius) or Whitworth (pivot_distance < "
      "radius); φ = 0 with the crank along the stroke");
}

}  // namespace kurbel
