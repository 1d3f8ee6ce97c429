// held_cycle.h — the nonlinear cycle of a machine whose mean speed is held: what a linear response at a speed is held
// against.
//
//     P(z, a) = z,   mean of ω over the round = that of the base motion,   torques −I_s (Z F a)_s on the shafts
// F: motions without twist (coordinates.h), one for all that turns as a whole, more where something slips. The torques are
// those of the machine that accelerates as a whole by F a: what the linear study's base motion leaves over
// (base_motion.h), here on the full equations; in the motion that the machine keeps a = 0. They are constant over the
// round and proportional to inertia, so that they swing nothing by themselves.                        (theory 12.13)
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

// What is held: a machine as its network says, and the motion that it keeps where there is one.
struct HeldMachine {
  const Network& network;
  const Scene& scene;
  const Effects& effects;
  const Orbit* orbit = nullptr;  // one that repeats; null: none is known
};

struct HeldCycleOptions {
  double seconds = 5;  // of processor time, at most
  const std::atomic<bool>* interrupted = nullptr;
};

struct HeldCycle {
  bool found = false;
  std::string why;          // in words, unless it was found
  double acceleration = 0;  // of the reduction link, that the torques stand for [rad/s²]
  std::optional<CycleSamples> samples;
  std::vector<std::complex<double>> multipliers;  // but those of the held speeds, largest first
  bool uncertain = false;                         // these are
  double cost = 0;                                // [cycles]
  bool stable() const { return multipliers.empty() || std::abs(multipliers.front()) <= 1 + 1e-6; }
};

// At the speed of the drive, which is linearised there; `excitations` of the machine. The search begins with the drive's
// linear response, then goes along the speeds from the motion that the machine keeps.
HeldCycle find_held_cycle(const HeldMachine& machine, const LinearDrive& drive, const Excitations& excitations,
                          const HeldCycleOptions& options);

}  // namespace kurbel
