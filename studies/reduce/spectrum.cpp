// spectrum.cpp — harmonics of a function of the angle by pieces.
#include <cmath>

#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "studies/reduce/reduce.h"

namespace kurbel {

Spectrum spectrum(const std::string& name, const std::string& unit, const Piecewise& f, int orders) {
  Spectrum s{name, unit, {}, 0, 1};
  const double base = turn / f.length();  // order of the first harmonic
  s.mean_square = f.mean_square();
  double sum = 0;
  for (int n = 0; n <= orders; ++n) {
    Deadline::check();
    const double order = n * base, factor = n == 0 ? 1 : 2;
    const std::complex<double> wave = factor * f.mean_with_wave(order);
    const double a = wave.real(), b = wave.imag();
    s.harmonics.push_back({order, {n == 0 ? a : std::hypot(a, b)}, n == 0 ? 0 : std::atan2(b, a)});
    sum += (n == 0 ? 1 : 0.5) * (a * a + b * b);
  }
  s.captured = s.mean_square > 0 ? sum / s.mean_square : 1;
  return s;
}

}  // namespace kurbel
