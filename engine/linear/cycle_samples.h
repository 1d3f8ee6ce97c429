// cycle_samples.h — a period of the steady motion, sampled uniformly over time, for means and orders.
#pragma once

#include <memory>
#include <vector>

#include "engine/linear/base_motion.h"
#include "engine/orbit/orbit.h"

namespace kurbel {

struct CycleSamples {
  double time = 0;                          // of the period [s]
  double link_angle = 0;                    // at its begin [rad]
  std::shared_ptr<const MeanMotion> mean;   // over the period
  std::vector<std::vector<double>> torque;  // per elastic joint: at (k + ½)/n of the period [N·m]
  std::vector<std::vector<double>> twist;   // minus the unloaded twist [rad]
  std::vector<Event> events;                // in the period
};

// Samples a periodic steady motion at `count` times. Throws std::invalid_argument if the integration fails.
CycleSamples sample_cycle(const Orbit& orbit, std::size_t count, double tolerance = 1e-11);

// Means of an equilibrium, a state with constant speeds: those of the state.
std::shared_ptr<const MeanMotion> means_of_equilibrium(std::shared_ptr<const Model> model, const State& state);

}  // namespace kurbel
