// forced_response.h — steady forced vibration of a linearised drive at one speed.
//
//     (−ω² M + iω C + K) q_r = B z_r + f_r,  (iω − F) z_r = (iω H + G T) q_r + h_r  at ω = r Ω
//     torque of a joint τ_r = (k + iω c) θ_r, plus its dependence on other quantities
// The peak is that of the sum of all orders over the cycle, with their phases; torques of fixed frequencies, which
// occur in any phase, are added by amplitude.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "studies/response/excitation.h"

namespace kurbel {

struct JointResponse {
  double mean = 0;           // torque at that speed [N·m]
  double peak = 0;           // greatest deviation from the mean [N·m]
  double upper = 0;          // greatest torque, mean included [N·m]
  double lower = 0;          // least
  double amplitude_sum = 0;  // Σ of the orders' amplitudes, an upper bound of the peak
  double rms = 0;            // of the alternating part
  double power = 0;          // dissipated by it [W]
  std::size_t dominant = 0;  // harmonic with the largest amplitude; 0: a fixed frequency, or none
  double dominant_amplitude = 0;
  double dominant_omega = 0;  // its frequency [rad/s]
};

struct SpeedResponse {
  double speed = 0;            // of the reduction link [rad/s]
  double speed_amplitude = 0;  // of the link by all orders: greatest deviation from the mean [rad/s]
  bool kept = true;            // the machine can hold that speed; false: the response belongs to no lasting motion
  std::vector<JointResponse> joints;
  std::vector<std::vector<Complex>> orders;  // per joint and harmonic: τ_r [N·m]
};

// Excitation of a linear drive at one frequency, as Re(A e^{iωt}).
struct Forcing {
  Eigen::VectorXcd torque;        // on the coordinates [N·m]
  Eigen::VectorXcd own;           // on the rates of internal states
  Eigen::VectorXcd twist;         // of the joints, demanded by the kinematics [rad]
  Eigen::VectorXcd joint_torque;  // transmitted by the joints without vibration of the drive [N·m]
  static Forcing none(const LinearDrive& drive);
  void add(LeftOver kind, int index, Complex amplitude);
};

// Vibration of a drive and its joints' torques at one frequency. Not finite at an undamped resonance.
class FrequencyResponse {
 public:
  explicit FrequencyResponse(const LinearDrive& drive);
  struct Motion {
    Eigen::VectorXcd q, own;  // [rad]
  };
  Motion motion(double omega, const Forcing& forcing);
  struct JointVibration {
    Complex torque, twist;  // [N·m], [rad]
  };
  std::vector<JointVibration> vibrations(double omega, const Forcing& forcing);
  std::vector<JointVibration> vibrations(double omega, const Forcing& forcing, const Motion& motion) const;

 private:
  struct Solver;
  const LinearDrive& drive_;
  std::shared_ptr<Solver> solver_;
};

SpeedResponse respond(const LinearDrive& drive, const Excitations& excitations);

// The same drive with springs stiffened so that its joints transmit the torques of a rigid machine, to some 1e-6 of
// (ω/ω_n)². Empty if a joint slips or sticks, or if other torques depend on the twists.
std::optional<LinearDrive> as_if_rigid(LinearDrive drive);

// The response from torques over a period of the steady motion, equidistantly sampled; orders are multiples of one per period.
SpeedResponse response_of_samples(const std::vector<std::vector<double>>& torques, double speed, double round);

// Greatest and least value of Re Σ x_r e^{i r s} over s, r from 1 on; located to rounding.
struct Extremes {
  double greatest = 0, least = 0;
};
Extremes extremes_of_sum(const std::vector<Complex>& harmonics);

}  // namespace kurbel
