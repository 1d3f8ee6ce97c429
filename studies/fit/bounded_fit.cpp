// bounded_fit.cpp — damped steps on the unknowns that are free; singular values.
#include "studies/fit/bounded_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace kurbel {
namespace {

constexpr double least_change = 1e-8, least_step_of_range = 1e-7, within_errors = 1e-4;

// −1, +1: u stands on that bound, and the sum of squares would fall beyond it.
std::vector<int> bounds_pressed(const Eigen::VectorXd& u, const Eigen::VectorXd& gradient) {
  std::vector<int> pressed;
  for (Eigen::Index k = 0; k < u.size(); ++k)
    pressed.push_back(u[k] <= 0 && gradient[k] > 0 ? -1 : u[k] >= 1 && gradient[k] < 0 ? 1 : 0);
  return pressed;
}

Eigen::MatrixXd columns_of(const Eigen::MatrixXd& m, const std::vector<Eigen::Index>& which) {
  Eigen::MatrixXd part(m.rows(), static_cast<Eigen::Index>(which.size()));
  for (std::size_t k = 0; k < which.size(); ++k) part.col(static_cast<Eigen::Index>(k)) = m.col(which[k]);
  return part;
}

// min |J s + r|² + λ |D s|², D the lengths of the columns.
Eigen::VectorXd damped_step(const Eigen::MatrixXd& j, const Eigen::VectorXd& r, double lambda) {
  const Eigen::Index m = j.rows(), p = j.cols();
  Eigen::VectorXd scale = j.colwise().norm();
  const double largest = scale.size() ? scale.maxCoeff() : 0;
  for (Eigen::Index k = 0; k < p; ++k) scale[k] = std::max(scale[k], 1e-12 * std::max(largest, 1e-300));
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(m + p, p);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(m + p);
  for (Eigen::Index k = 0; k < p; ++k) a.col(k).head(m) = j.col(k) / scale[k], a(m + k, k) = std::sqrt(lambda);
  b.head(m) = -r;
  const Eigen::VectorXd s = least_squares(a, b);
  return s.cwiseQuotient(scale);
}

}  // namespace

BoundedFit fit_within_bounds(const BoundedProblem& problem, const Eigen::VectorXd& start, int most_steps) {
  BoundedFit fit{.u = start.cwiseMax(0).cwiseMin(1), .r = {}, .jacobian = {}, .on_bound = {}};
  const auto first = problem.residuals(fit.u);
  if (!first) return fit;
  fit.r = *first;
  double lambda = 1e-3;
  for (;;) {
    const auto derivative = problem.derivative(fit.u, fit.r);
    if (!derivative) return fit;
    fit.jacobian = *derivative;
    fit.on_bound = bounds_pressed(fit.u, fit.jacobian.transpose() * fit.r);
    Eigen::MatrixXd j = fit.jacobian;  // of what is held: 0, and so is its step
    for (Eigen::Index k = 0; k < j.cols(); ++k)
      if (fit.on_bound[static_cast<std::size_t>(k)] != 0) j.col(k).setZero();
    const bool all_held = j.isZero(0);
    if (all_held || fit.steps >= most_steps) {
      fit.converged = all_held;
      return fit;
    }
    bool accepted = false;
    double hoped = 0;
    for (int tries = 0; tries < 16 && !accepted; ++tries, lambda *= 4) {
      const Eigen::VectorXd full = damped_step(j, fit.r, lambda);
      const Eigen::VectorXd u = (fit.u + full).cwiseMax(0).cwiseMin(1);
      const Eigen::VectorXd moved = u - fit.u;
      const double expected = fit.cost() - (fit.r + fit.jacobian * moved).squaredNorm();
      hoped = expected;
      // Cut off at bounds a long step may lead upwards: a shorter one is tried.
      const bool cut_off = (moved - full).cwiseAbs().maxCoeff() > least_step_of_range;
      if (cut_off && expected <= 0) continue;
      if (moved.cwiseAbs().maxCoeff() < least_step_of_range || expected < least_change * fit.cost()) {
        fit.converged = true;
        return fit;
      }
      const auto r = problem.residuals(u);
      if (!r || !(r->squaredNorm() < fit.cost())) continue;
      const double gain = (fit.cost() - r->squaredNorm()) / expected;
      fit.u = u, fit.r = *r, accepted = true;
      lambda *= gain > 0.75 ? 1.0 / 40 : gain > 0.25 ? 0.25 : 1;  // the loop multiplies by four
    }
    if (!accepted) {  // as near as the errors of what is computed let it come
      fit.converged = hoped < within_errors * fit.cost();
      return fit;
    }
    lambda = std::clamp(lambda, 1e-12, 1e6);
    ++fit.steps;
  }
}

double Determination::correlation(std::size_t i, std::size_t k) const {
  const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(k);
  const double both = covariance(a, a) * covariance(b, b);
  return known[i] && known[k] && both > 0 ? covariance(a, b) / std::sqrt(both) : 0;
}

