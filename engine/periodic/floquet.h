// floquet.h — Floquet exponents of a cycle, from the transition matrices of sub-intervals of the period.
//
//     δy(t) = e^{s t} p(t),  p(t + T) = p(t);   s = (ln μ + 2π i n)/T,  μ an eigenvalue of A_{K−1} … A_1 A_0
// The product is never formed (matrices/periodic_schur.h). n is not determined by μ; it follows from the phase of the motion
// from sub-interval to sub-interval, measured with its dominant mode.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "engine/periodic/mean_system.h"
#include "engine/return_map/return_map.h"

namespace kurbel {

struct FloquetExponent {
  std::complex<double> exponent;  // s [1/s]; Re = −∞: decays to zero within a sub-interval, for example by sticking
  Eigen::VectorXcd shape;         // δy at the section, per state of y in its own unit; maximum over the scales is 1
  double phase_advance = 0;       // in one period [rad]: Im s · T
  int mode = -1;                  // index of its dominant mode among those for comparison; −1: none
  double share = 0;               // mean coefficient of this mode over the period; near 1 if both are similar
  // Difference from the branch nearest to the mode's frequency, in multiples of 1/T; not 0: the mean is a poor approximation.
  int off_nearest = 0;
  // The phase could not be followed over the period (it jumps, or the share of the mode nearly vanishes): the branch is the
  // one nearest to the mode's frequency, and the exponent is known except for multiples of 2πi/T.
  bool branch_by_mean = false;
  double error = 0;  // of s [1/s]
};

struct FloquetSpectrum {
  std::string why;                         // the reason, if there are no exponents
  std::vector<FloquetExponent> exponents;  // Re s largest first
  std::vector<MeanMode> modes;             // for comparison
  double time = 0;                         // T, the period [s]
  std::size_t intervals = 0;               // K
  bool found() const { return why.empty(); }
};

struct FloquetOptions {
  std::vector<MeanMode> modes = {};  // for comparison; empty: those of the mean Jacobian over the period
  std::size_t intervals = 0;         // 0: chosen by the machine
  bool measure_error = true;         // false: rounding only
};

// Exponents at the fixed point z of a map. For an autonomous machine the zero exponent along the motion is excluded by the
// section.
FloquetSpectrum floquet_exponents(const ReturnMap& map, const Eigen::VectorXd& z, const FloquetOptions& options = {});

}  // namespace kurbel
