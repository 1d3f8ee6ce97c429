// planetary.h — planetary and differential trains by Willis: speeds and torques of the three shafts (theory 7.6, 7.7).
//
//     ω_s − ω_c = i₀ (ω_r − ω_c)      i₀: ratio with the carrier held; −z_r/z_s for a simple train with a ring
//     T_s + T_r + T_c = 0             T: torques on the shafts from outside; uniform motion, massless wheels
//     T_r = −i₀ T_s η₀^±1             η₀: efficiency with the carrier held; + while rolling power flows from s to r
#pragma once

#include <cmath>
#include <stdexcept>

namespace kurbel {

struct PlanetaryTrain {
  double basic_ratio;           // i₀ ≠ 0, ≠ 1
  double basic_efficiency = 1;  // η₀, 0 < η₀ ≤ 1

  // The speed [rad/s] of one shaft from those of the other two.
  double sun_speed(double ring, double carrier) const { return carrier + basic_ratio * (ring - carrier); }
  double ring_speed(double sun, double carrier) const { return carrier + (sun - carrier) / basic_ratio; }
  double carrier_speed(double sun, double ring) const { return (sun - basic_ratio * ring) / (1 - basic_ratio); }

  // Torques on ring and carrier [N·m] that hold the balance against a torque on the sun.
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

// Sun and ring with simple planets: i₀ = −z_r/z_s.
inline PlanetaryTrain simple_planetary(int sun, int ring) {
  if (sun < 1 || ring <= sun) throw std::invalid_argument("planetary: the ring must have more teeth than the sun");
  return {-static_cast<double>(ring) / sun};
}
// Sun – planet, second planet on the same shaft – ring: i₀ = −(z_p/z_s)(z_r/z_q).
inline PlanetaryTrain stepped_planetary(int sun, int planet, int second_planet, int ring) {
  if (sun < 1 || planet < 1 || second_planet < 1 || ring <= second_planet)
    throw std::invalid_argument("planetary: the ring must have more teeth than the planet that runs in it");
  return {-static_cast<double>(planet) / sun * ring / second_planet};
}
// Both central wheels external, planets between them (Ferguson's paradox): i₀ = z_r/z_s.
inline PlanetaryTrain idler_planetary(int first, int last) {
  if (first < 1 || last < 1 || first == last)
    throw std::invalid_argument("planetary: two central wheels with the same teeth make no train");
  return {static_cast<double>(last) / first};
}
// Differential with equal bevel wheels: ω_s + ω_r = 2 ω_c.
inline PlanetaryTrain bevel_differential() { return {-1}; }

// A planet that meshes with the sun: ω_p = ω_c − (ω_s − ω_c) z_s/z_p.
inline double planet_speed(int sun_teeth, int planet_teeth, double sun, double carrier) {
  return carrier - (sun - carrier) * sun_teeth / planet_teeth;
}

// A simple train can be assembled with n planets at equal distances, and they do not touch.
inline bool planets_fit(int sun, int planet, int ring, int count) {
  const double pi = std::acos(-1.0);
  return count >= 1 && ring == sun + 2 * planet && (sun + ring) % count == 0 &&
         (count == 1 || (sun + planet) * std::sin(pi / count) > planet + 2);
}

// Inertia of one planet about its own axis, J_p = 1, as inertias of the central shafts. Its energy ½ ω_p² mixes their
// speeds; with ω_s = ω_c − x/ρ₁, ω_r = ω_c + x/ρ₂, x = ω_p − ω_c it is also A ω_s² + C ω_r² + B ω_c² for all motions:
//   A/ρ₁² + C/ρ₂² = 1,  C/ρ₂ − A/ρ₁ = 1,  A + B + C = 1       ρ₁ = z_s/z_p, ρ₂ = z_r/z_q
// (two masses on the pitch points and one on the axis; B < 0, and less than the planet's mass brings to the carrier.)
struct PlanetShares {
  double sun, ring, carrier;  // A, C, B
};
inline PlanetShares shares_of_planet(double sun_ratio, double ring_ratio) {
  const double p = (1 - 1 / ring_ratio) / (1 / sun_ratio + 1 / ring_ratio);
  const double sun = sun_ratio * p, ring = ring_ratio * (1 + p);
  return {sun, ring, 1 - sun - ring};
}

// Moment of inertia that a simple train with its ring held shows at the sun, planets with mass m at the distance a:
//   I = J_s + i_c² (J_c + n m a²) + n J_p i_p²,  i_c = z_s/(z_s + z_r),  i_p = ω_p/ω_s.
struct PlanetaryInertia {
  double sun, carrier, planet, planet_mass, planet_distance;  // [kg·m²], [kg], [m]
  int planets;
};
inline double reduced_to_sun(int sun, int planet, int ring, const PlanetaryInertia& j) {
  const double carrier = simple_planetary(sun, ring).carrier_speed(1, 0);
  const double own = planet_speed(sun, planet, 1, carrier);
  const double d = j.planet_distance * carrier;
  return j.sun + j.carrier * carrier * carrier + j.planets * (j.planet_mass * d * d + j.planet * own * own);
}

}  // namespace kurbel
