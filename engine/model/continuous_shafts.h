// continuous_shafts.h — shafts given by dimensions, each discretised by one spectral element (theory 5.20).
#pragma once

#include "engine/model/network.h"

namespace kurbel {

// A shaft with distributed inertia before its discretisation: one spring between two halves of its inertia. Rigid joints at
// both ends have the torques at its ends as results.
struct ContinuousShaft {
  double stiffness = 0, inertia = 0;  // k = G J_p/L [N·m/rad], J = ρ J_p L [kg·m²]
  ConnectionForm whole;               // its spring and damper
};
void add_continuous_shaft(Network& network, const std::string& component, const ContinuousShaft& shaft);

// Chooses the degree of each shaft and discretises it: the machine computed by all commands. At the highest of the first
// natural frequencies of the shafts, each between its adjacent inertias, the frequency error of a shaft is at most
// `resolved_within`. `finer`: increases the degrees by so many steps, to estimate the discretisation error.
void cut_continuous_shafts(Network& network, int finer = 0);

constexpr double resolved_within = 1e-5;  // of a frequency

}  // namespace kurbel
