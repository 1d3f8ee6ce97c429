// eigen_modes.h — natural frequencies and mode shapes of a linearised drive, with error bounds.
//
//     undamped   K v = ω² M v,  vᵀ M v = 1                      small drives: dense; large ones: shift and invert
//     damped     (λ² M + λ C + K − B (λ − F)⁻¹ (λ H + G T)) v = 0,  λ = −ζ |λ| ± i ω_d
// Undamped: only springs, internal states of the elements constant. Errors: of ω², the residual of its pair, or its square
// over the gap to the next one (Kato, Temple); of λ, its condition number times the backward error.
// Modes are counted by Sylvester's law of inertia (Sturm count): K − σ M has as many negative pivots as there are modes
// below √σ, which proves that none is missed.
#pragma once

#include <complex>
#include <vector>

#include "engine/linear/linearise.h"

namespace kurbel {

struct ModesWanted {
  int count = 20;         // number of lowest modes, without rigid-body motions; ≥ 1
  int dense_below = 160;  // up to so many coordinates all modes are computed by a dense solver
};

struct UndampedModes {
  int rigid = 0;           // motions without twist: ω = 0 exactly; they come first
  Eigen::VectorXd omega;   // ascending [rad/s]
  Eigen::MatrixXd shapes;  // columns; M-orthonormal
  Eigen::VectorXd error;   // of each ω [rad/s]
  double residual = 0;  // backward error: largest ‖A x − ω² x‖/‖A‖, A = M^(−½) K M^(−½), ‖x‖ = 1
  bool complete = false;  // all modes of the drive
  int counted_below = 0;  // by Sturm count, up to just above the last one: equals the number found
  int basis = 0;          // number of vectors of the iteration; 0: dense
};

// The lowest modes. Throws std::runtime_error if they do not converge to a backward error of 1e-10.
UndampedModes undamped_modes(const LinearDrive& drive, const ModesWanted& wanted = {});

// Where a mode's energy is. Of state i the share is |w_i v_i|/Σ |w_k v_k|, w and v the left and the right eigenvector: it
// does not depend on the states' units. Springs, inertias, windings, dampers and resistors are reciprocal; there w_i is
// ± v_i in units of √(2 E_i), and the share is that of the stored energy E_i itself: ½ k θ², ½ J ω², ½ L i².
struct EnergyParts {
  double springs = 0, inertias = 0;   // at a given angle of the link `springs` includes weights
  std::vector<double> own;            // per internal state; the sum of all shares is 1; empty: unknown, or none
  double in_internal_states() const;  // Σ of `own`
};

// λ² M + λ C + K over [q, z], the coordinates and the internal states: its nullspaces are the damped modes.
struct QuadraticPencil {
  ComplexSparseMatrix mass, damping, stiffness;
};
QuadraticPencil pencil_of(const LinearDrive& drive);

struct DampedMode {
  std::complex<double> lambda;    // [1/s], Im ≥ 0; Im = 0: aperiodic
  Eigen::VectorXcd shape;         // per coordinate; largest entry 1
  double error = 0;               // of λ [1/s]
  double in_internal_states = 0;  // share of its vector in internal states of elements; 1: the machine hardly moves
  EnergyParts energy = {};
  double natural() const { return std::abs(lambda); }                      // [rad/s]
  double ratio() const { return (0 - lambda.real()) / std::abs(lambda); }  // ζ, never −0; < 0: unstable
};

// Oscillating modes by ascending |λ|, then aperiodic ones. Small drives: all modes. Large ones: only the oscillating modes
// found from the given undamped ones by Newton's method.
std::vector<DampedMode> damped_modes(const LinearDrive& drive, const UndampedModes& undamped,
                                     const ModesWanted& wanted = {});

// Shares of the joints in the potential energy and of the movable shafts in the kinetic energy of a mode shape.
struct EnergyShares {
  std::vector<double> joint, shaft;  // each sums to 1
};
EnergyShares energy_shares(const LinearDrive& drive, const Eigen::VectorXd& shape);

}  // namespace kurbel
