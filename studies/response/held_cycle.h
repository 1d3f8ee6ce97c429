// held_cycle.h — the nonlinear cycle of a machine with held mean speed: the reference for the linear response at that
// speed.
//
//     P(z, a) = z,   mean of ω over the period = that of the base motion,   torques −I_s (Z F a)_s on the shafts
// F: motions without twist (coordinates.h), one for all that turns as a whole, more if something slips. The torques
// are those of a machine that accelerates as a whole by F a, the residual of the linear study's base motion
// (base_motion.h), here in the full equations; a = 0 in the machine's steady motion. They are constant over the
// period and proportional to inertia, so that they excite no vibration.                               (theory 12.13)
#pragma once

#include <atomic>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "engine/linear/cycle_samples.h"
#include "engine/orbit/orbit.h"
#include "studies/response/forced_response.h"

namespace kurbel {

// The machine as a network, and its steady motion if there is one.
struct HeldMachine {
  const Network& network;
  const Scene& scene;
  const Effects& effects;
  const Orbit* orbit = nullptr;  // a periodic one; null: not known
};

struct HeldCycleOptions {
  double seconds = 5;  // of processor time, at most
  const std::atomic<bool>* interrupted = nullptr;
};

struct HeldCycle {
  bool found = false;
  std::string why;          // reason, if not found
  double acceleration = 0;  // of the reduction link, represented by the torques [rad/s²]
  std::optional<CycleSamples> samples;
  std::vector<std::complex<double>> multipliers;  // except those of the held speeds, largest first
  bool uncertain = false;                         // the multipliers are uncertain
  double cost = 0;                                // [cycles]
  bool stable() const { return multipliers.empty() || std::abs(multipliers.front()) <= 1 + 1e-6; }
};

// At the speed of the linearised drive; `excitations` of the machine. The search starts with the drive's linear
// response, then continues along the speeds from the machine's steady motion.
HeldCycle find_held_cycle(const HeldMachine& machine, const LinearDrive& drive, const Excitations& excitations,
                          const HeldCycleOptions& options);

}  // namespace kurbel
