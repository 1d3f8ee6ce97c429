// forced_response.h — steady swinging of a linearised drive under its excitations, at one speed.
//
//     (−ω² M + iω C + K) q_r = f_r at ω = r Ω;   torque of a joint τ_r = (k + iω c) θ_r
// The peak is that of the sum of all orders over the cycle, with their phases; torques of fixed frequencies, which come
// in any phase sooner or later, are added by amplitude.
#pragma once

#include <memory>
#include <vector>

#include "studies/modes/excitation.h"

namespace kurbel {

struct JointResponse {
  double mean = 0;           // torque at that speed [N·m]
  double peak = 0;           // greatest departure from the mean [N·m]
  double upper = 0;          // greatest torque, mean included [N·m]
  double lower = 0;          // least
  double amplitude_sum = 0;  // Σ of the orders' amplitudes: never less than the peak
  double rms = 0;            // of the swinging part
  double power = 0;          // dissipated by its damping [W]
  std::size_t dominant = 0;  // harmonic with the largest amplitude; 0: a fixed frequency, or none
  double dominant_amplitude = 0;
  double dominant_omega = 0;  // its frequency [rad/s]
};

struct SpeedResponse {
  double speed = 0;  // of the reduction link [rad/s]
  std::vector<JointResponse> joints;
  std::vector<std::vector<Complex>> orders;  // per joint and harmonic: τ_r [N·m]
};

// Amplitudes of all joints' torques under torques f e^{iωt} on the coordinates. Not finite at an undamped resonance.
class FrequencyResponse {
 public:
  explicit FrequencyResponse(const LinearDrive& drive);
  Eigen::VectorXcd motion(double omega, const Eigen::VectorXcd& force);  // q [rad]
  std::vector<Complex> torques(double omega, const Eigen::VectorXcd& force);

 private:
  struct Solver;
  const LinearDrive& drive_;
  std::shared_ptr<Solver> solver_;
};

SpeedResponse respond(const LinearDrive& drive, const Excitations& excitations);

// Greatest and least value of Re Σ x_r e^{i r s} over s, r from 1 on; located to rounding.
struct Extremes {
  double greatest = 0, least = 0;
};
Extremes extremes_of_sum(const std::vector<Complex>& harmonics);

}  // namespace kurbel
