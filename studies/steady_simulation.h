// steady_simulation.h — simulates a scene until its cycles repeat, and measures δ at the crank and at the motor.
#pragma once

#include <optional>
#include <vector>

#include "studies/simulate.h"

namespace kurbel {

struct SteadySimulation {
  bool complete = false;
  std::string diagnosis;
  double link_delta = 0, motor_delta = 0;  // of the last cycle; the motor's shaft by its own mean speed
  double link_error = 0, motor_error = 0;  // difference to a run with 100 × looser tolerances
  double mean_speed = 0;                   // of the link [rad/s]
  bool settled = false;                    // the last two cycles agree to 1e-5 of δ
  int cycles = 0;
  std::vector<double> phi, link, motor;  // last cycle: angle [rad], speeds [rad/s], the motor's reduced to the link
};

// Starts at the cycle's begin with `start_speed` of the reduction link and twists in equilibrium. `cycle` is the
// cycle's angle; runs double in length until settled, at most `most_cycles`. Throws as compile does.
SteadySimulation simulate_steady(Scene scene, const Effects& effects, double start_speed, double cycle, int motor_node,
                                 const SimulateOptions& options, int most_cycles = 320);

}  // namespace kurbel
