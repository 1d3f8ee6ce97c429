// multibody_run.h — a mechanism as a full multibody run in Simbody: the slow reference of the reduced machine.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanisms/bodies/mechanism_tree.h"

namespace kurbel {

struct MultibodyProblem {
  BodiesOf mechanism;        // of one that passes no change points
  double shaft_inertia = 0;  // more inertia on the crank's shaft [kg·m²], ≥ 0
  std::function<double(double t, double phi, double omega)> shaft_torque;  // on the crank [N·m]; empty: none
  // On the output: a force along +x [N] or, of one that rocks, a torque [N·m]; empty: none.
  std::function<double(double t, double x, double v)> load;
  double phi0 = 0;            // [rad]
  double omega0 = 0;          // [rad/s]
  double t_end = 0;           // [s], > 0
  double accuracy = 1e-6;     // of Simbody's local error control, 0 < accuracy < 1; the loop is held to a tenth of it
  std::vector<double> times;  // to report, ascending, 0 … t_end; the end alone if empty
  std::string integrator = "RungeKuttaMerson";  // one of multibody_integrators()
};

struct MultibodySample {
  double t;               // [s]
  double phi, omega;      // crank; φ grows on over the turns [rad], [rad/s]
  double x, v;            // output [m], [m/s] or [rad], [rad/s]
  double kinetic_energy;  // of all bodies with the shaft [J]
};

struct MultibodyResult {
  std::vector<MultibodySample> samples;  // one for each time asked for
  long steps = 0, rejected = 0, evaluations = 0;
};

// Names for MultibodyProblem::integrator, the default first.
std::vector<std::string> multibody_integrators();

// Steps end on the report times exactly (nothing is interpolated); the loop is projected back whenever it leaves its
// tolerance. Throws std::invalid_argument on a senseless problem; std::runtime_error if the integrator fails, a state
// becomes non-finite or the loop changes its assembly branch; and whatever the torque and force functions throw.
MultibodyResult run_multibody(const MultibodyProblem& problem);

}  // namespace kurbel
