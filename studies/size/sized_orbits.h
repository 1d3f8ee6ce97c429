// sized_orbits.h — the steady motion of the machine with a flywheel of this or that inertia: its δ, and the inertia that
// meets a demanded one.
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

inline constexpr int curve_points = 720;  // of a round, drawn

// The component that is sized: the one named, else the scene's only flywheel; empty: one is put on the crank's shaft.
std::string chosen_flywheel(const Scene& scene, const std::string& named);

// The scene with another inertia of a flywheel; one that is not there is put on `on`'s shaft.
Scene with_flywheel(Scene scene, const std::string& flywheel, double inertia, const std::string& on);

// A round of the steady motion with a flywheel.
struct SizedRound {
  double flywheel = 0;                          // [kg·m²]
  Estimate crank, motor;                        // δ of the link and of the motor's shaft, by its own mid speed
  double mid_speed = 0;                         // of the link [rad/s]
  int cycles = 0;                               // that the search for it cost
  std::vector<double> phi, speed, motor_speed;  // [rad], [rad/s]; the motor's reduced to the link
};

struct SizedOrbit : SizedRound {
  bool found = false;
  std::string why;  // in words, unless it was found
  bool interrupted = false;
  bool stops = false;              // the machine comes to rest with it; else nothing is known of its motion
  double start_speed = 0;          // of the link at its angle 0 [rad/s]
  std::vector<std::string> notes;  // how far the model holds in this motion
};

class SizedOrbits {
 public:
  struct Parts {
    std::string flywheel, on, motor;  // component; link that it is put on if it is not there; empty: no motor
    Moment moment;                    // that the scene is as of
    int most_rounds = OrbitOptions{}.most_rounds;
    std::optional<double> held = {};  // mid speed that is kept where its own start leads to no cycle [rad/s]
  };
  SizedOrbits(const Scene& scene, Parts parts, const Watch& watch)
      : scene_(scene), parts_(std::move(parts)), watch_(watch) {}

  // From the scene's own start; a machine without a sequence begins at `start_speed` of the link, if given, in quasi-static
  // equilibrium, as it would get there anyway. The error costs another search.
  SizedOrbit at(double flywheel, const Effects& effects, std::optional<double> start_speed, bool with_error) const;

  struct Meeting {
    std::optional<SizedOrbit> orbit;  // whose δ is the demanded one to 1e-5 of it; empty: none
    double error = 0;                 // of its flywheel [kg·m²]
    double least = 0, least_at = 0;   // the smallest δ that was found, and its flywheel [kg·m²]
    int orbits = 0;                   // asked
    std::string unknown;              // why nothing is known of the motion with one of the inertias asked; else empty
  };
  // By secants over the logarithms of δ and of the inertia, at most eight steady motions. `others`: what turns with the flywheel,
  // on its shaft [kg·m²].
  Meeting meeting(double delta, const SizedOrbit& first, double others, const Effects& effects) const;

 private:
  const Scene& scene_;
  Parts parts_;
  const Watch& watch_;
};

}  // namespace kurbel
