// dual.h — numbers with their derivatives by N inputs: the exact Jacobian of an element from its own formula.
#pragma once

#include <array>
#include <cmath>

namespace kurbel {

template <int N>
struct Dual {
  double value = 0;
  std::array<double, N> d{};

  Dual() = default;
  Dual(double v) : value(v) {}  // NOLINT: a constant is a dual number with zero derivatives
  static Dual input(double v, int index) {
    Dual x(v);
    x.d[static_cast<std::size_t>(index)] = 1;
    return x;
  }
  // f(x) with f′(x).
  Dual chain(double f, double slope) const {
    Dual r(f);
    for (std::size_t i = 0; i < N; ++i) r.d[i] = slope * d[i];
    return r;
  }

  friend Dual operator+(const Dual& a, const Dual& b) {
    Dual r(a.value + b.value);
    for (std::size_t i = 0; i < N; ++i) r.d[i] = a.d[i] + b.d[i];
    return r;
  }
  friend Dual operator-(const Dual& a) { return a.chain(-a.value, -1); }
  friend Dual operator-(const Dual& a, const Dual& b) { return a + (-b); }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual r(a.value * b.value);
    for (std::size_t i = 0; i < N; ++i) r.d[i] = a.d[i] * b.value + a.value * b.d[i];
    return r;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    Dual r(a.value / b.value);
    for (std::size_t i = 0; i < N; ++i) r.d[i] = (a.d[i] - r.value * b.d[i]) / b.value;
    return r;
  }
  friend Dual sin(const Dual& x) { return x.chain(std::sin(x.value), std::cos(x.value)); }
  friend Dual cos(const Dual& x) { return x.chain(std::cos(x.value), -std::sin(x.value)); }
  friend Dual sqrt(const Dual& x) {
    const double root = std::sqrt(x.value);
    return x.chain(root, 0.5 / root);
  }
  friend Dual exp(const Dual& x) {
    const double e = std::exp(x.value);
    return x.chain(e, e);
  }
  friend Dual tanh(const Dual& x) {
    const double h = std::tanh(x.value);
    return x.chain(h, 1 - h * h);
  }
  // xⁿ for x > 0.
  friend Dual pow(const Dual& x, double n) { return x.chain(std::pow(x.value, n), n * std::pow(x.value, n - 1)); }
  friend Dual abs(const Dual& x) { return x.chain(std::abs(x.value), x.value < 0 ? -1.0 : 1.0); }
};

inline double value_of(double x) { return x; }
template <int N>
double value_of(const Dual<N>& x) {
  return x.value;
}

}  // namespace kurbel
