// translation_kinds.cpp — screw and nut, wedge, and a slide that a pinion, drum or pulley moves.
#include <fmt/format.h>

#include <cmath>

#include "drivetrain/gears/gear_train_keys.h"
#include "drivetrain/shared/inclined_plane.h"
#include "drivetrain/shared/kinds.h"
#include "drivetrain/shared/shared_keys.h"
#include "drivetrain/translation/slide.h"
#include "engine/model/network.h"
#include "engine/numerics/angles.h"

namespace kurbel {
namespace {

double degrees(double angle) { return angle * 180 / pi; }

// A shaft that drives the slide over a pair that loses power. The slide's node turns with the shaft; what passes
// between them is the torque that the shaft has to give, and the force on the slide times k.
void build_driven_slide(const Section& s, const SlideKeys& slide, double inertia, double per_radian,
                        const GearEfficiency* losses, Network& net) {
  const int in = net.add_node(s.name, "in", inertia);
  const int out = net.add_node(s.name, "out", 0);
  net.ports[s.name] = {in, in};
  join_gear(net, in, out, 1, s.name, losses);
  put_slide(slide, s.name, out, per_radian, net);
}

// --- screw ---

struct ScrewKeys {
  double lead = 0;                                // P [m]
  std::optional<double> diameter;                 // d₂ [m]
  double thread_angle = 0;                        // between the flanks [rad]
  std::optional<double> friction;                 // μ of the flanks
  std::optional<double> collar, collar_friction;  // d_c [m], μ_c
  EfficiencyKeys losses;
  double inertia = 0;  // [kg·m²]
  SlideKeys slide;

  double lead_angle() const { return std::atan(lead / (pi * diameter.value_or(lead))); }
  InclinedPlane thread() const {
    const double base = collar ? collar_friction.value_or(0) * *collar / *diameter : 0;
    return {lead_angle(), friction_angle_of_flanks(friction.value_or(0), thread_angle / 2), base};
  }
};

void check_screw(const Reading<ScrewKeys>& g) {
  using Keys = ScrewKeys;
  g.drop_without(&Keys::collar_friction, &Keys::collar);
  g.drop_without(&Keys::collar, &Keys::collar_friction);
  g.drop_without(&Keys::friction, &Keys::collar_friction);
  if (!g.friction) return;
  for (const auto& key : g.given_keys(&Keys::losses))
    if (key.starts_with("efficiency"))
      g.refuse(key,
               fmt::format("\"{}\" and friction_coefficient both given; keep one: friction gives the efficiency", key));
  if (!g.diameter) {
    g.refuse(&Keys::friction,
             "\"friction_coefficient\" needs \"mean_diameter\": the lead angle is that of the thread on it, tan γ = "
             "lead/(π d₂)");
    return;
  }
  const InclinedPlane thread = g.thread();
  if (thread.efficiency() <= 0)
    g.refuse(&Keys::friction, fmt::format("a lead angle of {:.4g} deg with a friction angle of {:.4g} deg lets the "
                                          "spindle drive nothing; they must add up to less than 90 deg",
                                          degrees(thread.angle), degrees(thread.friction_angle)));
}

Fields<ScrewKeys> screw_fields() {
  using Keys = ScrewKeys;
  return Fields<Keys>()
      .add(required("lead", "m", positive, "travel of the nut in a turn: pitch times starts"), &Keys::lead)
      .add(quantity("mean_diameter", "m", positive, "d₂; tan γ = lead/(π d₂)"), &Keys::diameter)
      .add(defaulted("thread_angle", "rad", "30 deg", {.low = 0, .high = 2, .high_open = true},
                     "between the flanks: 30 deg trapezoidal, 60 deg metric, 0 square"),
           &Keys::thread_angle)
      .add(quantity("friction_coefficient", "", {.low = 0, .high = 10},
                    "μ of the flanks: tan ρ′ = μ/cos(thread_angle/2), η = tan γ/tan(γ + ρ′) and tan(γ − ρ′)/tan γ; in "
                    "place of efficiencies",
                    "gear_losses"),
           &Keys::friction)
      .add(quantity("collar_diameter", "m", positive, "mean diameter of the thrust collar, with collar_friction",
                    "gear_losses"),
           &Keys::collar)
      .add(quantity("collar_friction", "", {.low = 0, .high = 10}, "μ_c of that collar: adds μ_c d_c/d₂ to tan(γ ± ρ′)",
                    "gear_losses"),
           &Keys::collar_friction)
      .add(efficiency_fields(), &Keys::losses)
      .add(inertia_key("\"0 kg*m2\"", "of the spindle"), &Keys::inertia)
      .add(slide_fields(), &Keys::slide)
      .check(check_screw);
}

void build_screw(const Section& s, const Reading<ScrewKeys>& g, Network& net) {
  if (!g.valid()) {
    single_shaft(s, g.inertia, net);
    return;
  }
  GearEfficiency losses = g.losses;
  if (g.friction) {
    losses.forwards = g.thread().efficiency();
    losses.backwards = g.thread().efficiency_back();
  }
  const bool lossy = g.friction || !g.given_keys(&ScrewKeys::losses).empty();
  build_driven_slide(s, g.slide, g.inertia, g.lead / (2 * pi), lossy ? &losses : nullptr, net);
}

// --- wedge ---

struct WedgeKeys {
  double angle = 0, radius = 0;                 // γ [rad], r [m]
  std::optional<double> friction, base, guide;  // μ of slope, base, guide
  double inertia = 0, wedge_mass = 0;           // [kg·m²], [kg]
  SlideKeys slide;