namespace {

// Right singular vectors of the columns `of` in equal length, by falling singular value.
struct Directions {
  Eigen::VectorXd scale, value;
  Eigen::MatrixXd v;
  bool determined(Eigen::Index k, double floor) const { return value[k] > floor * value[0]; }
};
Directions directions_of(const Eigen::MatrixXd& jacobian, const std::vector<Eigen::Index>& of) {
  Eigen::MatrixXd j = columns_of(jacobian, of);
  Directions found{.scale = j.colwise().norm(), .value = Eigen::VectorXd::Zero(j.cols()), .v = {}};
  for (Eigen::Index k = 0; k < j.cols(); ++k) j.col(k) /= found.scale[k];
  const Svd svd = full_v_svd(j);
  found.value.head(svd.values.size()) = svd.values;
  found.v = svd.v;
  return found;
}

}  // namespace

Determination determined_by(const Eigen::MatrixXd& jacobian, const std::vector<int>& on_bound, double floor,
                            const Eigen::MatrixXd& scores) {
  const Eigen::Index p = jacobian.cols();
  Determination found{.covariance = Eigen::MatrixXd::Zero(p, p),
                      .known = std::vector<bool>(static_cast<std::size_t>(p), false),
                      .no_trace = {},
                      .undetermined = {}};
  const Eigen::VectorXd length = jacobian.colwise().norm();
  const double longest = p > 0 ? length.maxCoeff() : 0;
  constexpr double nothing = 1e-9;  // of the longest column
  std::vector<Eigen::Index> seen, free;
  for (Eigen::Index k = 0; k < p; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (!(length[k] > nothing * longest)) {
      found.no_trace.push_back(i);
      continue;
    }
    seen.push_back(k);
    found.known[i] = on_bound[i] == 0;
    if (found.known[i]) free.push_back(k);
  }
  if (free.empty()) return found;
  // A bound does not determine an unknown that another one on the bound can replace.
  const Directions all = directions_of(jacobian, seen);
  for (Eigen::Index k = 0; k < all.v.cols(); ++k) {
    if (all.determined(k, floor)) continue;
    const Eigen::VectorXd v = all.v.col(k);
    SharedDirection direction{.unknowns = {}, .parts = {}, .singular_value = all.value[k] / all.value[0]};
    std::vector<Eigen::Index> order(seen.size());
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    // The strongest first; equal ones in the order in which they were requested.
    constexpr double equal = 1e-3;
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
      return std::round(std::abs(v[a]) / equal) > std::round(std::abs(v[b]) / equal);
    });
    constexpr double worth_naming = 0.05;
    for (const Eigen::Index i : order) {
      if (std::abs(v[i]) < worth_naming) break;
      direction.unknowns.push_back(static_cast<std::size_t>(seen[static_cast<std::size_t>(i)]));
      direction.parts.push_back(v[i]);
    }
    const bool all_on_bounds = std::all_of(direction.unknowns.begin(), direction.unknowns.end(),
                                           [&](std::size_t i) { return on_bound[i] != 0; });
    for (const std::size_t i : direction.unknowns) found.known[i] = false;
    if (!all_on_bounds) found.undetermined.push_back(std::move(direction));
  }
  const Directions within = directions_of(jacobian, free);
  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(count, count);  // of Jᵀ J, of what is determined
  for (Eigen::Index k = 0; k < count; ++k)
    if (within.determined(k, floor))
      inverse += within.v.col(k) * within.v.col(k).transpose() / (within.value[k] * within.value[k]);
  if (scores.rows() > 0) {
    Eigen::MatrixXd g = columns_of(scores, free);
    for (Eigen::Index k = 0; k < count; ++k) g.col(k) /= within.scale[k];
    inverse = (inverse * (g.transpose() * g) * inverse).eval();
  }
  for (Eigen::Index a = 0; a < count; ++a)
    for (Eigen::Index b = 0; b < count; ++b)
      found.covariance(free[static_cast<std::size_t>(a)], free[static_cast<std::size_t>(b)]) =
          inverse(a, b) / (within.scale[a] * within.scale[b]);
  return found;
}

Eigen::VectorXd leverage(const Eigen::MatrixXd& jacobian, const std::vector<int>& on_bound, double floor) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < jacobian.cols(); ++k)
    if (on_bound[static_cast<std::size_t>(k)] == 0 && !jacobian.col(k).isZero(0)) free.push_back(k);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(jacobian.rows());
  if (free.empty()) return sum;
  const Directions within = directions_of(jacobian, free);
  for (Eigen::Index k = 0; k < within.v.cols(); ++k)
    if (within.determined(k, floor))
      sum += (columns_of(jacobian, free) * within.v.col(k).cwiseQuotient(within.scale) / within.value[k]).cwiseAbs2();
  return sum;
}

}  // namespace kurbel
