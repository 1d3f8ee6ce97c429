// clutch_kinds.cpp — what slips: friction clutch, torque limiter, one-way clutch, brake.
#include <fmt/format.h>

#include <cmath>

#include "drivetrain/couplings/coupling_keys.h"
#include "drivetrain/friction/clutch.h"
#include "drivetrain/shared/kinds.h"
#include "drivetrain/shared/rating_keys.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

// Capacity as it is, or from plates and the force that presses them.
struct Capacity {
  double kinetic = 0, breakaway = 0, slope = 0;  // M_k, M_s [N·m], [N·m·s/rad]
};
struct CapacityKeys : Capacity {
  std::optional<double> torque, static_torque;       // M_k, M_s [N·m]
  std::optional<double> force;                       // F [N]
  int plates = 2;                                    // n
  std::optional<double> friction, static_friction;   // μ, μ₀
  std::optional<double> outer_radius, inner_radius;  // [m]

  double outer() const { return outer_radius.value_or(1); }
  double inner() const { return inner_radius.value_or(0); }
};

// M_k = n μ F r_m, r_m = ⅔ (r_o³ − r_i³)/(r_o² − r_i²): uniform pressure (Dubbel, G3).
void settle(CapacityKeys& c) {
  if (c.torque) {
    c.kinetic = *c.torque;
    c.breakaway = c.static_torque.value_or(c.kinetic);
  } else if (c.force && c.inner() < c.outer()) {
    const double outer = c.outer(), inner = c.inner();
    const double mean = 2.0 / 3 * (std::pow(outer, 3) - std::pow(inner, 3)) / (outer * outer - inner * inner);
    const double per_friction = c.plates * *c.force * mean;
    c.kinetic = per_friction * c.friction.value_or(0);
    c.breakaway = per_friction * c.static_friction.value_or(c.friction.value_or(0));
  }
}

void check_plates(const Reading<CapacityKeys>& c) {
  using Keys = CapacityKeys;
  for (const auto member : {&Keys::friction, &Keys::outer_radius, &Keys::inner_radius})
    if (!(c.*member)) c.refuse(&Keys::force, fmt::format("\"{}\" is missing beside \"force\"", c.key(member)));
  if (c.static_torque) c.refuse(&Keys::static_torque, "give static_friction_coefficient with \"force\"");
  if (c.inner() >= c.outer())
    c.refuse(&Keys::inner_radius,
             fmt::format("inner_radius = {:g} mm; must be < outer_radius = {:g} mm", c.inner() * 1e3, c.outer() * 1e3));
}

void check_capacity(const Reading<CapacityKeys>& c) {
  using Keys = CapacityKeys;
  if (c.torque.has_value() == c.force.has_value()) {
    c.refuse(&Keys::torque, c.torque ? "\"torque\" and \"force\" both given; keep one"
                                     : "\"torque\" is missing; give it, or \"force\" with radii and friction");
    return;
  }
  if (c.force)
    check_plates(c);
  else
    c.drop_without(&Keys::force, &Keys::friction, &Keys::static_friction, &Keys::outer_radius, &Keys::inner_radius);
  if (c.breakaway < c.kinetic)
    c.refuse(c.torque ? &Keys::static_torque : &Keys::static_friction,
             fmt::format("it holds {:g} N·m at rest but {:g} N·m while it slips; static friction must be ≥ kinetic",
                         c.breakaway, c.kinetic));
}

Fields<CapacityKeys> capacity_fields() {
  using Keys = CapacityKeys;
  return Fields<Keys>()
      .add(quantity("torque", "N*m", positive, "torque M_k that it transmits while it slips"), &Keys::torque)
      .add(quantity("static_torque", "N*m", positive, "torque M_s that it holds without slipping; default: M_k"),
           &Keys::static_torque)
      .add(defaulted("slope", "N*m*s/rad", "0 N*m*s/rad", any_number,
                     "change of M_k with the speed of slip; negative: falling"),
           &Keys::slope)
      .add(quantity("force", "N", positive, "axial force, with radii and friction, in place of torque"), &Keys::force)
      .add(defaulted("plates", "", "2", {.low = 1, .high = 200}, "number of friction faces"), &Keys::plates)
      .add(quantity("friction_coefficient", "", positive, "μ while slipping"), &Keys::friction)
      .add(quantity("static_friction_coefficient", "", positive, "μ₀ at rest; default: μ"), &Keys::static_friction)
      .add(quantity("outer_radius", "m", positive, "of the friction faces"), &Keys::outer_radius)
      .add(quantity("inner_radius", "m", not_negative, "of the friction faces"), &Keys::inner_radius)
      .derive(settle)
      .check(check_capacity);
}

