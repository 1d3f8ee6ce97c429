// cycle_samples.h — a round of the steady motion, sampled evenly over time: means and orders of what it does.
#pragma once

#include <memory>
#include <vector>

#include "engine/linear/base_motion.h"
#include "engine/orbit/orbit.h"

namespace kurbel {

struct CycleSamples {
  double time = 0;                          // of the round [s]
  double link_angle = 0;                    // at its begin [rad]
  std::shared_ptr<const MeanMotion> mean;   // of the round
  std::vector<std::vector<double>> torque;  // per elastic joint: at (k + ½)/n of the round [N·m]
  std::vector<std::vector<double>> twist;   // less what it is unloaded [rad]
  std::vector<Event> events;                // that the round goes through
};

// Of a steady motion that repeats; `count` samples. Throws std::invalid_argument in words where the round breaks down.
CycleSamples sample_cycle(const Orbit& orbit, std::size_t count, double tolerance = 1e-11);

// Of a state in which no speed changes: its own.
std::shared_ptr<const MeanMotion> means_of_equilibrium(std::shared_ptr<const Model> model, const State& state);

}  // namespace kurbel
