// steady_simulation.h — simulates a scene until its cycles repeat, and measures δ at the crank and at the motor.
#pragma once

#include <optional>
#include <vector>

#include "studies/run/simulate.h"

namespace kurbel {

struct SteadySimulation {
  bool complete = false;
  std::string diagnosis;
  double link_delta = 0, motor_delta = 0;  // of the last cycle; the motor's shaft by its own mid speed
  double link_error = 0, motor_error = 0;  // difference to a run with 100 × looser tolerances
  double mid_speed = 0;                    // of the link [rad/s]
  bool settled = false;                    // speed and δ have come within 1e-5 of where they tend to
  double speed_change = 0;                 // of the link's mid speed from cycle to cycle, over itself
  double speed_to_come = 0;                // what it has still to change, over itself; ∞: it tends nowhere
  int cycles = 0;
  std::vector<double> phi, link, motor;  // last cycle: angle [rad], speeds [rad/s], the motor's reduced to the link
};

// What a quantity that is looked at once a cycle has still to change, from its course so far: the change over the last
// quarter of it, going on as a geometric sequence with the ratio q to the quarter before: d q/(1 − q); swinging,
// q < 0: |d|. ∞ where the changes do not shrink (a runaway at any rate: q = 1), 0 where they are below `noise`.
double still_to_come(const std::vector<double>& course, double noise);

// Starts at the cycle's begin with `start_speed` of the reduction link and twists in equilibrium. `cycle` is the
// cycle's angle; runs double in length until settled, at most `most_cycles`. Throws as compile does.
SteadySimulation simulate_steady(Scene scene, const Effects& effects, double start_speed, double cycle, int motor_node,
                                 const SimulateOptions& options, int most_cycles = 320);

}  // namespace kurbel
