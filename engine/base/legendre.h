// legendre.h — polynomials on [−1, 1] as Legendre series: coefficients from values at Gauss nodes, values, integrals.
#pragma once

#include <array>
#include <cstddef>

#include "engine/base/gauss.h"

namespace kurbel::legendre {

inline constexpr std::size_t most_terms = 17;

// (k + 1) P_{k+1} = (2k + 1) x P_k − k P_{k−1}
struct Recursion {
  std::array<double, most_terms + 1> by_x{}, back{};
  constexpr Recursion() {
    for (std::size_t k = 0; k <= most_terms; ++k) {
      const auto d = static_cast<double>(k);
      by_x[k] = (2 * d + 1) / (d + 1);
      back[k] = d / (d + 1);
    }
  }
};
inline constexpr Recursion recursion;

// P₀ … P_n at x.
template <std::size_t n>
constexpr std::array<double, n + 1> polynomials(double x) {
  std::array<double, n + 1> p{1, x};
  for (std::size_t k = 1; k < n; ++k) p[k + 1] = recursion.by_x[k] * x * p[k] - recursion.back[k] * p[k - 1];
  return p;
}

// From values at n nodes to n coefficients: row k gives coefficient k, (k + ½) w_i P_k(x_i).
template <std::size_t n>
inline constexpr std::array<std::array<double, n>, n> to_terms = [] {
  std::array<std::array<double, n>, n> rows{};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      rows[k][i] = (static_cast<double>(k) + 0.5) * gauss<n>.w[i] * polynomials<n>(gauss<n>.x[i])[k];
  return rows;
}();

template <std::size_t n>
std::array<double, n> terms(const std::array<double, n>& values) {
  std::array<double, n> c{};
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i) c[k] += to_terms<n>[k][i] * values[i];
  return c;
}

// Σ terms_k P_k(x)
template <std::size_t n>
double sum(const std::array<double, n>& terms, double x) {
  const auto p = polynomials<n>(x);
  double value = 0;
  for (std::size_t k = 0; k < n; ++k) value += terms[k] * p[k];
  return value;
}

// ∫ from −1 to x:  ∫P_k = (P_{k+1} − P_{k−1})/(2k + 1)
template <std::size_t n>
double integral(const std::array<double, n>& terms, double x) {
  static constexpr std::array<double, n> inverse_odd = [] {
    std::array<double, n> r{};
    for (std::size_t k = 0; k < n; ++k) r[k] = 1 / (2 * static_cast<double>(k) + 1);
    return r;
  }();
  const auto p = polynomials<n>(x);
  double value = terms[0] * (x + 1);
  for (std::size_t k = 1; k < n; ++k) value += terms[k] * inverse_odd[k] * (p[k + 1] - p[k - 1]);
  return value;
}

}  // namespace kurbel::legendre
