// legendre.h — functions on [−1, 1] by their values at 16 nodes of Gauss: Legendre coefficients, sums, integrals.
#pragma once

#include <array>
#include <cstddef>

#include "engine/base/gauss.h"

namespace kurbel::legendre {

inline constexpr std::size_t n = 16;  // nodes, and coefficients
using Row = std::array<double, n>;

// P₀ … P_n at x: (k + 1) P_{k+1} = (2k + 1) x P_k − k P_{k−1}
struct Recursion {
  Row by_x{}, back{};
  constexpr Recursion() {
    for (std::size_t k = 1; k < n; ++k) {
      const auto d = static_cast<double>(k);
      by_x[k] = (2 * d + 1) / (d + 1);
      back[k] = d / (d + 1);
    }
  }
};
inline constexpr Recursion recursion;

constexpr std::array<double, n + 1> polynomials(double x) {
  std::array<double, n + 1> p{1, x};
  for (std::size_t k = 1; k < n; ++k) p[k + 1] = recursion.by_x[k] * x * p[k] - recursion.back[k] * p[k - 1];
  return p;
}

// From values at the nodes to Legendre coefficients: row k gives coefficient k, (k + ½) w_i P_k(x_i).
inline constexpr std::array<Row, n> to_terms = [] {
  std::array<Row, n> rows{};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      rows[k][i] = (static_cast<double>(k) + 0.5) * gauss<n>.w[i] * polynomials(gauss<n>.x[i])[k];
  return rows;
}();

inline Row terms(const Row& values) {
  Row c{};
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i) c[k] += to_terms[k][i] * values[i];
  return c;
}

inline constexpr Row inverse_odd = [] {
  Row r{};
  for (std::size_t k = 0; k < n; ++k) r[k] = 1 / (2 * static_cast<double>(k) + 1);
  return r;
}();

// Σ terms_k P_k(x)
inline double sum(const Row& terms, double x) {
  const auto p = polynomials(x);
  double value = 0;
  for (std::size_t k = 0; k < n; ++k) value += terms[k] * p[k];
  return value;
}

// ∫ from −1 to x:  ∫P_k = (P_{k+1} − P_{k−1})/(2k + 1)
inline double integral(const Row& terms, double x) {
  const auto p = polynomials(x);
  double value = terms[0] * (x + 1);
  for (std::size_t k = 1; k < n; ++k) value += terms[k] * inverse_odd[k] * (p[k + 1] - p[k - 1]);
  return value;
}

}  // namespace kurbel::legendre
