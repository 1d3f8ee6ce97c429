// cycle_search.h — the steady cycle of one model: free, or at a demanded mid speed with a torque added to the drive.
#pragma once

#include "studies/steady/steady.h"

namespace kurbel {

// Of a search as the scene's run asks for it: its budget, and its method unless that is one over the angle.
OrbitOptions orbit_options(const Scene& scene, int periods, const Watch& watch);

SteadyCycle search_cycle(const Scene& scene, const Effects& effects, const SteadyOptions& options);

// The cycle at a mid speed that is demanded, which a torque added to the drive keeps.
struct HeldOrbit {
  Orbit orbit;              // as a machine of its own start has it; failed: its words say what was tried
  double added_torque = 0;  // [N·m] …
  std::string added_at;     // … on this component's shaft
};
HeldOrbit held_orbit(const Scene& scene, const Effects& effects, double mid_speed, const Moment& at,
                     const Watch& watch);

}  // namespace kurbel
