// four_bar_kind.cpp — the four-bar linkage's keys.
#include "mechanisms/kinds/kinds.h"
#include "mechanisms/kinds/load_kinds.h"
#include "mechanisms/kinds/mechanism_keys.h"

namespace kurbel {
namespace {

void build_four_bar(const Section& s, Network& net, Messages& messages) {
  FourBarData d;
  d.crank = s.number("crank");
  d.coupler = s.number("coupler");
  d.rocker = s.number("rocker");
  d.ground = s.number("ground");
  d.crossed = s.text("branch") == "crossed";
  d.crank_body = read_link(s, "crank");
  d.coupler_body = read_link(s, "coupler", d.coupler / 2);
  d.rocker_body = read_link(s, "rocker");
  d.gravity = s.number("gravity");
  d.ground_angle = s.number("ground_angle");
  build_mechanism(s, d, faults_of(d), net, messages);
}

}  // namespace

Kind four_bar_kind() {
  return {.name = "four-bar",
          .doc =
              "crank, coupler and rocker on the ground link (crank–rocker); the loads act on the rocker; φ = 0 with "
              "the crank towards the rocker's bearing",
          .keys = joined(
              {{{.name = "crank",
                 .unit = "m",
                 .domain = positive,
                 .doc = "crank length, from the crank axis to the crank pin",
                 .required = true,
                 .effect = "variable_inertia multibody"},
                {.name = "coupler",
                 .unit = "m",
                 .domain = positive,
                 .doc = "coupler length, between crank and rocker",
                 .required = true},
                {.name = "rocker",
                 .unit = "m",
                 .domain = positive,
                 .doc = "rocker length, from its bearing to the coupler",
                 .required = true},
                {.name = "ground",
                 .unit = "m",
                 .domain = positive,
                 .doc = "distance of the two bearings",
                 .required = true},
                {.name = "branch",
                 .type = KeyType::text,
                 .fallback = "\"open\"",
                 .doc = "how the loop is assembled: rocker left of the line from crank axis to its bearing, or right",
                 .choices = {"open", "crossed"}}},
               pivoted_link_keys("crank", "from the axis towards the pin; negative: counterweighted"),
               floating_link_keys("coupler", "from the crank pin"),
               pivoted_link_keys("rocker", "from its bearing towards the coupler; negative: counterweighted"),
               {gravity_key(),
                {.name = "ground_angle",
                 .unit = "rad",
                 .fallback = "\"0 deg\"",
                 .doc = "direction from the crank axis to the rocker's bearing, above the horizontal"},
                phase_key(),
                load_key("torque on the rocker, or a list of them", rocker_load_kinds())}}),
          .build = build_four_bar};
}

}  // namespace kurbel
