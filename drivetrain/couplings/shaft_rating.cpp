// shaft_rating.cpp — formulas and keys of what a shaft's stress may be.
//
// IACS UR M68 (Dimensions of propulsion shafts and their permissible torsional vibration stresses), M68.3, M68.5 and the
// table of M68.6, as the Korean Register restates them: Rules for the Classification of Steel Ships, 2025, part 5,
// chapter 4, 202, 206 and table 5.4.1. Strengths in shear: Budynas, Nisbett, Shigley's Mechanical Engineering Design,
// 9th ed., eqs. 5–21, 6–54.
#include "drivetrain/couplings/shaft_rating.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivetrain/couplings/coupling_keys.h"

namespace kurbel {
namespace {

using Rating = ShaftRating;
constexpr double megapascal = 1e6, millimetre = 1e-3;
constexpr double from_flat = 0.9, last_ratio = 1.05;  // λ

void check_fatigue(const Reading<Rating>& r) {
  if (r.endurance && !r.tensile)
    r.refuse(&Rating::endurance, "\"endurance_limit\" needs \"tensile_strength\" (Goodman); give that, too");
  if (r.tensile && !r.endurance && r.role == Rating::Role::none)
    r.refuse(
        &Rating::tensile,
        "\"tensile_strength\" judges nothing by itself; give \"endurance_limit\" (Goodman) or \"role\" (UR M68), too");
  if (r.given(&Rating::notch) && !r.endurance)
    r.refuse(&Rating::notch, "\"notch_factor\" belongs to \"endurance_limit\"; drop it, or give that");
  if (r.given(&Rating::safety) && !r.endurance && !r.yield)
    r.refuse(&Rating::safety, "\"safety\" belongs to \"endurance_limit\" or \"yield_strength\"; drop it, or give one");
}

void check_propulsion(const Reading<Rating>& r) {
  if (r.role == Rating::Role::none) {
    for (const auto member : {&Rating::stated_design, &Rating::rated_speed})
      if (r.*member) r.refuse(member, fmt::format("\"{}\" belongs to \"role\" (UR M68); drop it", r.key(member)));
    if (r.given(&Rating::detail)) r.refuse(&Rating::detail, "\"detail\" belongs to \"role\" (UR M68); drop it");
    if (r.given(&Rating::steel)) r.refuse(&Rating::steel, "\"steel\" belongs to \"role\" (UR M68); drop it");
    return;
  }
  if (!r.tensile) r.refuse(&Rating::role, "\"role\" needs \"tensile_strength\" (UR M68); give that, too");
  if (!r.rated_speed) r.refuse(&Rating::role, "\"role\" needs \"rated_speed\", where λ = 1 (UR M68); give that, too");
  if (r.given(&Rating::detail) && r.role != Rating::Role::intermediate)
    r.refuse(&Rating::detail, "\"detail\" is of an intermediate shaft; drop it, or give \"design_factor\"");
  if (r.given(&Rating::detail) && r.stated_design)
    r.refuse(&Rating::detail, "\"detail\" and \"design_factor\" both given; keep one");
}

}  // namespace

// Of ductile steel: 0.67 of the tensile strength, and what the distortion energy says of the yield strength.
double ShaftRating::strength_in_shear() const { return 0.67 * tensile.value(); }
double ShaftRating::yield_in_shear() const { return 0.577 * yield.value(); }

double ShaftRating::fatigue_stress(double amplitude, double mean) const {
  return safety * (notch * amplitude + endurance.value() * std::abs(mean) / strength_in_shear());
}

double ShaftRating::design_factor() const {
  if (stated_design) return *stated_design;
  static constexpr std::pair<Role, double> by_role[] = {
      {Role::thrust, 0.85}, {Role::propeller, 0.55}, {Role::stern_tube, 0.8}};
  static constexpr std::pair<Detail, double> by_detail[] = {{Detail::tapered_keyway, 0.6},
                                                            {Detail::cylindrical_keyway, 0.45},
                                                            {Detail::radial_hole, 0.5},
                                                            {Detail::slot, 0.3}};
  for (const auto& [of, factor] : by_role)
    if (of == role) return factor;
  for (const auto& [of, factor] : by_detail)
    if (of == detail) return factor;
  return 1;
}

double ShaftRating::counted_strength() const {
  const bool aft = role == Role::propeller || role == Role::stern_tube;
  return std::min(tensile.value(), (steel == Steel::alloy && !aft ? 800 : 600) * megapascal);
}

double ShaftRating::speed_ratio(double speed) const { return std::abs(speed) / rated_speed.value(); }

double ShaftRating::continuous(double diameter, double speed_ratio) const {
  if (speed_ratio > last_ratio) return HUGE_VAL;
  const double size = 0.35 + 0.93 * std::pow(diameter / millimetre, -0.2);
  const double falling = speed_ratio < from_flat ? 3 - 2 * speed_ratio * speed_ratio : 1.38;
  return (counted_strength() / megapascal + 160) / 18 * design_factor() * size * falling * megapascal;
}

double ShaftRating::transient(double diameter, double speed_ratio) const {
  return 1.7 * continuous(diameter, speed_ratio) / std::sqrt(design_factor());
}

BarredAround barred_around(double speed_ratio) { return {16 / (18 - speed_ratio), (18 - speed_ratio) / 16}; }

Fields<ShaftRating> shaft_rating_fields() {
  return Fields<Rating>()
      .add(quantity(
               "allowable_vibratory_stress", "Pa", positive,
               "limit of the stress's amplitude (τ_max − τ_min)/2 by the manufacturer, for kurbel modes, run, steady"),
           &Rating::vibratory)
      .add(quantity("tensile_strength", "Pa", positive, "σ_B, specified minimum; for Goodman and UR M68"),
           &Rating::tensile)
      .add(quantity("yield_strength", "Pa", positive, "σ_S: the largest stress is held against 0.577 σ_S"),
           &Rating::yield)
      .add(quantity("endurance_limit", "Pa", positive,
                    "τ_W of the smooth shaft, size and surface included, in reversed torsion: Goodman"),
           &Rating::endurance)
      .add(defaulted("notch_factor", "", "1", {.low = 1}, "K_f in torsion, for Goodman"), &Rating::notch)
      .add(defaulted("safety", "", "1", {.low = 1}, "S that Goodman and yield must leave"), &Rating::safety)
      .add({.name = "role",
            .doc = "in a ship's propulsion: judged by IACS UR M68, continuous, passing, barred ranges; crankshafts and "
                   "shafts of gears, motors, generators, turbines have no role there"},
           &Rating::role,
           {{"intermediate shaft", Rating::Role::intermediate},
            {"thrust shaft", Rating::Role::thrust},
            {"propeller shaft", Rating::Role::propeller},
            {"stern tube shaft", Rating::Role::stern_tube}})
      .add(choice("detail", "flange", "of an intermediate shaft, for its c_K: 1, 1, 0.6, 0.45, 0.5, 0.3"),
           &Rating::detail,
           {{"flange", Rating::Detail::flange},
            {"shrink fit", Rating::Detail::shrink_fit},
            {"tapered keyway", Rating::Detail::tapered_keyway},
            {"cylindrical keyway", Rating::Detail::cylindrical_keyway},
            {"radial hole", Rating::Detail::radial_hole},
            {"longitudinal slot", Rating::Detail::slot}})
      .add(choice("steel", "carbon",
                  "how much of σ_B counts in UR M68: up to 600 MPa; of alloy steel forward of the stern tube 800 MPa"),
           &Rating::steel, {{"carbon", Rating::Steel::carbon}, {"alloy", Rating::Steel::alloy}})
      .add(quantity("design_factor", "", {.low = 0, .high = 1, .low_open = true},
                    "c_K in place of that of role and detail"),
           &Rating::stated_design)
      .add(quantity("rated_speed", "rad/s", positive, "of this shaft at rated power: λ = 1"), &Rating::rated_speed)
      .check([](const Reading<Rating>& r) {
        check_fatigue(r);
        check_propulsion(r);
      });
}

}  // namespace kurbel
