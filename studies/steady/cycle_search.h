// cycle_search.h — the steady cycle of one model: free, or at a demanded mid speed by a torque added to the drive.
#pragma once

#include "studies/steady/steady.h"

namespace kurbel {

// Search options from the scene's run: its budget, and its method unless that is one over the angle.
OrbitOptions orbit_options(const Scene& scene, int periods, const Watch& watch);

SteadyCycle search_cycle(const Scene& scene, const Effects& effects, const SteadyOptions& options);

// The cycle at a demanded mid speed, held by a torque added to the drive.
struct HeldOrbit {
  Orbit orbit;              // as for a machine with its own start; failed: its words say what was tried
  double added_torque = 0;  // [N·m] …
  std::string added_at;     // … on this component's shaft
};
HeldOrbit held_orbit(const Scene& scene, const Effects& effects, double mid_speed, const Moment& at,
                     const Watch& watch);

}  // namespace kurbel
