// knuckle_press_kind.cpp — the keys of the knuckle-joint (toggle) press.
#include "mechanisms/kinds/kinds.h"
#include "mechanisms/kinds/mechanism_keys.h"

namespace kurbel {
namespace {

using Press = KnucklePressData;

Fields<Press> knuckle_press_linkage() {
  return Fields<Press>()
      .add(required("radius", "m", positive, "crank radius r", "variable_inertia multibody"), &Press::radius)
      .add(required("rod", "m", positive, "from the crank pin to the knee"), &Press::rod)
      .add(required("bearing_x", "m", any_number, "place of the upper link's bearing along the stroke"),
           &Press::bearing_x)
      .add(required("bearing_y", "m", any_number, "place of the upper link's bearing across the stroke"),
           &Press::bearing_y)
      .add(required("upper", "m", positive, "from its bearing to the knee"), &Press::upper)
      .add(required("lower", "m", positive, "from the knee to the ram"), &Press::lower)
      .add(quantity("guide", "m", any_number, "y of the ram's line; default: through the upper link's bearing"),
           &Press::guide, &Press::bearing_y)
      .add(choice("branch", "left", "side of the knee, seen from the crank axis towards the upper link's bearing"),
           &Press::knee_right, {{"left", false}, {"right", true}})
      .add(pivoted_link("crank", "from the axis towards the pin; negative: counterweighted"), &Press::crank_body)
      .add(floating_link("rod", "from the crank pin"), &Press::rod_body, in_the_middle_of(&Press::rod))
      .add(pivoted_link("upper", "from its bearing towards the knee"), &Press::upper_body)
      .add(floating_link("lower", "from the knee"), &Press::lower_body, in_the_middle_of(&Press::lower))
      .add(mass_key("ram_mass", "mass of the ram and what moves with it"), &Press::ram_mass)
      .add(gravity_key(), &Press::gravity)
      .add(defaulted("stroke_angle", "rad", "0 deg", any_number,
                     "direction of x above the horizontal; -90 deg: the ram works downwards"),
           &Press::stroke_angle);
}

Fields<Mounted<Press>> knuckle_press_fields() {
  return mounted(knuckle_press_linkage(), mounting("force on the ram, or a list of them", slider_loads()));
}

}  // namespace

Kind knuckle_press_kind() {
  return mounted_kind<knuckle_press_fields>(
      "knuckle press",
      "crank and rod work a knee joint between an upper link on a fixed bearing and a lower link to the ram; "
      "x runs along the stroke, y 90 deg ahead of it, both from the crank axis; φ = 0 with the crank along x");
}

}  // namespace kurbel
