// clutch_kinds.cpp — what slips: friction clutch, torque limiter, one-way clutch, brake.
#include <fmt/format.h>

#include <cmath>

#include "drivetrain/couplings/coupling_keys.h"
#include "drivetrain/friction/clutch.h"
#include "drivetrain/friction/kinds.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

// Capacity as it is, or from plates and the force that presses them.
std::vector<Key> capacity_keys() {
  return {{.name = "torque", .unit = "N*m", .domain = positive, .doc = "torque M_k that it transmits while it slips"},
          {.name = "static_torque",
           .unit = "N*m",
           .domain = positive,
           .doc = "torque M_s that it holds without slipping; default: M_k"},
          {.name = "slope",
           .unit = "N*m*s/rad",
           .fallback = "\"0 N*m*s/rad\"",
           .doc = "change of M_k with the speed of slip; negative: falling"},
          {.name = "force",
           .unit = "N",
           .domain = positive,
           .doc = "axial force, with radii and friction, in place of torque"},
          {.name = "plates",
           .type = KeyType::integer,
           .fallback = "2",
           .domain = {.low = 1, .high = 200},
           .doc = "number of friction faces"},
          {.name = "friction_coefficient", .domain = positive, .doc = "μ while slipping"},
          {.name = "static_friction_coefficient", .domain = positive, .doc = "μ₀ at rest; default: μ"},
          {.name = "outer_radius", .unit = "m", .domain = positive, .doc = "of the friction faces"},
          {.name = "inner_radius", .unit = "m", .domain = not_negative, .doc = "of the friction faces"}};
}

struct Capacity {
  double kinetic = 0, breakaway = 0, slope = 0;
};

// M_k = n μ F r_m, r_m = ⅔ (r_o³ − r_i³)/(r_o² − r_i²): uniform pressure (Dubbel, G3).
Capacity capacity_of(const Section& s, Messages& messages) {
  const auto refuse = [&](const char* key, const std::string& text) {
    messages.add(s.where(key), fmt::format("{} \"{}\": {}", s.kind->name, s.name, text));
  };
  Capacity c{.slope = s.number("slope")};
  if (s.given("torque") == s.given("force")) {
    refuse("torque", s.given("torque") ? "\"torque\" and \"force\" both given; keep one"
                                       : "\"torque\" is missing; give it, or \"force\" with radii and friction");
    return c;
  }
  if (s.given("torque")) {
    for (const char* key : {"friction_coefficient", "static_friction_coefficient", "outer_radius", "inner_radius"})
      if (s.given(key)) refuse(key, fmt::format("\"{}\" belongs to \"force\", which is not given; drop it", key));
    c.kinetic = s.number("torque");
    c.breakaway = s.number_or("static_torque", c.kinetic);
  } else {
    for (const char* key : {"friction_coefficient", "outer_radius", "inner_radius"})
      if (!s.given(key)) refuse("force", fmt::format("\"{}\" is missing beside \"force\"", key));
    if (s.given("static_torque")) refuse("static_torque", "give static_friction_coefficient with \"force\"");
    const double outer = s.number_or("outer_radius", 1), inner = s.number_or("inner_radius", 0);
    if (inner >= outer) {
      refuse("inner_radius",
             fmt::format("inner_radius = {:g} mm; must be < outer_radius = {:g} mm", inner * 1e3, outer * 1e3));
      return c;
    }
    const double mean = 2.0 / 3 * (std::pow(outer, 3) - std::pow(inner, 3)) / (outer * outer - inner * inner);
    const double per_friction = s.number("plates") * s.number("force") * mean;
    const double friction = s.number_or("friction_coefficient", 0);
    c.kinetic = per_friction * friction;
    c.breakaway = per_friction * s.number_or("static_friction_coefficient", friction);
  }
  if (c.breakaway < c.kinetic)
    refuse(s.given("torque") ? "static_torque" : "static_friction_coefficient",
           fmt::format("it holds {:g} N·m at rest but {:g} N·m while it slips; static friction must be ≥ kinetic",
                       c.breakaway, c.kinetic));
  return c;
}

template <class Element>
void join_by(const Section& s, Network& net, Element element) {
  const int in = net.add_node(s.name, "in", s.number("inertia_in"));
  const int out = net.add_node(s.name, "out", s.number("inertia_out"));
  net.ports[s.name] = {in, out, {}};
  net.connect(in, out, 1, s.name, element);
}

void build_clutch(const Section& s, Network& net, Messages& messages) {
  const Capacity c = capacity_of(s, messages);
  join_by(s, net, FrictionClutch{c.kinetic, c.breakaway, c.slope});
}
void build_limiter(const Section& s, Network& net, Messages&) {
  const double limit = s.number("torque");
  join_by(s, net, FrictionClutch{limit * s.number("slipping_part"), limit, 0});
}
void build_one_way(const Section& s, Network& net, Messages&) { join_by(s, net, OneWayClutch{s.number("drag")}); }

void build_brake(const Section& s, Network& net, Messages& messages) {
  const Capacity c = capacity_of(s, messages);
  net.put(single_shaft(s, net), s.name, FrictionBrake{c.kinetic, c.breakaway, c.slope}, window_of(s, messages));
}

}  // namespace

std::vector<Kind> clutch_kinds() {
  return {
      {.name = "clutch",
       .doc = "friction clutch between two half inertias; an operating sequence engages and releases it",
       .placement = Placement::inline_two,
       .keys = joined(capacity_keys(), side_inertia_keys()),
       .build = build_clutch},
      {.name = "torque limiter",
       .doc = "slips at its limit, holds below it",
       .placement = Placement::inline_two,
       .keys = joined({{.name = "torque", .unit = "N*m", .domain = positive, .doc = "limit M_s", .required = true},
                       {.name = "slipping_part",
                        .fallback = "1",
                        .domain = {.low = 0, .high = 1},
                        .doc = "torque while it slips over the limit"}},
                      side_inertia_keys()),
       .build = build_limiter},
      {.name = "one-way clutch",
       .doc = "drives forwards only; the driven side may run ahead",
       .placement = Placement::inline_two,
       .keys = joined({{.name = "drag",
                        .unit = "N*m",
                        .fallback = "\"0 N*m\"",
                        .domain = not_negative,
                        .doc = "torque while the driven side runs ahead"}},
                      side_inertia_keys()),
       .build = build_one_way},
      {.name = "brake",
       .doc = "friction against the frame; an operating sequence applies it, without one it always brakes",
       .keys = joined(joined(capacity_keys(), {own_inertia_key()}), window_keys()),
       .build = build_brake},
  };
}

}  // namespace kurbel
