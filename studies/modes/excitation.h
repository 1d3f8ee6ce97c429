// excitation.h — what makes a drive swing: torques by order of the reduction link's turn, by frequency, tooth meshes.
//
// An element that depends on the angle exerts T(φ) = T₀ + Re Σ T_r e^{i r φ} at uniform speed; a mechanism among it
// −½ I_r′(φ) Ω² and its loads. T_r = a + b Ω + c Ω², found from three speeds and checked at a fourth.
#pragma once

#include <complex>
#include <memory>
#include <string>
#include <vector>

#include "engine/analysis/linearise.h"

namespace kurbel {

using Complex = std::complex<double>;

// Complex amplitudes 2/N Σ x_k e^{−2πi rk/N} of r = 0 … N/2; entry 0 is the mean. N a power of two.
std::vector<Complex> harmonics_of(const std::vector<double>& samples);

struct OrderSource {
  std::string component;
  int coordinate = -1;           // it acts on
  std::vector<Complex> a, b, c;  // per harmonic of the cycle, on the coordinate [N·m], [N·m·s], [N·m·s²]
  Complex at(std::size_t harmonic, double speed) const {
    return a[harmonic] + speed * (b[harmonic] + speed * c[harmonic]);
  }
};

struct FrequencySource {
  std::string component;
  int coordinate = -1;
  double omega = 0;   // [rad/s]
  Complex amplitude;  // on the coordinate: Re(A e^{iωt}) [N·m]
};

// Ideal gears excite nothing; where their meshing would, order = teeth · speed of the wheel over the link's.
struct GearMesh {
  std::string name;
  double order = 0;
};

struct Excitations {
  double fundamental = 1;     // order of the first harmonic: ½ for a cycle of two turns
  std::size_t harmonics = 0;  // counted from 1
  std::vector<OrderSource> by_order;
  std::vector<FrequencySource> by_frequency;
  std::vector<GearMesh> meshes;
  double misfit = 0;  // at the fourth speed, over the largest amplitude
  std::vector<std::string> notes;

  double order(std::size_t harmonic) const { return fundamental * static_cast<double>(harmonic); }
  // Σ over the sources, regardless of phase [N·m].
  double strength(std::size_t harmonic, double speed) const;
};

// Harmonics up to highest_order, for speeds from 0 to fastest [rad/s]; fastest < 0: the machine turns backwards.
Excitations find_excitations(const LinearDrive& drive, double fastest, double highest_order);

// What swings over time counts with its mean: what to add per shaft to its torque at t = 0.
std::vector<double> mean_beyond_start(const LinearDrive& drive, const Excitations& excitations);

// Mean torques per shaft, at a speed, of all that depends on the angle.
std::vector<double> mean_of_angle(const LinearDrive& drive, const Excitations& excitations, double speed);

// Variation of the mechanisms' inertia in a mode, relative to its modal inertia: ε_r of vᵀ(M(φ) − M̄)v, vᵀM̄v = 1.
std::vector<double> inertia_variation(const LinearDrive& drive, const Eigen::VectorXd& shape, std::size_t harmonics);

}  // namespace kurbel
