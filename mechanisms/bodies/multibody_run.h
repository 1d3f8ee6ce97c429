// multibody_run.h — full multibody simulation of a mechanism in Simbody: the slow reference for the reduced machine.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanisms/bodies/mechanism_tree.h"

namespace kurbel {

struct MultibodyProblem {
  BodiesOf mechanism;        // without change points
  double shaft_inertia = 0;  // additional inertia on the crank's shaft [kg·m²], ≥ 0
  std::function<double(double t, double phi, double omega)> shaft_torque;  // on the crank [N·m]; empty: none
  // On the output: a force along +x [N] or, on a rocking output, a torque [N·m]; empty: none.
  std::function<double(double t, double x, double v)> load;
  double phi0 = 0;            // [rad]
  double omega0 = 0;          // [rad/s]
  double t_end = 0;           // [s], > 0
  double accuracy = 1e-6;     // of Simbody's local error control, 0 < accuracy < 1; closure tolerance: a tenth of it
  std::vector<double> times;  // report times, ascending, 0 … t_end; empty: only t_end
  std::string integrator = "RungeKuttaMerson";  // one of multibody_integrators()
};

struct MultibodySample {
  double t;               // [s]
  double phi, omega;      // crank; φ is not wrapped [rad], [rad/s]
  double x, v;            // output [m], [m/s] or [rad], [rad/s]
  double kinetic_energy;  // of all bodies and the shaft [J]
};

struct MultibodyResult {
  std::vector<MultibodySample> samples;  // one for each report time
  long steps = 0, rejected = 0, evaluations = 0;
};

// Names for MultibodyProblem::integrator, the default first.
std::vector<std::string> multibody_integrators();

// Steps end exactly at the report times (no interpolation); the state is projected onto the closures whenever they exceed
// their tolerance. Throws std::invalid_argument for an invalid problem; std::runtime_error if the integrator fails, a
// state becomes non-finite or the loop changes its assembly branch; and whatever the torque and force functions throw.
MultibodyResult run_multibody(const MultibodyProblem& problem);

}  // namespace kurbel
