// knuckle_press_kind.cpp — the keys of the knuckle-joint (toggle) press.
#include "mechanisms/kinds/kinds.h"
#include "mechanisms/kinds/load_kinds.h"
#include "mechanisms/kinds/mechanism_keys.h"

namespace kurbel {
namespace {

void build_knuckle_press(const Section& s, Network& net, Messages& messages) {
  KnucklePressData d;
  d.radius = s.number("radius");
  d.rod = s.number("rod");
  d.bearing_x = s.number("bearing_x");
  d.bearing_y = s.number("bearing_y");
  d.upper = s.number("upper");
  d.lower = s.number("lower");
  d.guide = s.number_or("guide", d.bearing_y);
  d.knee_right = s.text("branch") == "right";
  d.crank_body = read_link(s, "crank");
  d.rod_body = read_link(s, "rod", d.rod / 2);
  d.upper_body = read_link(s, "upper");
  d.lower_body = read_link(s, "lower", d.lower / 2);
  d.ram_mass = s.number("ram_mass");
  d.gravity = s.number("gravity");
  d.stroke_angle = s.number("stroke_angle");
  build_mechanism(s, d, faults_of(d), net, messages);
}

}  // namespace

Kind knuckle_press_kind() {
  return {
      .name = "knuckle press",
      .doc =
          "crank and rod work a knee joint between an upper link on a fixed bearing and a lower link to the ram; "
          "x runs along the stroke, y 90 deg ahead of it, both from the crank axis; φ = 0 with the crank along x",
      .keys = joined(
          {{{.name = "radius",
             .unit = "m",
             .domain = positive,
             .doc = "crank radius r",
             .required = true,
             .effect = "variable_inertia multibody"},
            {.name = "rod", .unit = "m", .domain = positive, .doc = "from the crank pin to the knee", .required = true},
            {.name = "bearing_x",
             .unit = "m",
             .doc = "place of the upper link's bearing along the stroke",
             .required = true},
            {.name = "bearing_y",
             .unit = "m",
             .doc = "place of the upper link's bearing across the stroke",
             .required = true},
            {.name = "upper", .unit = "m", .domain = positive, .doc = "from its bearing to the knee", .required = true},
            {.name = "lower", .unit = "m", .domain = positive, .doc = "from the knee to the ram", .required = true},
            {.name = "guide", .unit = "m", .doc = "y of the ram's line; default: through the upper link's bearing"},
            {.name = "branch",
             .type = KeyType::text,
             .fallback = "\"left\"",
             .doc = "side of the knee, seen from the crank axis towards the upper link's bearing",
             .choices = {"left", "right"}}},
           pivoted_link_keys("crank", "from the axis towards the pin; negative: counterweighted"),
           floating_link_keys("rod", "from the crank pin"),
           pivoted_link_keys("upper", "from its bearing towards the knee"),
           floating_link_keys("lower", "from the knee"),
           {mass_key("ram_mass", "mass of the ram and what moves with it"),
            gravity_key(),
            {.name = "stroke_angle",
             .unit = "rad",
             .fallback = "\"0 deg\"",
             .doc = "direction of x above the horizontal; -90 deg: the ram works downwards"},
            phase_key(),
            load_key("force on the ram, or a list of them", slider_load_kinds())}}),
      .build = build_knuckle_press};
}

}  // namespace kurbel
