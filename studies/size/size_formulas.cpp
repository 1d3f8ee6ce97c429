// size_formulas.cpp — every formula of flywheel synthesis with its numbers.
#include <fmt/format.h>

#include <cmath>

#include "engine/numerics/angles.h"
#include "engine/scene/units.h"
#include "studies/size/size_plots.h"

namespace kurbel {
std::string basis_of(const Sizing& s) {
  if (s.basis == CycleBasis::steady)
    return s.engine ? "at the torques of its steady cycle"
                    : "at constant driving torque and the loads of its steady cycle";
  return s.engine ? "at torques of the angle alone" : "at constant driving torque";
}

Formulas cycle_formulas(const Sizing& s) {
  Formulas list;
  const WorkDiagram& d = s.diagram;
  const double cycle = d.excess.length();
  list.add("Driving torque from the balance of work (theory 2.3)",
           s.engine ? "∫ M_d dφ = ∫ M_c dφ" : "M_d = (1/Φ) ∫ M_c dφ", "M_d = {:.6g} J / {:.6g} rad = {:.6g} N·m",
           d.work, cycle, d.mean_torque());
  list.add("Greatest fluctuation of energy (theory 3.4)", "ΔA_max = max ΔT − min ΔT",
           "ΔA_max = {:.6g} J − ({:.6g} J) = {:.6g} J", d.most.value, d.least.value, d.fluctuation())
      .note(fmt::format("At φ = {:.4g}° and {:.4g}°.", d.most.x * in_degrees, d.least.x * in_degrees));
  const double fastest = s.mid_speed * (1 + s.delta / 2), slowest = s.mid_speed * (1 - s.delta / 2);
  list.add("Limits of the speed (theory 2.6)", "ω_max, ω_min = ω_mid (1 ± δ/2)",
           "{:.6g} rad/s · (1 ± {:g}/2) = {:.6g} and {:.6g} rad/s", s.mid_speed, s.delta, fastest, slowest);
  return list;
}

Formulas method_formulas(const Sizing& s) {
  Formulas list;
  const Tangent &u = s.exact.upper, &l = s.exact.lower;
  list.add("Wittenbauer (theory 3.2)",
           "I₀ = [max(ΔT − a I_em) − min(ΔT − b I_em)] / (a − b),   a = ½ ω_max²,  b = ½ ω_min²",
           "I₀ = [{:.7g} − ({:.7g})] J / ({:.7g} − {:.7g}) s⁻² = {:.7g} kg·m²", u.intercept(), l.intercept(), u.slope,
           l.slope, s.exact.inertia)
      .note("Exact for torques of the angle alone.");
  list.add("Mertsalov (theory 3.3)", "I₀ = (max ΔT₁ − min ΔT₁)/(ω_mid² δ),   ΔT₁ = ΔT − ½ ω_mid² I_em",
           "I₀ = [{:.7g} − ({:.7g})] J / ({:.6g}² · {:g}) s⁻² = {:.7g} kg·m²", s.approximate.most.value,
           s.approximate.least.value, s.mid_speed, s.delta, s.approximate.inertia)
      .note(fmt::format("{:+.3g} % against the exact value.", 100 * (s.approximate.inertia / s.exact.inertia - 1)));
  const SizeMethod& neglecting = s.methods[2];
  list.add("Neglecting I_em (theory 3.4)", "I₀ = ΔA_max/(ω_mid² δ)",
           "I₀ = {:.6g} J / ({:.6g}² · {:g}) s⁻² = {:.7g} kg·m²", s.diagram.fluctuation(), s.mid_speed, s.delta,
           neglecting.drive_inertia)
      .note(fmt::format("{:+.3g} % against the exact value.", 100 * (neglecting.drive_inertia / s.exact.inertia - 1)));
  return list;
}

Formulas flywheel_formulas(const Sizing& s) {
  Formulas list;
  const SizeMethod& exact = s.methods.front();
  const double on_shaft = exact.drive_inertia / (s.flywheel_ratio * s.flywheel_ratio);
  if (s.flywheel_ratio != 1)
    list.add(fmt::format("On the shaft of {}", s.flywheel), "I_drive = I₀ / i²",
             "I_drive = {:.7g} / {:.6g}² = {:.7g} kg·m²", exact.drive_inertia, s.flywheel_ratio, on_shaft);
  list.add("Flywheel with the scene's own inertias", "I_fly = I_drive − I_motor − I_gearbox − I_others",
           "I_fly = {:.7g} − {:.6g} − {:.6g} − {:.6g} = {:.7g} kg·m²", on_shaft, s.motor_inertia, s.gearbox_inertia,
           s.other_inertia, exact.flywheel.value);
  list.add("The same by the customary allowance for couplings (theory 3.1)",
           "I_fly = I_drive − 1.1 I_motor − I_gearbox", "I_fly = {:.7g} − 1.1 · {:.6g} − {:.6g} = {:.7g} kg·m²",
           on_shaft, s.motor_inertia, s.gearbox_inertia, exact.flywheel_by_parts);
  if (s.punch)
    list.add("Punch-press form (theory 3.5)", "ΔE = E (1 − t_w/t_c),   I₀ = ΔE/(ω_mid² δ),   P = A_d/t_c",
             "ΔE = {:.6g} J · (1 − {:.4g}/{:.4g}) = {:.6g} J,   I₀ = {:.7g} kg·m²,   P = {:.6g} W", s.punch->energy,
             s.punch->working_time, s.punch->cycle_time, s.punch->from_flywheel(), s.methods.back().drive_inertia,
             s.punch->power())
        .note("Useful work and the time in which it is done, at the mid speed; A_d is the drive's work of a cycle.");
  return list;
}

Formulas dimension_formulas(const FlywheelDimensions& d) {
  Formulas list;
  const double fastest = 2 * d.rim_speed / d.diameter;
  list.add("Rim speed", "v = ω_max D/2", "v = {:.5g} rad/s · {:.5g} m / 2 = {:.5g} m/s", fastest, d.diameter,
           d.rim_speed)
      .note(fmt::format("Limit {:.4g} m/s{}.", d.rim_speed_limit, d.within_limit ? "" : ": exceeded"));
  if (d.form == FlywheelForm::disc) {
    list.add("Mass of the disc", "m = 8 I/D²", "m = 8 · {:.6g} / {:.5g}² = {:.6g} kg", d.inertia, d.diameter, d.mass);
    list.add("Stress at the centre (theory 3.7)", "σ = (3 + ν)/8 · ρ v²",
             "σ = (3 + {:g})/8 · {:g} kg/m³ · ({:.5g} m/s)² = {:.4g} MPa", d.material.poisson, d.material.density,
             d.rim_speed, d.stress / 1e6);
  } else {
    const double radius = 0.5 * (d.diameter - d.thickness);
    list.add("Inertia of the rim", "I_rim = (π/32) ρ b (D⁴ − (D − 2h)⁴)",
             "I_rim = (π/32) · {:g} · {:.5g} · ({:.5g}⁴ − {:.5g}⁴) = {:.6g} kg·m²", d.material.density, d.breadth,
             d.diameter, d.diameter - 2 * d.thickness, d.rim_share * d.inertia)
        .note(fmt::format("{:.3g} % of the whole; spokes and hub bring the rest.", 100 * d.rim_share));
    list.add("Stress of the rim, with bending between the spokes (theory 3.7)", "σ = ρ v_m² (0.75 + 4.935 R_m/(n² h))",
             "σ = {:.4g} MPa · (0.75 + 4.935 · {:.5g}/({}² · {:.5g})) = {:.4g} MPa", d.stress / 1e6, radius,
             flywheel_spokes, d.thickness, d.spoked_stress / 1e6)
        .note(
            "Khurmi and Gupta, A Textbook of Machine Design (22.3): ¾ of a free ring's tension, ¼ of clamped bending.");
  }
  list.add("Energy stored", "T = ½ I ω_max²", "T = ½ · {:.6g} · {:.5g}² = {}", d.inertia, fastest,
           with_unit(d.energy, "J", 5));
  return list;
}

Formulas motor_formulas(const Sizing& s) {
  Formulas list;
  if (s.with_motor)
    list.add(s.operating->drive_slope < 0 ? "The drive's speed yields: its torque rises as the speed falls"
                                          : "The drive does not give way: what holds the speed is the load",
             "d(½ I ω²)/dφ = M_d − M_c,   ω(Φ) = ω(0)", "δ = {:.6g} instead of {:g}, at a mid speed of {}",
             s.with_motor->crank.value, s.delta, s.speed_unit.text(s.with_motor->mid_speed))
        .note(fmt::format(
            "Slope of the torques at the operating speed {:.4g} N·m·s/rad{}.", s.operating->slope,
            s.with_motor->multiplier
                ? fmt::format("; a disturbance shrinks to {:.3g} of itself within a cycle", *s.with_motor->multiplier)
                : ""));
  if (s.soft && s.soft->none_needed)
    list.add("Without a flywheel, with these torques", "δ(I₀) < δ", "δ = {:.6g} at I₀ = {:.6g} kg·m²: none is needed",
             *s.soft->delta, s.soft->drive_inertia);
  else if (s.soft)
    list.add("Inertia that gives δ with these torques", "δ(I₀) = δ", "I₀ = {:.6g} kg·m², flywheel {:.6g} kg·m²",
             s.soft->drive_inertia, s.soft->flywheel.value)
        .note(fmt::format("Its mid speed (ω_max + ω_min)/2 is then {}.", s.speed_unit.text(s.soft_speed)));
  return list;
}

std::string slope_of_what(const Sizing& s) {
  const bool drive = s.operating && std::abs(s.operating->drive_slope) >= 0.5 * std::abs(s.operating->slope);
  return !drive ? "the load's slope" : s.motor.empty() ? "the drive's slope" : "the motor's slope";
}

}  // namespace kurbel
