// eigen_modes.h — natural frequencies and shapes of a linearised drive, and how near to the exact ones they are.
//
//     undamped   K v = ω² M v,  vᵀ M v = 1                      small drives dense; large ones by shift and invert
//     damped     (λ² M + λ C + K − B (λ − F)⁻¹ (λ H + G T)) v = 0,  λ = −ζ |λ| ± i ω_d
// Undamped: springs alone, the elements' own states as they are. Errors: of ω², the residual of its pair, or its square over
// the gap to the next one (Kato, Temple); of λ, its condition number times the backward error.
// Modes are counted by Sylvester's law of inertia (Sturm's count): K − σ M has as many negative pivots as there are
// modes below √σ. So it is proven that none is missed.
#pragma once

#include <complex>
#include <vector>

#include "engine/linear/linearise.h"

namespace kurbel {

struct ModesWanted {
  int count = 20;         // lowest, rigid-body motions not counted; ≥ 1
  int dense_below = 160;  // coordinates up to which all modes are found by a dense solver
};

struct UndampedModes {
  int rigid = 0;           // motions without twist: ω = 0 exactly; they come first
  Eigen::VectorXd omega;   // ascending [rad/s]
  Eigen::MatrixXd shapes;  // columns; M-orthonormal
  Eigen::VectorXd error;   // of each ω [rad/s]
  double residual = 0;  // backward error: largest ‖A x − ω² x‖/‖A‖, A = M^(−½) K M^(−½), ‖x‖ = 1
  bool complete = false;  // all modes of the drive
  int counted_below = 0;  // by Sturm, up to just above the last one: equals what was found
  int basis = 0;          // vectors that the search needed; 0: dense
};

// The lowest modes. Throws std::runtime_error where they cannot be found to a backward error of 1e-10.
UndampedModes undamped_modes(const LinearDrive& drive, const ModesWanted& wanted = {});

// Where a mode's energy is. Of state i the share is |w_i v_i|/Σ |w_k v_k|, w and v the left and the right eigenvector: it
// does not depend on the states' units. Springs, inertias, windings, dampers and resistors are reciprocal; there w_i is
// ± v_i in units of √(2 E_i), and the share is that of the stored energy E_i itself: ½ k θ², ½ J ω², ½ L i².
struct EnergyParts {
  double springs = 0, inertias = 0;  // with the link held at an angle `springs` are weights, too
  std::vector<double> own;           // per own state; all of it together is 1; empty: not known, or there are none
  double in_own() const;             // Σ of `own`
};

struct DampedMode {
  std::complex<double> lambda;  // [1/s], Im ≥ 0; Im = 0: does not swing
  Eigen::VectorXcd shape;       // per coordinate; largest entry 1
  double error = 0;             // of λ [1/s]
  double in_own_states = 0;     // share of its vector in the elements' own states: 1 where the machine hardly moves
  EnergyParts energy = {};
  double natural() const { return std::abs(lambda); }                      // [rad/s]
  double ratio() const { return (0 - lambda.real()) / std::abs(lambda); }  // ζ, never −0; < 0: grows by itself
};

// Swinging modes by ascending |λ|, then those that do not swing. Small drives: all. Large ones: those that grow out of
// the undamped modes given, by Newton's method; without what does not swing.
std::vector<DampedMode> damped_modes(const LinearDrive& drive, const UndampedModes& undamped,
                                     const ModesWanted& wanted = {});

// Shares of each joint in the potential energy and of each shaft that may move in the kinetic energy of a shape.
struct EnergyShares {
  std::vector<double> joint, shaft;  // each sums to 1
};
EnergyShares energy_shares(const LinearDrive& drive, const Eigen::VectorXd& shape);

}  // namespace kurbel
