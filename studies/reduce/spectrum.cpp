// spectrum.cpp — harmonics of a piecewise function of the angle, by quadrature of its pieces.
#include <cmath>

#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "studies/reduce/reduce.h"

namespace kurbel {

Spectrum spectrum(const std::string& name, const std::string& unit, const Piecewise& f, int orders) {
  Spectrum s{name, unit, {}, 0, 1};
  const double base = turn / f.length();  // order of the first harmonic
  // Integrals of the polynomials times cos, sin: pieces short against the wave are integrated to rounding.
  const int parts = 1 + static_cast<int>(orders * base * f.length() / static_cast<double>(f.pieces()) / 2);
  std::vector<double> breaks;
  for (std::size_t i = 0; i < f.pieces(); ++i)
    for (int k = 0; k < parts; ++k) breaks.push_back(f.breaks()[i] + (f.breaks()[i + 1] - f.breaks()[i]) * k / parts);
  breaks.push_back(f.end());
  const auto mean_of = [&](auto&& factor) {
    std::vector<double> samples;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
      for (std::size_t k = 0; k < Piecewise::nodes; ++k) {
        const double x = breaks[i] + 0.5 * (breaks[i + 1] - breaks[i]) * (1 + Piecewise::node(k));
        samples.push_back(factor(f.value_in(i / at(parts), x), x));
      }
    return Piecewise::through(breaks, samples).mean();
  };
  s.mean_square = mean_of([](double y, double) { return y * y; });
  double sum = 0;
  for (int n = 0; n <= orders; ++n) {
    Deadline::check();
    const double order = n * base, factor = n == 0 ? 1 : 2;
    const double a = factor * mean_of([&](double y, double x) { return y * std::cos(order * x); });
    const double b = factor * mean_of([&](double y, double x) { return y * std::sin(order * x); });
    s.harmonics.push_back({order, {n == 0 ? a : std::hypot(a, b)}, n == 0 ? 0 : std::atan2(b, a)});
    sum += (n == 0 ? 1 : 0.5) * (a * a + b * b);
  }
  s.captured = s.mean_square > 0 ? sum / s.mean_square : 1;
  return s;
}

}  // namespace kurbel
