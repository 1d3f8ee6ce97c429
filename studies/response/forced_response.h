// forced_response.h — steady swinging of a linearised drive under its excitations, at one speed.
//
//     (−ω² M + iω C + K) q_r = B z_r + f_r,  (iω − F) z_r = (iω H + G T) q_r + h_r  at ω = r Ω
//     torque of a joint τ_r = (k + iω c) θ_r, with what it hangs on besides
// The peak is that of the sum of all orders over the cycle, with their phases; torques of fixed frequencies, which come
// in any phase sooner or later, are added by amplitude.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "studies/response/excitation.h"

namespace kurbel {

struct JointResponse {
  double mean = 0;           // torque at that speed [N·m]
  double peak = 0;           // greatest departure from the mean [N·m]
  double upper = 0;          // greatest torque, mean included [N·m]
  double lower = 0;          // least
  double amplitude_sum = 0;  // Σ of the orders' amplitudes: never less than the peak
  double rms = 0;            // of the swinging part
  double power = 0;          // that it dissipates [W]
  std::size_t dominant = 0;  // harmonic with the largest amplitude; 0: a fixed frequency, or none
  double dominant_amplitude = 0;
  double dominant_omega = 0;  // its frequency [rad/s]
};

struct SpeedResponse {
  double speed = 0;        // of the reduction link [rad/s]
  double speed_swing = 0;  // of the link by all orders, its greatest departure from the mean [rad/s]
  bool kept = true;        // the machine stays at that speed; false: what is said here is of no motion that lasts
  std::vector<JointResponse> joints;
  std::vector<std::vector<Complex>> orders;  // per joint and harmonic: τ_r [N·m]
};

// What acts on a linear drive at one frequency, as Re(A e^{iωt}).
struct Forcing {
  Eigen::VectorXcd torque;        // on the coordinates [N·m]
  Eigen::VectorXcd own;           // on the rates of own states
  Eigen::VectorXcd twist;         // of the joints, that the kinematics demand [rad]
  Eigen::VectorXcd joint_torque;  // that the joints transmit without the drive's swinging [N·m]
  static Forcing none(const LinearDrive& drive);
  void add(LeftOver kind, int index, Complex amplitude);
};

// Swinging of a drive and its joints' torques at one frequency. Not finite at an undamped resonance.
class FrequencyResponse {
 public:
  explicit FrequencyResponse(const LinearDrive& drive);
  struct Motion {
    Eigen::VectorXcd q, own;  // [rad]
  };
  Motion motion(double omega, const Forcing& forcing);
  struct JointSwing {
    Complex torque, twist;  // [N·m], [rad]
  };
  std::vector<JointSwing> swings(double omega, const Forcing& forcing);
  std::vector<JointSwing> swings(double omega, const Forcing& forcing, const Motion& motion) const;

 private:
  struct Solver;
  const LinearDrive& drive_;
  std::shared_ptr<Solver> solver_;
};

SpeedResponse respond(const LinearDrive& drive, const Excitations& excitations);

// The same drive with springs so much stiffer that its joints transmit what they would in a rigid machine, to some 1e-6
// of (ω/ω_n)². None where a joint slips or sticks, or where torques hang on the twists besides.
std::optional<LinearDrive> as_if_rigid(LinearDrive drive);

// The same of torques over a round of the steady motion, evenly sampled; orders are multiples of one per round.
SpeedResponse response_of_samples(const std::vector<std::vector<double>>& torques, double speed, double round);

// Greatest and least value of Re Σ x_r e^{i r s} over s, r from 1 on; located to rounding.
struct Extremes {
  double greatest = 0, least = 0;
};
Extremes extremes_of_sum(const std::vector<Complex>& harmonics);

}  // namespace kurbel
