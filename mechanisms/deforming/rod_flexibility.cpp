// rod_flexibility.cpp — integrals of the shape functions in closed form.
#include "mechanisms/deforming/rod_flexibility.h"

#include <cmath>
#include <numbers>

namespace kurbel {

RodModes::RodModes(const RodFlexibility& rod, double l, double rod_mass)
    : bending(rod.modes), axial(rod.axial), length(l), mass_per_length(rod_mass / l) {
  constexpr double pi = std::numbers::pi;
  for (int i = 0; i < bending; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double n = (i + 1) * pi, sign = i % 2 == 0 ? 1 : -1, odd = i % 2 == 0 ? 2 : 0;  // odd: 1 − cos iπ
    across[k] = odd / n * l;
    moment_across[k] = sign / n * l * l;
    product[0][k] = 8 / (n * n * n) * odd * l;
    product[1][k] = (sign / n - 4 / (n * n * n) * odd) * l;
    mass[k][k] = mass_per_length * l / 2;
    stiffness[k][k] = rod.modulus * rod.second_moment * n * n * n * n / (2 * l * l * l);
    damping[k][k] = 2 * rod.damping_ratio * std::sqrt(stiffness[k][k] * mass[k][k]);
  }
  if (!axial) return;
  const auto m = static_cast<std::size_t>(bending), e = m + 1;
  along[m] = 2 * l / 3, along[e] = l / 6;
  moment_along[m] = l * l / 3, moment_along[e] = l * l / 6;
  const double unit = rod.stretching_mass_factor * mass_per_length * l / 15;
  mass[m][m] = 8 * unit, mass[e][e] = 2 * unit, mass[m][e] = mass[e][m] = unit;
  const double k = rod.modulus * rod.area / (3 * l);
  stiffness[m][m] = 16 * k, stiffness[e][e] = 7 * k, stiffness[m][e] = stiffness[e][m] = -8 * k;
  // In proportion to the stiffness; ω of the rod fixed at one end.
  const double omega = pi / 2 / l * std::sqrt(rod.modulus * rod.area / mass_per_length);
  for (const std::size_t a : {m, e})
    for (const std::size_t b : {m, e}) damping[a][b] = 2 * rod.damping_ratio / omega * stiffness[a][b];
}

double RodModes::frequency(int bending_mode) const {
  const auto k = static_cast<std::size_t>(bending_mode - 1);
  return std::sqrt(stiffness[k][k] / mass[k][k]);
}

double RodModes::shape(int amplitude, double xi) const {
  if (amplitude < bending) return std::sin((amplitude + 1) * std::numbers::pi * xi);
  return amplitude == bending ? 4 * xi * (1 - xi) : xi * (2 * xi - 1);
}

double RodModes::curvature(int amplitude, double xi) const {
  if (amplitude >= bending) return 0;
  const double n = (amplitude + 1) * std::numbers::pi / length;
  return -n * n * shape(amplitude, xi);
}

}  // namespace kurbel
