// friction_loads.h — linear algebra of the friction loads in one state, for JointFriction alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "mechanisms/friction/joint_friction.h"

namespace kurbel {

// One state: the laws' coefficients, (1) of the header, its solution. Reactions in the order of a column of the table; of
// matrices whole columns, so that sums go over several rows at once.
struct JointFriction::Work {
  static constexpr std::size_t most_reactions = 2 * most_joints;
  std::size_t n = 0, joints = 0;
  double phi = 0;
  bool given = false;                            // the acceleration is given
  bool answers = false;                          // the acceleration answers the friction
  double strength[most_joints];                  // −sgn(v) times ρ or f + k_r/r_r
  double edge[2][most_joints];                   // shares of u and w in Σ|N|; 0: by their signs
  double base[most_reactions];                   // R₀
  double answer[most_reactions];                 // b
  double influence[most_loads][most_reactions];  // U + m b vᵀ
  double q[most_loads], r[most_reactions], wanted[most_loads];
  double largest = 0, least = 0;      // of |wanted|: of all, of pins with friction
  double by[2][most_loads];           // ∂law/∂ the two reactions of its joint
  std::size_t of[most_loads];         // joint of each load
  double lu[most_loads][most_loads];  // of 1 − s ∂law/∂R (U + m b vᵀ)
  double inverse[most_loads];         // of its pivots
  std::size_t row[most_loads];
  double determinant = 1;

  // N: the number of loads if each joint has one and their number is known at compile time; else 0.
  template <std::size_t N>
  void react() {
    const std::size_t n = N > 0 ? N : this->n, reactions = 2 * (N > 0 ? N : joints);
    double sum[N > 0 ? 2 * N : most_reactions];
    std::copy_n(base, reactions, sum);
#pragma GCC unroll 8
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < reactions; ++i) sum[i] += influence[k][i] * q[k];
    std::copy_n(sum, reactions, r);
  }
  template <std::size_t N>
  void factorise(double share) {
    const std::size_t n = N > 0 ? N : this->n;
    double first[N > 0 ? N : most_loads], second[N > 0 ? N : most_loads];
    for (std::size_t i = 0; i < n; ++i) first[i] = -(share * by[0][i]), second[i] = share * by[1][i];
#pragma GCC unroll 8
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t joint = N > 0 ? i : of[i];
        lu[k][i] = first[i] * influence[k][joint] - second[i] * influence[k][(N > 0 ? N : joints) + joint];
      }
      lu[k][k] += 1;
    }
    determinant = 1;
#pragma GCC unroll 8
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < n; ++i)
        if (std::abs(lu[k][i]) > std::abs(lu[k][pivot])) pivot = i;
      row[k] = pivot;
      if (pivot != k) {
        for (std::size_t j = 0; j < n; ++j) std::swap(lu[j][k], lu[j][pivot]);
        determinant = -determinant;
      }
      determinant *= lu[k][k];
      if (lu[k][k] == 0) continue;
      inverse[k] = 1 / lu[k][k];
      for (std::size_t i = k + 1; i < n; ++i) lu[k][i] *= inverse[k];
      for (std::size_t j = k + 1; j < n; ++j)
        for (std::size_t i = k + 1; i < n; ++i) lu[j][i] -= lu[k][i] * lu[j][k];
    }
  }
  template <std::size_t N>
  void solve(double* x) const {
    const std::size_t n = N > 0 ? N : this->n;
#pragma GCC unroll 8
    for (std::size_t k = 0; k < n; ++k)
      if (row[k] != k) std::swap(x[k], x[row[k]]);
#pragma GCC unroll 8
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = k + 1; i < n; ++i) x[i] -= lu[k][i] * x[k];
#pragma GCC unroll 8
    for (std::size_t left = n; left > 0; --left) {
      const std::size_t k = left - 1;
      for (std::size_t j = k + 1; j < n; ++j) x[k] -= lu[j][k] * x[j];
      x[k] *= inverse[k];
    }
  }
  // Calls f with the number of loads as a constant, if it is one of the usual ones.
  template <class F>
  auto sized(F f) const {
    switch (n == joints ? n : 0) {
      case 1:
        return f(std::integral_constant<std::size_t, 1>());
      case 2:
        return f(std::integral_constant<std::size_t, 2>());
      case 3:
        return f(std::integral_constant<std::size_t, 3>());
      case 4:
        return f(std::integral_constant<std::size_t, 4>());
      case 5:
        return f(std::integral_constant<std::size_t, 5>());
      case 7:
        return f(std::integral_constant<std::size_t, 7>());
      default:
        return f(std::integral_constant<std::size_t, 0>());
    }
  }
};

}  // namespace kurbel
