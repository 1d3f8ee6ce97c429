// orbit_cycle.h — one period of the actual steady motion, as piecewise functions of the link's travel.
//
// It includes all effects of the scene, such as slip and vibration; torques are powers over the link's speed, inertia
// is twice the kinetic energy over its square (theory 2.1, 2.2).
#pragma once

#include <optional>
#include <vector>

#include "engine/orbit/orbit.h"
#include "studies/cycle/machine_cycle.h"

namespace kurbel {

// Over the travel s of the reduction link in its own sense of rotation, from its angle 0 on: the angle is sense · s.
// If only time drives and no law depends on an angle, s = 0 is the begin of the period.
struct OrbitCycle {
  double sense = 1;               // ±1, of the link's rotation
  double time = 0;                // period [s]
  MachineCycle cycle;             // at its mid speed: M = P/|ω|, share per account positive when it drives [N·m]
  Piecewise speed;                // of the link, |ω| [rad/s]
  std::vector<Piecewise> others;  // of the requested nodes, ω [rad/s]
  Piecewise inertia;              // 2T/ω² [kg·m²]
  Extreme fastest, slowest;       // of the link

  double way() const { return speed.length(); }  // of the link in the period [rad]
  double mid_speed() const { return 0.5 * (fastest.value + slowest.value); }
  double mean_speed() const { return way() / time; }
  double delta() const { return (fastest.value - slowest.value) / mid_speed(); }
};

// For a periodic steady motion. Throws std::invalid_argument with the reason if the link stops or reverses within the
// period: its angle is then no independent variable.
OrbitCycle orbit_cycle(const Orbit& orbit, const std::vector<int>& nodes = {});
// The same with tolerances 100 × looser: the difference is the error. Empty if that search fails.
std::optional<OrbitCycle> looser_orbit_cycle(const Orbit& orbit, const std::vector<int>& nodes = {});

// Inertia of everything that normally turns at a constant ratio, reduced to the link [kg·m²].
double constant_inertia(const Model& model);

}  // namespace kurbel