struct ClutchKeys {
  Capacity capacity;
  HeatRating heat;
  SideInertias inertia;
};
Fields<ClutchKeys> clutch_fields() {
  return Fields<ClutchKeys>()
      .add(capacity_fields(), &ClutchKeys::capacity)
      .add(heat_rating_fields(), &ClutchKeys::heat)
      .add(side_inertia_fields(), &ClutchKeys::inertia);
}

struct LimiterKeys {
  double torque = 0, slipping_part = 1;  // M_s [N·m]
  HeatRating heat;
  SideInertias inertia;
};
Fields<LimiterKeys> limiter_fields() {
  return Fields<LimiterKeys>()
      .add(required("torque", "N*m", positive, "limit M_s"), &LimiterKeys::torque)
      .add(defaulted("slipping_part", "", "1", {.low = 0, .high = 1}, "torque while it slips over the limit"),
           &LimiterKeys::slipping_part)
      .add(heat_rating_fields(), &LimiterKeys::heat)
      .add(side_inertia_fields(), &LimiterKeys::inertia);
}

struct OneWayKeys : OneWayClutch {
  SideInertias inertia;
};
Fields<OneWayKeys> one_way_fields() {
  return Fields<OneWayKeys>()
      .add(defaulted("drag", "N*m", "0 N*m", not_negative, "torque while the driven side runs ahead"),
           &OneWayKeys::drag)
      .add(side_inertia_fields(), &OneWayKeys::inertia);
}

struct BrakeKeys {
  Capacity capacity;
  HeatRating heat;
  double inertia = 0;  // [kg·m²]
  Window window;
};
Fields<BrakeKeys> brake_fields() {
  return Fields<BrakeKeys>()
      .add(capacity_fields(), &BrakeKeys::capacity)
      .add(heat_rating_fields(), &BrakeKeys::heat)
      .add(own_inertia_key(), &BrakeKeys::inertia)
      .add(window_fields(), &BrakeKeys::window);
}

template <class Element>
void join_by(const Section& s, const SideInertias& inertia, Network& net, Element element) {
  const auto [in, out] = two_shafts(s, inertia, net);
  net.connect(in, out, 1, s.name, element);
}

void build_clutch(const Section& s, const Reading<ClutchKeys>& clutch, Network& net) {
  const Capacity& c = clutch.capacity;
  net.data.add(s.name, clutch.heat);
  join_by(s, clutch.inertia, net, FrictionClutch{c.kinetic, c.breakaway, c.slope});
}
void build_limiter(const Section& s, const Reading<LimiterKeys>& limiter, Network& net) {
  net.data.add(s.name, limiter.heat);
  join_by(s, limiter.inertia, net, FrictionClutch{limiter.torque * limiter.slipping_part, limiter.torque, 0});
}
void build_one_way(const Section& s, const Reading<OneWayKeys>& clutch, Network& net) {
  join_by(s, clutch.inertia, net, static_cast<const OneWayClutch&>(clutch));
}

void build_brake(const Section& s, const Reading<BrakeKeys>& brake, Network& net) {
  const Capacity& c = brake.capacity;
  net.data.add(s.name, brake.heat);
  net.put(single_shaft(s, brake.inertia, net), s.name, FrictionBrake{c.kinetic, c.breakaway, c.slope}, brake.window);
}

}  // namespace

std::vector<Kind> clutch_kinds() {
  return {
      kind_of<clutch_fields, build_clutch>(
          between_shafts, "clutch",
          "friction clutch between two half inertias; an operating sequence engages and releases it"),
      kind_of<limiter_fields, build_limiter>(between_shafts, "torque limiter", "slips at its limit, holds below it"),
      kind_of<one_way_fields, build_one_way>(between_shafts, "one-way clutch",
                                             "drives forwards only; the driven side may run ahead"),
      kind_of<brake_fields, build_brake>(
          on_a_shaft, "brake",
          "friction against the frame; an operating sequence applies it, without one it always brakes"),
  };
}

}  // namespace kurbel
