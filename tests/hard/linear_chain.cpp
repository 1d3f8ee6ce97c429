// linear_chain.cpp — exp(A t) in long double by Taylor's series, scaling and squaring.
#include "tests/hard/linear_chain.h"

#include <cmath>

#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

using Real = long double;
using Matrix = std::vector<std::vector<Real>>;

Matrix product(const Matrix& a, const Matrix& b) {
  const std::size_t n = a.size();
  Matrix c(n, std::vector<Real>(n, 0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t j = 0; j < n; ++j) c[i][j] += a[i][k] * b[k][j];
  return c;
}

Matrix exponential(Matrix a) {
  const std::size_t n = a.size();
  Real norm = 0;
  for (const auto& row : a) {
    Real sum = 0;
    for (const Real x : row) sum += std::abs(x);
    norm = std::max(norm, sum);
  }
  const int squarings = norm > 0.5L ? static_cast<int>(std::ceil(std::log2(norm / 0.5L))) : 0;
  for (auto& row : a)
    for (Real& x : row) x = std::ldexp(x, -squarings);
  Matrix sum(n, std::vector<Real>(n, 0)), term = sum;
  for (std::size_t i = 0; i < n; ++i) sum[i][i] = term[i][i] = 1;
  for (int k = 1; k < 24; ++k) {
    term = product(term, a);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) sum[i][j] += term[i][j] /= k;
  }
  for (int k = 0; k < squarings; ++k) sum = product(sum, sum);
  return sum;
}

}  // namespace

// x = [φ_0 | √k θ | √J ω | 1, sin Ωt, cos Ωt]: of equal units, so that A is nearly skew.
LinearChain::Motion LinearChain::at(double t) const {
  const std::size_t n = inertia.size(), size = 2 * n + 3, one = 2 * n, sine = one + 1, cosine = one + 2;
  const auto twist = [](std::size_t i) { return 1 + i; };
  const auto speed = [n](std::size_t i) { return n + i; };
  std::vector<Real> root_k, root_j;
  for (const double k : stiffness) root_k.push_back(std::sqrt(static_cast<Real>(k)));
  for (const double j : inertia) root_j.push_back(j > 0 ? std::sqrt(static_cast<Real>(j)) : 1);

  // Rows of ω_i as combinations of the states: a massless inertia follows from the balance of its torques.
  std::vector<std::vector<Real>> omega(n, std::vector<Real>(size, 0));
  for (std::size_t i = 0; i < n; ++i)
    if (inertia[i] > 0) omega[i][speed(i)] = 1 / root_j[i];
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (inertia[i] > 0) continue;
    const Real sum = static_cast<Real>(damping[i - 1]) + damping[i];
    omega[i][twist(i - 1)] = root_k[i - 1] / sum;
    omega[i][twist(i)] = -root_k[i] / sum;
    omega[i][speed(i - 1)] = damping[i - 1] / sum / root_j[i - 1];
    omega[i][speed(i + 1)] = damping[i] / sum / root_j[i + 1];
  }
  Matrix a(size, std::vector<Real>(size, 0));
  a[0] = omega[0];
  for (std::size_t i = 0; i + 1 < n; ++i) {
    std::vector<Real> torque(size, 0);
    torque[twist(i)] = root_k[i];
    for (std::size_t c = 0; c < size; ++c) {
      const Real rate = omega[i][c] - omega[i + 1][c];
      a[twist(i)][c] = root_k[i] * rate;
      torque[c] += damping[i] * rate;
    }
    for (std::size_t c = 0; c < size; ++c) {
      if (inertia[i] > 0) a[speed(i)][c] -= torque[c] / root_j[i];
      if (inertia[i + 1] > 0) a[speed(i + 1)][c] += torque[c] / root_j[i + 1];
    }
  }
  a[speed(0)][one] += torque / root_j[0];
  a[speed(0)][sine] += amplitude / root_j[0];
  a[sine][cosine] = frequency;
  a[cosine][sine] = -static_cast<Real>(frequency);
  for (auto& row : a)
    for (Real& x : row) x *= t;

  const Matrix flow = exponential(std::move(a));
  std::vector<Real> x(size);
  for (std::size_t i = 0; i < size; ++i) x[i] = flow[i][one] + flow[i][cosine];
  Motion motion;
  Real angle = x[0];
  for (std::size_t i = 0; i < n; ++i) {
    Real omega_i = 0;
    for (std::size_t c = 0; c < size; ++c) omega_i += omega[i][c] * x[c];
    motion.angle.push_back(static_cast<double>(angle));
    motion.speed.push_back(static_cast<double>(omega_i));
    if (i + 1 < n) angle -= x[twist(i)] / root_k[i];
  }
  return motion;
}

std::string LinearChain::scene(double until) const {
  std::string line = "line = [\"source\"", text;
  text += fmt::format("source = {{ kind = \"torque source\", torque = {}", quantity(torque, "N*m"));
  if (amplitude != 0)
    text += fmt::format(", amplitude = {}, frequency = {}", quantity(amplitude, "N*m"),
                        quantity(frequency / (2 * pi), "Hz"));
  text += " }\n";
  for (std::size_t i = 0; i < inertia.size(); ++i) {
    line += fmt::format(", \"j{}\"", i);
    text += fmt::format("j{} = {{ kind = \"inertia\", inertia = {} }}\n", i, quantity(inertia[i], "kg*m2"));
    if (i >= stiffness.size()) continue;
    line += fmt::format(", \"k{}\"", i);
    text += fmt::format("k{} = {{ kind = \"coupling\", stiffness = {}, damping = {} }}\n", i,
                        quantity(stiffness[i], "N*m/rad"), quantity(damping[i], "N*m*s/rad"));
  }
  return line + "]\n" + text + "effects = { elasticity = true }\nrun = { until = " + quantity(until, "s") + " }\n";
}

}  // namespace kurbel::hard
