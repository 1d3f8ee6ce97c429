// spectrum.cpp — harmonics of a function of the angle by pieces.
#include <algorithm>
#include <cmath>

#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
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

// Within pieces: an edge may be located slightly later in either, so that the other is evaluated on both sides.
double largest_difference(const Piecewise& f, const Piecewise& looser) {
  const double hair = 1e-6 * looser.length();
  const std::vector<double>& breaks = looser.breaks();
  double most = rounding_of_reduction * f.largest();
  for (std::size_t i = 0; i < f.pieces(); ++i) {
    const double middle = 0.5 * (f.breaks()[i] + f.breaks()[i + 1]), x = middle * looser.end() / f.end();
    const double here = f.value_in(i, middle);
    double apart = std::abs(here - looser.value(x));
    for (auto next = std::lower_bound(breaks.begin() + 1, breaks.end() - 1, x - hair);; ++next) {
      const double lo = *(next - 1), hi = *next;
      if (lo > x + hair) break;
      apart = std::min(apart, std::abs(here - looser.value_in(at(next - 1 - breaks.begin()), std::clamp(x, lo, hi))));
      if (next + 1 == breaks.end()) break;
    }
    most = std::max(most, apart);
  }
  return most;
}

}  // namespace kurbel
