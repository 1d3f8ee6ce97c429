// sized_orbits.h — steady motion of the machine as a function of the flywheel's inertia: δ, and the inertia for a
// demanded δ.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/estimate.h"
#include "engine/orbit/moment.h"
#include "engine/scene/scene.h"
#include "studies/cycle/orbit_cycle.h"
#include "studies/findings/watch.h"

namespace kurbel {

inline constexpr int curve_points = 720;  // per period, drawn

// The component to be sized: the named one, else the scene's only flywheel; empty: one is added on the crank's shaft.
std::string chosen_flywheel(const Scene& scene, const std::string& named);

// The scene with a changed flywheel inertia; a missing flywheel is added on `on`'s shaft.
Scene with_flywheel(Scene scene, const std::string& flywheel, double inertia, const std::string& on);

// One period of the steady motion with a flywheel.
struct SizedCycle {
  double flywheel = 0;                          // [kg·m²]
  Estimate crank, motor;                        // δ of the link and of the motor's shaft, each by its own mid speed
  double mid_speed = 0;                         // of the link [rad/s]
  int cycles = 0;                               // cost of the search
  std::string slips = {};                       // what slips in it although it is closed, in words; empty: nothing
  std::vector<double> phi, speed, motor_speed;  // [rad], [rad/s]; the motor's reduced to the link
};

struct SizedOrbit : SizedCycle {
  bool found = false;
  std::string why;  // reason, if not found
  bool interrupted = false;
  bool stops = false;                 // the machine comes to rest with it; false: its motion is unknown
  std::optional<double> start_speed;  // of the link at its angle 0 [rad/s]; not found: as given
  std::optional<double> multiplier;   // largest: remainder of a deviation after a period; empty: found by the run only
  std::vector<std::string> notes;     // range of validity of the model in this motion
};

class SizedOrbits {
 public:
  struct Parts {
    std::string flywheel, on, motor;  // component; link on which it is added if missing; empty: no motor
    Moment moment;                    // state of the scene
    int most_periods = OrbitOptions{}.most_periods;
    std::optional<double> held = {};  // mid speed held if the own start leads to no cycle [rad/s]
  };
  SizedOrbits(const Scene& scene, Parts parts, const Watch& watch)
      : scene_(scene), parts_(std::move(parts)), watch_(watch) {}

  // From the scene's own start; a machine without a sequence starts at `start_speed` of the link, if given, in
  // quasi-static equilibrium, which leads to the same motion. The error requires another search.
  SizedOrbit at(double flywheel, const Effects& effects, std::optional<double> start_speed, bool with_error) const;

  struct Meeting {
    std::optional<SizedOrbit> orbit;  // with the demanded δ; empty: none
    bool none_needed = false;         // `orbit` is without a flywheel, with a smaller δ
    std::optional<double> error;      // of its flywheel [kg·m²]; empty: none is needed
    double least = 0, least_at = 0;   // the smallest δ found, and its flywheel [kg·m²]
    std::string slips;                // what slips there
    int orbits = 0;                   // computed
    std::string unknown;              // why the motion is unknown for one of the inertias tried; else empty
  };
  // Secant method in ln δ and ln I to `met` of δ, or in the end to 1e-5, at most eight steady motions. If the machine stalls
  // in `first`, its inertia is doubled before, at most eight times. `others`: inertia that turns with the flywheel, on its
  // shaft [kg·m²].
  Meeting meeting(double delta, const SizedOrbit& first, double others, const Effects& effects, double met) const;

 private:
  const Scene& scene_;
  Parts parts_;
  const Watch& watch_;
};

}  // namespace kurbel
