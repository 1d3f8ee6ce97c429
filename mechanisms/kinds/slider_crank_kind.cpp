// slider_crank_kind.cpp — the slider-crank's keys.
#include <fmt/format.h>

#include <cmath>

#include "mechanisms/kinds/deformation_keys.h"
#include "mechanisms/kinds/joint_keys.h"
#include "mechanisms/kinds/kinds.h"
#include "mechanisms/kinds/load_kinds.h"
#include "mechanisms/kinds/mechanism_keys.h"

namespace kurbel {
namespace {

// The rod must pass both dead centres, and no body may have less inertia than its mass demands.
DataFaults faults_of(const SliderCrankData& d) {
  DataFaults faults;
  const double reach = d.radius + std::abs(d.offset);
  if (!(d.rod_length > reach))
    faults.push_back(
        {"rod", fmt::format("rod = {}; must be > radius + |offset| = {} + {} = {}, else the crank cannot turn fully; "
                            "lengthen the rod or shorten the crank",
                            in_mm(d.rod_length), in_mm(d.radius), in_mm(std::abs(d.offset)), in_mm(reach))});
  const double least = d.crank_mass * d.crank_com * d.crank_com;
  if (d.crank_inertia < least * (1 - 1e-12))
    faults.push_back({"crank_inertia", fmt::format("crank_inertia = {:.6g} kg·m²; is about the axis and must be ≥ "
                                                   "crank_mass · crank_com² = {:.6g} kg·m²",
                                                   d.crank_inertia, least)});
  return faults;
}

void build_slider_crank(const Section& s, Network& net, Messages& messages) {
  const SliderCrankData d = slider_crank_data(s);
  const DataFaults faults = faults_of(d);
  std::shared_ptr<const SliderCrankStatics> joints;
  if (check_joints(s, messages) && faults.empty())
    if (const SliderCrankJoints given = slider_crank_joints(s); !given.frictionless())
      joints = std::make_shared<SliderCrankStatics>(d, given);
  build_mechanism(s, d, faults, net, messages, std::move(joints), read_deformation(s, d, messages));
}

}  // namespace

Kind slider_crank_kind() {
  Kind kind{
      .name = "slider-crank",
      .doc = "crank, rod and slider; φ = 0 with the crank along the stroke (extended, without offset)",
      .keys =
          {{.name = "radius",
            .unit = "m",
            .domain = positive,
            .doc = "crank radius r",
            .required = true,
            .effect = "variable_inertia multibody"},
           {.name = "rod",
            .unit = "m",
            .domain = positive,
            .doc = "rod length l, > radius + |offset|",
            .required = true},
           {.name = "offset", .unit = "m", .fallback = "\"0 m\"", .doc = "of the slider's line from the crank axis"},
           {.name = "crank_mass",
            .unit = "kg",
            .fallback = "\"0 kg\"",
            .domain = not_negative,
            .doc = "mass of the crank"},
           {.name = "crank_com",
            .unit = "m",
            .fallback = "\"0 m\"",
            .doc = "its centre of mass from the axis towards the pin; negative: counterweighted"},
           {.name = "crank_inertia",
            .unit = "kg*m2",
            .fallback = "\"0 kg*m2\"",
            .domain = not_negative,
            .doc = "about the crank's axis"},
           {.name = "rod_mass", .unit = "kg", .fallback = "\"0 kg\"", .domain = not_negative, .doc = "mass of the rod"},
           {.name = "rod_com",
            .unit = "m",
            .doc = "its centre of mass from the crank pin along the rod; default: half the rod"},
           {.name = "rod_inertia",
            .unit = "kg*m2",
            .fallback = "\"0 kg*m2\"",
            .domain = not_negative,
            .doc = "about its centre of mass"},
           {.name = "slider_mass",
            .unit = "kg",
            .fallback = "\"0 kg\"",
            .domain = not_negative,
            .doc = "mass of slider and what moves with it"},
           gravity_key(),
           {.name = "stroke_angle",
            .unit = "rad",
            .fallback = "\"0 deg\"",
            .doc = "direction from crank axis to extended end, above the horizontal: 90 deg slider on top, -90 deg "
                   "top-driven press"},
           phase_key(),
           load_key("force on the slider, or a list of them", slider_load_kinds())},
      .build = build_slider_crank};
  kind.keys = joined({kind.keys, slider_crank_joint_keys(), slider_crank_deformation_keys()});
  return kind;
}

}  // namespace kurbel
