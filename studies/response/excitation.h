// excitation.h — excitations of a drive: residuals of the full equations along the uniform motion, by order and
// frequency.
//
// Along the base motion (base_motion.h) the equations have residuals: torques Zᵀ(M − I ω̇), rates of internal states,
// and twists of joints with varying ratio, from any element. Over the angle they are T(φ) = T₀ + Re Σ T_r e^{i r φ};
// computed at a few speeds and interpolated (a + b Ω + c Ω² for a mechanism), checked at another one. Functions of
// time are analysed over their common period at a fixed angle.
#pragma once

#include <complex>
#include <memory>
#include <string>
#include <vector>

#include "engine/linear/linearise.h"

namespace kurbel {

using Complex = std::complex<double>;

// Complex amplitudes 2/N Σ x_k e^{−2πi rk/N} of r = 0 … N/2; entry 0 is the mean. N a power of two.
std::vector<Complex> harmonics_of(const std::vector<double>& samples);

// Kind of a residual.
enum class LeftOver {
  torque,         // on a coordinate [N·m]
  internal_rate,  // of an internal state
  twist,          // of a joint, demanded by the kinematics [rad]
  joint_torque    // transmitted by a joint along the base motion [N·m]
};

// Speeds of the reduction link at which amplitudes are known [rad/s].
using NodeSpeeds = std::shared_ptr<const std::vector<double>>;

struct OrderSource {
  std::string component;  // where it acts
  LeftOver kind = LeftOver::torque;
  int index = -1;                            // coordinate, internal state, joint
  NodeSpeeds nodes;                          // null: one speed only
  std::vector<std::vector<Complex>> values;  // per node: of the harmonics of the cycle; entry 0 is the mean
  Complex at(std::size_t harmonic, double speed) const;
};

struct FrequencySource {
  std::string component;
  LeftOver kind = LeftOver::torque;
  int index = -1;
  double omega = 0;   // [rad/s]
  Complex amplitude;  // Re(A e^{iωt})
};

// Ideal gears excite nothing; the order that meshing would have: teeth · speed of the wheel over the link's.
struct GearMesh {
  std::string name;
  double order = 0;
};

struct Excitations {
  double fundamental = 1;             // order of the first harmonic: ½ for a cycle of two turns
  std::size_t harmonics = 0;          // counted from 1
  std::vector<char> counts;           // per harmonic: whether it is considered; empty: all
  std::vector<OrderSource> by_order;  // over a range of speeds
  std::vector<OrderSource> here;      // at the speed of the drive
  double speed = 0;                   // that speed [rad/s]
  std::vector<FrequencySource> by_frequency;
  std::vector<GearMesh> meshes;
  double misfit = 0;  // relative error of the interpolation, over the largest amplitude
  std::vector<std::string> notes;

  bool none() const { return by_order.empty() && by_frequency.empty(); }
  bool is_looked_at(std::size_t harmonic) const { return counts.empty() || counts[harmonic]; }
  double order(std::size_t harmonic) const { return fundamental * static_cast<double>(harmonic); }
  const std::vector<OrderSource>& at_speed(double w) const { return w == speed && !here.empty() ? here : by_order; }
  // Σ of the torques' magnitudes on the coordinates [N·m].
  double strength(std::size_t harmonic, double speed) const;
};

// Harmonics up to highest_order, for speeds from 0 to fastest [rad/s]; fastest < 0: the machine turns backwards.
// `further`: also strong ones beyond it at the drive's own speed, such as those of meshing teeth.
Excitations find_excitations(const LinearDrive& drive, double fastest, double highest_order, bool further = false);

// Per coordinate: error of the mean torque at this speed from coarse averages of the base motion [N·m].
std::shared_ptr<const Eigen::VectorXd> mean_missed(const LinearDrive& drive, const Excitations& excitations,
                                                   double speed);
inline constexpr int coarse_positions = 16;  // of those averages, per turn

// Variation of the mechanisms' inertia in a mode, relative to its modal inertia: ε_r of vᵀ(M(φ) − M̄)v, vᵀM̄v = 1.
std::vector<double> inertia_variation(const LinearDrive& drive, const Eigen::VectorXd& shape, std::size_t harmonics);

}  // namespace kurbel
