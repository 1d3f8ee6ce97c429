// slider_crank_statics_friction.h — friction in the slider-crank's joints at one state: a law over the reactions; its solution.
//
// Internal to slider_crank_statics*.cpp: what the private names of SliderCrankStatics stand for.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <utility>

#include "tests/mechanisms/slider_crank_statics.h"

namespace kurbel {

inline int sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

// q = law(reactions): the friction loads, each against its joint's motion.
struct SliderCrankStatics::Law {
  using Loads = Eigen::Matrix<double, frictions, 1>;
  // ∂q/∂reactions: each friction depends on two reactions at most.
  struct Slopes {
    struct Entry {
      int reaction = 0;
      double value = 0;
    };
    Entry on[frictions][2];
    template <class M>
    Eigen::Matrix<double, frictions, M::ColsAtCompileTime> operator*(const M& m) const {
      Eigen::Matrix<double, frictions, M::ColsAtCompileTime> product;
      for (int k = 0; k < frictions; ++k)
        product.row(k) = on[k][0].value * m.row(on[k][0].reaction) + on[k][1].value * m.row(on[k][1].reaction);
      return product;
    }
    friend Slopes operator*(double s, Slopes d) {
      for (auto& row : d.on)
        for (Entry& entry : row) entry.value *= s;
      return d;
    }
  };

  double circle[3];  // −sgn(rate) ρ of the revolute joints [m]
  double guide;      // −sgn(v) (f + k_r/R)
  double length, middle, half_width;

  Loads value(const Column& r) const;
  Slopes slope(const Column& r) const;
  static double size(const Column& r, int k) { return std::sqrt(r[2 * k] * r[2 * k] + r[2 * k + 1] * r[2 * k + 1]); }
  double moment(const Column& r) const { return r[guide_m] - middle * r[guide_n]; }  // about the guide's middle
  bool at_edges(const Column& r) const { return length > 0 && 2 * std::abs(moment(r)) > length * std::abs(r[guide_n]); }
  double bearing_sum(const Column& r) const;
  bool none() const { return circle[0] == 0 && circle[1] == 0 && circle[2] == 0 && guide == 0; }
};

// What friction adds to the balancing torque, with its derivative by ε.
struct SliderCrankStatics::FrictionTorque {
  double torque = 0, slope = 0;  // [N·m], [kg·m²]
};

// LU of a matrix of the frictions, with partial pivoting: of a size that the compiler unrolls.
class FrictionLu {
 public:
  static constexpr int n = SliderCrankStatics::frictions;
  using Matrix = Eigen::Matrix<double, n, n>;
  using Vector = Eigen::Matrix<double, n, 1>;

  FrictionLu() : FrictionLu(Matrix::Identity()) {}
  explicit FrictionLu(const Matrix& matrix) : lu_(matrix) {
    for (int k = 0; k < n; ++k) {
      int pivot = k;
      for (int i = k + 1; i < n; ++i)
        if (std::abs(lu_(i, k)) > std::abs(lu_(pivot, k))) pivot = i;
      row_[k] = pivot;
      if (pivot != k) {
        for (int j = 0; j < n; ++j) std::swap(lu_(k, j), lu_(pivot, j));
        determinant_ = -determinant_;
      }
      determinant_ *= lu_(k, k);
      if (lu_(k, k) == 0) continue;
      for (int i = k + 1; i < n; ++i) {
        const double factor = lu_(i, k) /= lu_(k, k);
        for (int j = k + 1; j < n; ++j) lu_(i, j) -= factor * lu_(k, j);
      }
    }
  }
  double determinant() const { return determinant_; }
  Vector solve(Vector x) const {
    for (int k = 0; k < n; ++k) std::swap(x[k], x[row_[k]]);
    for (int k = 0; k < n; ++k)
      for (int i = k + 1; i < n; ++i) x[i] -= lu_(i, k) * x[k];
    for (int k = n; k-- > 0;) {
      for (int j = k + 1; j < n; ++j) x[k] -= lu_(k, j) * x[j];
      x[k] /= lu_(k, k);
    }
    return x;
  }

 private:
  Matrix lu_;
  int row_[n];
  double determinant_ = 1;
};

// q = s · law(base + U q), U: what a unit of each friction does to the reactions.
struct SliderCrankStatics::Solution {
  using Influence = Eigen::Matrix<double, reactions, frictions>;
  Law::Loads q = Law::Loads::Zero();
  Law::Slopes law_slope = {};
  FrictionLu lu;  // of 1 − ∂law/∂q
  double residual = 0;
  int iterations = 0;

  // Newton's method at one share s from q on; false where it does not converge to the branch wanted.
  bool settle(const Law& law, double share, const Influence& influence, const Column& base);
};

}  // namespace kurbel