  InclinedPlane plane() const {
    return {angle, std::atan(friction.value_or(0)), base.value_or(friction.value_or(0)), guide.value_or(0)};
  }
};

void check_wedge(const Reading<WedgeKeys>& g) {
  using Keys = WedgeKeys;
  g.drop_without(&Keys::friction, &Keys::base, &Keys::guide);
  const InclinedPlane plane = g.plane();
  if (g.friction && plane.efficiency() <= 0)
    g.refuse(&Keys::friction, fmt::format("a wedge of {:.4g} deg with a friction angle of {:.4g} deg{} lifts nothing, "
                                          "however hard it is pushed; make it flatter or smoother",
                                          degrees(plane.angle), degrees(plane.friction_angle),
                                          plane.guide > 0 ? " and that guide" : ""));
}

Fields<WedgeKeys> wedge_fields() {
  using Keys = WedgeKeys;
  return Fields<Keys>()
      .add(required("wedge_angle", "rad", {.low = 0, .high = 1.57, .low_open = true, .high_open = true},
                    "γ: pushed by s, the wedge lifts the slide by s tan γ"),
           &Keys::angle)
      .add(required("radius", "m", positive,
                    "of the pinion on the shaft that pushes the wedge by its rack; of a screw lead/(2 π)"),
           &Keys::radius)
      .add(quantity("friction_coefficient", "", {.low = 0, .high = 10},
                    "μ of the slope: the push is V (tan(γ ± ρ) ± μ_b), ρ = atan μ", "gear_losses"),
           &Keys::friction)
      .add(quantity("base_friction", "", {.low = 0, .high = 10},
                    "μ_b of the wedge on its base; default: friction_coefficient", "gear_losses"),
           &Keys::base)
      .add(quantity("side_friction", "", {.low = 0, .high = 10},
                    "μ_g of the slide in its guide, which the wedge pushes it against; default: none", "gear_losses"),
           &Keys::guide)
      .add(inertia_key("\"0 kg*m2\"", "of the shaft with its pinion"), &Keys::inertia)
      .add(defaulted("wedge_mass", "kg", "0 kg", not_negative, "of the wedge"), &Keys::wedge_mass)
      .add(slide_fields(), &Keys::slide)
      .check(check_wedge);
}

void build_wedge(const Section& s, const Reading<WedgeKeys>& g, Network& net) {
  if (!g.valid()) {
    single_shaft(s, g.inertia, net);
    return;
  }
  const InclinedPlane plane = g.plane();
  const GearEfficiency losses{plane.efficiency(), plane.efficiency_back()};
  build_driven_slide(s, g.slide, g.inertia + g.wedge_mass * g.radius * g.radius, g.radius * std::tan(g.angle),
                     g.friction ? &losses : nullptr, net);
}

// --- slide on a pinion or drum ---

struct RackKeys {
  double radius = 0;   // r [m]
  double inertia = 0;  // [kg·m²]
  SlideKeys slide;
};

Fields<RackKeys> rack_fields() {
  return Fields<RackKeys>()
      .add(required("radius", "m", positive, "of the pinion, chain wheel or drum: s = r φ"), &RackKeys::radius)
      .add(own_inertia_key(), &RackKeys::inertia)
      .add(slide_fields(), &RackKeys::slide);
}

void build_rack(const Section& s, const Reading<RackKeys>& g, Network& net) {
  put_slide(g.slide, s.name, single_shaft(s, g.inertia, net), g.radius, net);
}

}  // namespace

std::vector<Kind> translation_kinds() {
  return {
      kind_of<screw_fields, build_screw>(on_a_shaft, "screw",
                                         "spindle and nut (jack, spindle press, lead screw): turns into travel, with "
                                         "the friction of thread and collar; mass and forces of what the nut moves"),
      kind_of<wedge_fields, build_wedge>(on_a_shaft, "wedge",
                                         "a wedge that a pinion pushes under a slide: friction on slope, base and "
                                         "guide; mass and forces of the slide"),
      kind_of<rack_fields, build_rack>(on_a_shaft, "slide",
                                       "a body on a line, level or inclined, that a pinion, chain or drum moves"),
  };
}

}  // namespace kurbel
