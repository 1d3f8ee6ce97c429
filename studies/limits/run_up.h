// run_up.h — the largest joint torques between rest and steady motion: torque peak at start, resonances passed,
// switching by the operating sequence.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "studies/findings/watch.h"
#include "studies/limits/joint_loads.h"

namespace kurbel {

struct RunUp {
  struct Peak {
    Estimate torque;  // of the largest magnitude, with its sign [N·m]
    double time = 0;  // [s]
  };
  bool found = false;  // it leads to the steady motion of the loads
  bool made = false;   // a start from rest replaces another start of the scene
  std::string words;   // description, or why there is none
  double until = 0;    // begin of the steady motion [s]
  std::vector<Peak> peaks;
};

// Whether every shaft stands at the scene's own start.
bool begins_at_rest(const std::shared_ptr<const Model>& machine);

// The scene's own start if it is from rest, otherwise a start from rest with the same operating sequence. Steady
// motion begins when the reduction link reaches 99 % of its least speed in it and no switching is left; two periods
// are added. Errors: the larger of the difference to a run with 30 × looser tolerances and twice the difference to a
// run by another method (engine/run, RunOptions::elsewhere).
RunUp find_run_up(const std::shared_ptr<const Model>& machine, const Orbit& orbit, const SteadyLoads& loads,
                  const std::vector<LimitedJoint>& joints, const Watch& watch);

}  // namespace kurbel
