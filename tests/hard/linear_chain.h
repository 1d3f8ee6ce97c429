// linear_chain.h — the exact motion of a chain of inertias and linear couplings, by the matrix exponential.
#pragma once

#include <string>
#include <vector>

namespace kurbel::hard {

// J_0 –[k_0, c_0]– J_1 –…; from rest and untwisted, torque M + A sin(Ω t) on J_0 from t = 0 on.
struct LinearChain {
  std::vector<double> inertia, stiffness, damping;
  double torque = 0;
  double amplitude = 0, frequency = 0;  // Ω [rad/s]

  struct Motion {
    std::vector<double> angle, speed;  // per inertia
  };
  // Inertias of 0 between two dampers are eliminated; at most one, and not at an end.
  Motion at(double t) const;
  // Components j0, k0, j1, … with all couplings elastic; "source" drives j0.
  std::string scene(double until) const;
};

}  // namespace kurbel::hard
