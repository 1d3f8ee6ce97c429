// run_up.h — the largest torques of joints on the way from rest to the steady motion: the start's blow, resonances
// that are run through, what the operating sequence switches.
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
  bool found = false;  // it leads to the steady motion that the loads are of
  bool made = false;   // from rest, of a scene that starts otherwise
  std::string words;   // what it is, or why there is none
  double until = 0;    // where the steady motion begins [s]
  std::vector<Peak> peaks;
};

// The scene's own start where that is from rest, else one from rest made for it, with the same operating sequence. The
// steady motion begins where the reduction link comes to 99 % of its least speed in it, and nothing is left to be
// switched; two rounds are added. Errors: the larger of the differences to a run with 30 × looser tolerances, and of
// twice that to a run by another method (engine/run, RunOptions::elsewhere).
RunUp find_run_up(const std::shared_ptr<const Model>& machine, const Orbit& orbit, const SteadyLoads& loads,
                  const std::vector<LimitedJoint>& joints, const Watch& watch);

}  // namespace kurbel
