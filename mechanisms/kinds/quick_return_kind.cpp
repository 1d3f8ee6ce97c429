// quick_return_kind.cpp — the keys of shaper and Whitworth mechanism.
#include "mechanisms/kinds/kinds.h"
#include "mechanisms/kinds/load_kinds.h"
#include "mechanisms/kinds/mechanism_keys.h"

namespace kurbel {
namespace {

void build_quick_return(const Section& s, Network& net, Messages& messages) {
  QuickReturnData d;
  d.radius = s.number("radius");
  d.pivot_distance = s.number("pivot_distance");
  d.lever = s.number("lever");
  d.lever_angle = s.number("lever_angle");
  d.link = s.number("link");
  d.guide_height = s.number("guide_height");
  d.backward = s.text("branch") == "backward";
  d.crank_body = read_link(s, "crank");
  d.lever_body = read_link(s, "lever");
  d.block_mass = s.number("block_mass");
  d.block_inertia = s.number("block_inertia");
  d.link_body = read_link(s, "link", d.link / 2);
  d.ram_mass = s.number("ram_mass");
  d.gravity = s.number("gravity");
  d.stroke_angle = s.number("stroke_angle");
  build_mechanism(s, d, faults_of(d), net, messages);
}

std::vector<Key> geometry_keys() {
  return {{.name = "radius",
           .unit = "m",
           .domain = positive,
           .doc = "crank radius r",
           .required = true,
           .effect = "variable_inertia multibody"},
          {.name = "pivot_distance",
           .unit = "m",
           .domain = positive,
           .doc = "d of the lever's bearing from the crank axis, square to the stroke; > r: the lever rocks, sin γ = "
                  "r/d, forward and return take π + 2γ and π − 2γ; < r: it turns fully",
           .required = true},
          {.name = "lever",
           .unit = "m",
           .domain = positive,
           .doc = "from the lever's bearing to its end, which the link is pinned to",
           .required = true},
          {.name = "lever_angle",
           .unit = "rad",
           .fallback = "\"0 deg\"",
           .doc = "of that end ahead of the slot; 180 deg in Whitworth's form"},
          {.name = "link",
           .unit = "m",
           .domain = positive,
           .doc = "from the lever's end to the ram, longer than that end is ever away from the guide",
           .required = true},
          {.name = "guide_height",
           .unit = "m",
           .fallback = "\"0 m\"",
           .doc = "of the ram's line above the lever's bearing"},
          {.name = "branch",
           .type = KeyType::text,
           .fallback = "\"forward\"",
           .doc = "direction of the link along the stroke, from the lever's end to the ram",
           .choices = {"forward", "backward"}}};
}

}  // namespace

Kind quick_return_kind() {
  return {
      .name = "quick-return",
      .doc =
          "crank and slotted lever that drive a ram: shaper (pivot_distance > radius) or Whitworth (pivot_distance < "
          "radius); φ = 0 with the crank along the stroke",
      .keys =
          joined({geometry_keys(),
                  pivoted_link_keys("crank", "from the axis towards the pin; negative: counterweighted"),
                  pivoted_link_keys("lever", "from its bearing along the slot"),
                  {mass_key("block_mass", "mass of the block on the crank pin"),
                   {.name = "block_inertia",
                    .unit = "kg*m2",
                    .fallback = "\"0 kg*m2\"",
                    .domain = not_negative,
                    .doc = "of the block about the pin; it turns with the lever"}},
                  floating_link_keys("link", "from the lever's end"),
                  {mass_key("ram_mass", "mass of the ram and what moves with it"),
                   gravity_key(),
                   {.name = "stroke_angle",
                    .unit = "rad",
                    .fallback = "\"0 deg\"",
                    .doc = "direction of the stroke above the horizontal; the lever's bearing lies 90 deg behind it"},
                   phase_key(),
                   load_key("force on the ram, or a list of them", slider_load_kinds())}}),
      .build = build_quick_return};
}

}  // namespace kurbel
