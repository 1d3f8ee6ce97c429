// planetary.h — planetary and differential gear trains by Willis: speeds and torques of the three shafts (theory 7.6, 7.7).
//
//     ω_s − ω_c = i₀ (ω_r − ω_c)      i₀: ratio with the carrier held; −z_r/z_s for a simple train with a ring
//     T_s + T_r + T_c = 0             T: external torques on the shafts; uniform motion, massless wheels
//     T_r = −i₀ T_s η₀^±1             η₀: efficiency with the carrier held; + if rolling power flows from s to r
#pragma once

namespace kurbel {

struct PlanetaryTrain {
  double basic_ratio;           // i₀ ≠ 0, ≠ 1
  double basic_efficiency = 1;  // η₀, 0 < η₀ ≤ 1

  // Speed of one shaft from the speeds of the other two [rad/s].
  double sun_speed(double ring, double carrier) const { return carrier + basic_ratio * (ring - carrier); }
  double ring_speed(double sun, double carrier) const { return carrier + (sun - carrier) / basic_ratio; }
  double carrier_speed(double sun, double ring) const { return (sun - basic_ratio * ring) / (1 - basic_ratio); }

  // Torques on ring and carrier [N·m] that balance a torque on the sun.
  struct Torques {
    double sun, ring, carrier;
  };
  Torques torques(double sun_torque, double sun_speed, double carrier_speed) const {
    const double rolling = sun_torque * (sun_speed - carrier_speed);
    const double loss = rolling >= 0 ? basic_efficiency : 1 / basic_efficiency;
    const double ring = -basic_ratio * sun_torque * loss;
    return {sun_torque, ring, -sun_torque - ring};
  }
};

// Differential with equal bevel wheels: ω_s + ω_r = 2 ω_c.
inline PlanetaryTrain bevel_differential() { return {-1}; }

// Inertia of one planet about its own axis, J_p = 1, as inertias of the central shafts. Its energy ½ ω_p² depends on two
// of their speeds. With ω_s = ω_c − x/ρ₁, ω_r = ω_c + x/ρ₂, x = ω_p − ω_c, ω_p² = A ω_s² + C ω_r² + B ω_c² in any motion:
//   A/ρ₁² + C/ρ₂² = 1,  C/ρ₂ − A/ρ₁ = 1,  A + B + C = 1       ρ₁ = z_s/z_p, ρ₂ = z_r/z_q
// (Two masses at the pitch points and one on the axis; B < 0, |B| is less than the contribution of the planet's mass.)
struct PlanetShares {
  double sun, ring, carrier;  // A, C, B
};
inline PlanetShares shares_of_planet(double sun_ratio, double ring_ratio) {
  const double p = (1 - 1 / ring_ratio) / (1 / sun_ratio + 1 / ring_ratio);
  const double sun = sun_ratio * p, ring = ring_ratio * (1 + p);
  return {sun, ring, 1 - sun - ring};
}

}  // namespace kurbel
