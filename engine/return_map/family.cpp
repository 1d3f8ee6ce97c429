// family.cpp — null vectors of a derivative, and the member of a family reached by a run.
#include "engine/return_map/family.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/matrices/linear_algebra.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

// The section's state reached by a run from the scene's start with looser steps.
Eigen::VectorXd loosely_reached(const ReturnMap& map) {
  constexpr double looser = 100;
  const State& there = map.section().state();
  const std::size_t link = at(map.model().reduction_angle);
  const bool by_time = map.periodicity().by_time;
  Equations equations(map.shared_model(), false);
  RunOptions run{.tolerance = looser * std::max(map.options().tolerance, 1e-9),
                 .method = map.options().method,
                 .until = by_time ? there.t : 1.5 * there.t + map.time_limit(),
                 .budget = map.options().budget,
                 .interrupted = map.options().interrupted,
                 .progress = {}};
  run.from = {0, equations.start(0)};
  const double target = angle_with_turns(there.modes, link, there.y);
  const double sense = target < equations.angle_with_turns(link, run.from->y) ? -1 : 1;
  if (!by_time)
    run.stop = [&](double, std::span<const double> y) {
      return std::min(1.0, sense * (target - equations.angle_with_turns(link, y)));
    };
  const RunOutcome outcome = integrate(equations, run, {});
  if (!outcome.complete || !(outcome.stopped || by_time))
    return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(map.size()));
  return map.section().read(equations.modes(), outcome.state);
}

// Orthonormal columns that A takes to less than `unknown`, the least of them last. Of a space that inverse iteration spans.
Eigen::MatrixXd null_vectors(const Eigen::MatrixXd& a, double unknown) {
  constexpr double shift = 1e-14;
  constexpr int iterations = 3;
  constexpr Eigen::Index most = 8;
  const Eigen::Index n = a.rows();
  const Lu inverse(a + shift * Eigen::MatrixXd::Identity(n, n));
  Eigen::MatrixXd space = Eigen::MatrixXd::NullaryExpr(n, std::min(n, most), [](Eigen::Index i, Eigen::Index j) {
    return std::cos(static_cast<double>(i * (j + 1) + j));
  });
  for (int i = 0; i < iterations && space.allFinite(); ++i) {
    space = inverse.solve_all(space);
    if (space.allFinite()) space = orthonormalised(space);
  }
  if (!space.allFinite()) return Eigen::MatrixXd(n, 0);
  const Svd images = thin_svd(product(a, space));
  return product(space, images.v.rightCols((images.values.array() <= unknown).count()));
}

}  // namespace

Eigen::VectorXd uncertainty_of_member(ReturnMap& map) {
  Eigen::VectorXd apart = loosely_reached(map);
  const Eigen::VectorXd along = map.along_the_motion(Eigen::VectorXd::Zero(apart.size()));
  if (along.squaredNorm() > 0) apart -= along * along.dot(apart) / along.squaredNorm();
  return apart;
}

std::string trial_ended(const NewtonOutcome& search, const std::string& why) {
  return fmt::format(
      "the search failed, which does not say that there is none: of {} trial{} of Newton's method the last did not "
      "complete a cycle ({}){}",
      search.evaluations, search.evaluations == 1 ? "" : "s", why,
      search.residual > 0 ? fmt::format("; the one before left {:.1e} of the rated values", search.residual) : "");
}

// By inverse iteration with a matrix that is regular by rounding only.
std::optional<Family> family_of(const Eigen::MatrixXd& derivative, double uncertain) {
  constexpr double least_slope = 1e-3;
  const Eigen::Index n = derivative.rows();
  if (n == 0 || !derivative.allFinite()) return {};
  const double unknown = 10 * uncertain * std::sqrt(static_cast<double>(n));
  const Eigen::MatrixXd tangents = null_vectors(derivative, unknown),
                        quantities = null_vectors(derivative.transpose(), unknown);
  const Eigen::Index directions = std::min(tangents.cols(), quantities.cols());
  if (directions == 0) return {};
  const Svd slopes = thin_svd(transposed_product(quantities.rightCols(directions), tangents.rightCols(directions)));
  const auto resolved = static_cast<Eigen::Index>((slopes.values.array() >= least_slope).count());
  if (resolved == 0) return {};
  return Family{product(tangents.rightCols(directions), slopes.v.leftCols(resolved)),
                product(quantities.rightCols(directions), slopes.u.leftCols(resolved)) *
                    slopes.values.head(resolved).cwiseInverse().asDiagonal()};
}

Family Family::kept(const Eigen::VectorXd& residual, double unchanged) const {
  const Eigen::MatrixXd change = quantity.transpose() * residual;
  if (change.norm() <= unchanged) return *this;
  const Eigen::MatrixXd others = full_basis(change).rightCols(change.rows() - 1);
  return {product(tangent, others), product(quantity, others)};
}

// To first order: more accurate for a run nearer to the point.
bool is_member_of_run(const ReturnMap& map, SteadyPoint& point) {
  constexpr double same_member = 1e-10;  // of the rated values
  const Eigen::Index n = point.z.size();
  if (n == 0) return true;
  const std::optional<Family> family =
      family_of(point.derivative - Eigen::MatrixXd::Identity(n, n), point.multiplier_error);
  if (!family) return true;
  const auto along = [&](const Eigen::VectorXd& z) -> Eigen::VectorXd {
    return family->tangent * (family->quantity.transpose() * z);
  };
  const Eigen::VectorXd beside = along(point.z), loosely = along(loosely_reached(map));
  point.to_come = beside.cwiseAbs() + loosely.cwiseAbs();
  for (Eigen::Index i = 0; i < n; ++i)
    if (loosely[i] < 0) point.to_come[i] = -point.to_come[i];
  return beside.cwiseAbs().maxCoeff() <= same_member;
}

}  // namespace kurbel
