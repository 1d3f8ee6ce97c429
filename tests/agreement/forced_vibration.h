// forced_vibration.h — how a machine vibrates in its steady motion: the torque of every elastic joint over a period, by orders.
//
//     τ(t) = τ₀ + Σ_h Re c_h e^{2πi h t/T}         c_h by the trapezium rule, T the period of the settled run
// In a machine whose link turns by Φ in T, h is the order 2πh/Φ of the link's turn.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "tests/agreement/settled_run.h"

namespace kurbel::agreement {

struct JointVibration {
  std::string component;
  std::size_t elastic = 0;                     // of the model
  double scale = 0;                            // largest torque of the period [N·m]
  double mean = 0, greatest = 0, least = 0;    // [N·m]
  double error = 0;                            // against a run with looser tolerances [N·m]
  double extremes_error = 0;                   // of greatest and least, between looks, too
  std::vector<std::complex<double>> harmonic;  // c_h, h from 0: the mean
};

// Empty where the machine does not repeat. Throws std::runtime_error where a period more fails.
std::vector<JointVibration> joint_vibrations_of(const SettledRun& run, std::size_t harmonics);

}  // namespace kurbel::agreement
