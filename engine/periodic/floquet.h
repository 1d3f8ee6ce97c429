// floquet.h — exponents of the motions beside a cycle, from transition matrices of sub-intervals of the round.
//
//     δy(t) = e^{s t} p(t),  p(t + T) = p(t);   s = (ln μ + 2π i n)/T,  μ an eigenvalue of A_{K−1} … A_1 A_0
// The product is never formed (numerics/periodic_schur.h). Which n it is, μ does not say: it follows from the phase that
// the motion runs through from sub-interval to sub-interval, seen by the mode that it has most of.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "engine/periodic/mean_system.h"
#include "engine/return_map/return_map.h"

namespace kurbel {

struct FloquetExponent {
  std::complex<double> exponent;  // s [1/s]; Re = −∞: gone within a sub-interval, as where something sticks
  Eigen::VectorXcd shape;         // δy at the section, per state of y in its own unit; largest over the scales 1
  double phase_advance = 0;       // in one round [rad]: Im s · T
  int mode = -1;                  // that it has most of, of those that are compared with; −1: none
  double share = 0;               // its coefficient, on the average over the round; near 1 where they are much the same
  // The branch that is nearest to the mode's own frequency is this many times 1/T off: a mean that is a poor one.
  int off_nearest = 0;
  // The phase could not be followed all round (it jumps, or the mode is nearly nothing of the motion somewhere): the
  // branch is that nearest to the mode's own frequency, and the exponent is known but for multiples of 2πi/T.
  bool branch_by_mean = false;
  double error = 0;  // of s [1/s]
};

struct FloquetSpectrum {
  std::string why;                         // in words, where there are no exponents
  std::vector<FloquetExponent> exponents;  // Re s largest first
  std::vector<MeanMode> modes;             // that they are compared with
  double time = 0;                         // T of a round [s]
  std::size_t intervals = 0;               // K
  bool found() const { return why.empty(); }
};

struct FloquetOptions {
  std::vector<MeanMode> modes = {};  // to compare with; empty: those of the mean Jacobian over the round
  std::size_t intervals = 0;         // 0: as many as the machine needs
  bool measure_error = true;         // else rounding alone
};

// Of the fixed point z of a map. A machine that knows no time has no exponent along its own motion: the section leaves it
// out.
FloquetSpectrum floquet_exponents(const ReturnMap& map, const Eigen::VectorXd& z, const FloquetOptions& options = {});

}  // namespace kurbel
