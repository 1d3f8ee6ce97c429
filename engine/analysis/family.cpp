// family.cpp — null vectors of a derivative, and the member of a family that a run comes to.
#include "engine/analysis/family.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/matrices/linear_algebra.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

// The section's state as a run from the scene's start with looser steps comes to it.
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
      "come "
      "round ({}){}",
      search.rounds, search.rounds == 1 ? "" : "s", why,
      search.residual > 0 ? fmt::format("; the one before left {:.1e} of the rated values", search.residual) : "");
}

// By inverse iteration, of a matrix that rounding keeps from being singular.
std::optional<Family> family_of(const Eigen::MatrixXd& derivative, double uncertain) {
  constexpr double shift = 1e-14, least_slope = 1e-3;
  constexpr int iterations = 3;
  const Eigen::Index n = derivative.rows();
  if (n == 0 || !derivative.allFinite()) return {};
  const Lu inverse(derivative + shift * Eigen::MatrixXd::Identity(n, n));
  Family family{Eigen::VectorXd::Ones(n).normalized(), Eigen::VectorXd::Ones(n).normalized()};
  for (int i = 0; i < iterations; ++i) {
    family.tangent = inverse.solve(family.tangent).normalized();
    family.quantity = inverse.solve_transposed(family.quantity).normalized();
  }
  if (!family.tangent.allFinite() || !family.quantity.allFinite()) return {};
  const double slope = family.quantity.dot(family.tangent);
  const double unknown = 10 * uncertain * std::sqrt(static_cast<double>(n));
  if ((derivative * family.tangent).norm() > unknown || std::abs(slope) < least_slope) return {};
  family.quantity /= slope;
  return family;
}

// To first order: a run that is nearer to the point says more.
bool is_member_of_run(const ReturnMap& map, SteadyPoint& point) {
  constexpr double same_member = 1e-10;  // of the rated values
  const Eigen::Index n = point.z.size();
  if (n == 0) return true;
  const std::optional<Family> family =
      family_of(point.derivative - Eigen::MatrixXd::Identity(n, n), point.multiplier_error);
  if (!family) return true;
  const double beside = std::abs(family->quantity.dot(point.z));
  point.to_come = family->tangent * (beside + std::abs(family->quantity.dot(loosely_reached(map))));
  return beside * family->tangent.cwiseAbs().maxCoeff() <= same_member;
}

}  // namespace kurbel
