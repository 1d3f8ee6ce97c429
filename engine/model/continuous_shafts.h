// continuous_shafts.h — shafts that are given by their dimensions, cut into one spectral element each (theory 5.20).
#pragma once

#include "engine/model/network.h"

namespace kurbel {

// A shaft with its own inertia between two ends, before its element is chosen: its whole spring between two halves of its
// inertia. Rigid joints at both ends, whose torques are results, tell what it takes and gives.
struct ContinuousShaft {
  double stiffness = 0, inertia = 0;  // k = G J_p/L [N·m/rad], J = ρ J_p L [kg·m²]
  ConnectionForm whole;               // its spring and damper
};
void add_continuous_shaft(Network& network, const std::string& component, const ContinuousShaft& shaft);

// Chooses each shaft's degree by the highest frequency that matters, and cuts it: the machine as it is computed by every
// command. That frequency is the highest of the shafts' own first ones, each between the inertias that it joins; there a
// shaft is off by no more than `resolved_within`. `finer`: so many steps finer, to see what the degree leaves open.
void cut_continuous_shafts(Network& network, int finer = 0);

constexpr double resolved_within = 1e-5;  // of a frequency

}  // namespace kurbel
