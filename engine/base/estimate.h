// estimate.h — a number with its error, the type of all values stated with ±.
//
// Both are in SI. The unit is stated where the number is named (a figure, a column, a key); nothing is converted within the
// program, and a vector of estimates has one unit.
//
// Errors are bounds: sums add them, a factor scales them, products and quotients propagate them to first order,
//
//     Δ(a ± b) = Δa + Δb,   Δ(k a) = |k| Δa,   Δ(a b) = |b| Δa + |a| Δb,   Δ(a/b) = (Δa + |a/b| Δb)/|b|,   Δf(a) = |f′| Δa
//
// and the result of an unknown error has an unknown error. Plain numbers are exact.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace kurbel {

struct Estimate {
  double value = 0;
  std::optional<double> error = {};  // ≥ 0, of the value; empty: unknown

  // Adds a contribution to the error; an unknown error counts as 0.
  void widen(double by) { error = error.value_or(0) + by; }
  // Adds `times` the difference from the same quantity of another run or extraction.
  void widen_to(const Estimate& other, double times = 1) { widen(times * std::abs(value - other.value)); }
};

// A quantity from two runs or extractions: the value of the finer one; error: their difference plus `rounding`.
inline Estimate estimate_from(double fine, double loose, double rounding = 0) {
  return {fine, std::abs(fine - loose) + rounding};
}

// The larger error of two values stated as one; unknown if one of them is.
inline std::optional<double> larger_error(const Estimate& a, const Estimate& b) {
  return a.error && b.error ? std::optional(std::max(*a.error, *b.error)) : std::nullopt;
}

namespace estimate {
inline std::optional<double> linear(double of_a, const Estimate& a, double of_b, const Estimate& b) {
  if (!a.error || !b.error) return {};
  return std::abs(of_a) * *a.error + std::abs(of_b) * *b.error;
}
inline std::optional<double> linear(double of_a, const Estimate& a) {
  return a.error ? std::optional(std::abs(of_a) * *a.error) : std::nullopt;
}
}  // namespace estimate

// f(a), by its value and derivative at a.
inline Estimate function_of(const Estimate& a, double value, double slope) {
  return {value, estimate::linear(slope, a)};
}

inline Estimate operator-(const Estimate& a) { return {-a.value, a.error}; }
inline Estimate operator+(const Estimate& a, const Estimate& b) {
  return {a.value + b.value, estimate::linear(1, a, 1, b)};
}
inline Estimate operator-(const Estimate& a, const Estimate& b) {
  return {a.value - b.value, estimate::linear(1, a, 1, b)};
}
inline Estimate operator*(const Estimate& a, const Estimate& b) {
  return {a.value * b.value, estimate::linear(b.value, a, a.value, b)};
}
inline Estimate operator/(const Estimate& a, const Estimate& b) {
  const double ratio = a.value / b.value;
  if (!a.error || !b.error) return {ratio};
  return {ratio, (*a.error + std::abs(ratio) * *b.error) / std::abs(b.value)};
}
inline Estimate operator*(double factor, const Estimate& a) { return {factor * a.value, estimate::linear(factor, a)}; }
inline Estimate operator/(const Estimate& a, double by) {
  return {a.value / by, a.error ? std::optional(*a.error / std::abs(by)) : std::nullopt};
}
inline Estimate abs(const Estimate& a) { return {std::abs(a.value), a.error}; }

}  // namespace kurbel
