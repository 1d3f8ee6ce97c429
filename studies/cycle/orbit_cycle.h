// orbit_cycle.h — one round of the steady motion that a machine really has, as piecewise functions of its link's way.
//
// Everything that the scene's effects do is in it: what slips, slips, what swings, swings; torques are powers over the
// link's speed, inertia is twice the kinetic energy over its square (theory 2.1, 2.2).
#pragma once

#include <optional>
#include <vector>

#include "engine/orbit/orbit.h"
#include "studies/cycle/machine_cycle.h"

namespace kurbel {

// Over the way s of the reduction link in its own sense of rotation, from its angle 0 on: the angle is sense · s. Where
// time alone drives and no law reads an angle, s = 0 is where the period of time begins.
struct OrbitCycle {
  double sense = 1;               // ±1, of the link's rotation
  double time = 0;                // of the round [s]
  MachineCycle cycle;             // at its mid speed: M = P/|ω|, share per account positive when it drives [N·m]
  Piecewise speed;                // of the link, |ω| [rad/s]
  std::vector<Piecewise> others;  // of the nodes asked for, ω [rad/s]
  Piecewise inertia;              // 2T/ω² [kg·m²]
  Extreme fastest, slowest;       // of the link

  double way() const { return speed.length(); }  // of the link in the round [rad]
  double mid_speed() const { return 0.5 * (fastest.value + slowest.value); }
  double mean_speed() const { return way() / time; }
  double delta() const { return (fastest.value - slowest.value) / mid_speed(); }
};

// Of a steady motion that repeats. Throws std::invalid_argument in words where the link stands or turns back within the round:
// then its angle does not tell where the machine is.
OrbitCycle orbit_cycle(const Orbit& orbit, const std::vector<int>& nodes = {});
// The same found and followed with tolerances 100 × looser: what differs is the error. None where that search fails.
std::optional<OrbitCycle> looser_orbit_cycle(const Orbit& orbit, const std::vector<int>& nodes = {});

// Of everything that turns at a constant ratio in the usual motion, on the link [kg·m²].
double constant_inertia(const Model& model);

}  // namespace kurbel
