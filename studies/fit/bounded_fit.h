// bounded_fit.h — least squares within bounds, and how well the data determine the unknowns.
//
//     min ½ |r(u)|²,  0 ≤ u ≤ 1      Levenberg–Marquardt; unknowns that press against a bound are held there
//                                    (Nocedal, Wright 2006, 10.3; Kelley 1999, 5.4)
//     Cov u = (Jᵀ J)⁻¹ s²            of residuals over their deviations; s² = |r|²/(m − p) where it exceeds 1
//
// Unknowns are scaled to their ranges, residuals to their deviations.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/matrices/linear_algebra.h"

namespace kurbel {

struct BoundedProblem {
  // r(u), 0 ≤ u ≤ 1; empty: it cannot be computed there.
  std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd& u)> residuals;
  // ∂r/∂u for known r; empty: it cannot be computed.
  std::function<std::optional<Eigen::MatrixXd>(const Eigen::VectorXd& u, const Eigen::VectorXd& r)> derivative;
};

struct BoundedFit {
  Eigen::VectorXd u, r;      // r empty: not even the start could be computed
  Eigen::MatrixXd jacobian;  // at u
  int steps = 0;
  bool converged = false;
  std::vector<int> on_bound;  // per unknown −1: at the lower bound, |r| falling beyond; +1: the upper; 0: within
  double cost() const { return r.squaredNorm(); }
};

// At most `most_steps`; converged if the next step would change |r|² by less than 1e-8 of it, or u by less than 1e-7.
BoundedFit fit_within_bounds(const BoundedProblem& problem, const Eigen::VectorXd& start, int most_steps = 40);

// A combination of unknowns that cannot be determined: the compared data do not change along it.
struct SharedDirection {
  std::vector<std::size_t> unknowns;  // largest components first
  std::vector<double> parts;          // components of the unit vector, for columns of equal length
  double singular_value = 0;          // of J with columns of equal length, over the largest
};

struct Determination {
  Eigen::MatrixXd covariance;                 // of u; rows of unknowns on bounds and without influence are zero
  std::vector<bool> known;                    // per unknown: within its bounds and in no undetermined direction
  std::vector<std::size_t> no_trace;          // unknowns without influence on the compared data
  std::vector<SharedDirection> undetermined;  // combinations that the data do not determine
  double correlation(std::size_t i, std::size_t k) const;  // 0 if one of them is not known
};

// `jacobian`: of residuals over their deviations. `floor`: smaller singular values of J with columns of equal length,
// relative to the largest, are noise (errors of the derivatives). `scores`: for correlated residuals, a row Jᵀ d for
// each observation of their scatter d: Cov = A Σ Jᵀd dᵀJ A, A = (Jᵀ J)⁻¹ (White 1980); none: Cov = A.
Determination determined_by(const Eigen::MatrixXd& jacobian, const std::vector<int>& on_bound, double floor,
                            const Eigen::MatrixXd& scores = {});

// The diagonal of J (Jᵀ J)⁻¹ Jᵀ: how much of an unknown each value determines. Unknowns on bounds are held.
Eigen::VectorXd leverage(const Eigen::MatrixXd& jacobian, const std::vector<int>& on_bound, double floor);

}  // namespace kurbel
