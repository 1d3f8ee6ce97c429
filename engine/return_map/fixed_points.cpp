// fixed_points.cpp — fixed points of the return map by Newton's method, and their Floquet multipliers.
#include <algorithm>
#include <cmath>

#include "engine/matrices/linear_algebra.h"
#include "engine/return_map/family.h"
#include "engine/return_map/return_map.h"

namespace kurbel {

namespace {

constexpr double slowest_shrinking = 0.999;  // ratio from period to period; nearer to 1 it is not significant
constexpr double floor_of_change = 1e-10;    // of the rated values: smaller changes are noise
constexpr double same_motion = 1e-3;         // of the rated values, and of the time of a period
constexpr int periods_examined = 6;
constexpr double most_missed = 1e-8;    // of the usual speeds
constexpr double looser_residual = 10;  // at which a looser search ends, over its tolerance

// Sensitivity of the largest eigenvalue to an entry of the matrix.
double condition_of_largest(const Eigen::MatrixXd& derivative) {
  if (!derivative.allFinite()) return 1 / floor_of_change;
  const auto [values, vectors] = eigenpairs(derivative);
  Eigen::Index largest = 0;
  values.cwiseAbs().maxCoeff(&largest);
  const Eigen::VectorXcd left = ComplexLu(vectors).inverse().row(largest).transpose();
  const double condition = left.lpNorm<1>() * vectors.col(largest).lpNorm<1>();
  return std::isfinite(condition) ? condition : 1 / floor_of_change;
}

}  // namespace

std::vector<std::complex<double>> multipliers_of(const Eigen::MatrixXd& derivative) {
  if (derivative.rows() == 0) return {};
  const Eigen::VectorXcd values = eigenvalues(derivative);
  std::vector<std::complex<double>> sorted(values.begin(), values.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](auto a, auto b) {
    const double difference = std::abs(a) - std::abs(b);
    return std::abs(difference) > 1e-12 ? difference > 0 : a.imag() > b.imag();
  });
  return sorted;
}

SteadyPoint find_steady(ReturnMap& map, const Eigen::VectorXd& guess, double enough) {
  SteadyPoint out;
  ReturnMap::Image image;
  if (map.size() == 0) {  // time leaves nothing to find
    image = map.image(guess, false);
    out.end = image.end;
    out.why = image.why;
    out.periods = 1;
    out.cost = 1;
    if (image.end == ReturnMap::End::returned) out.take(guess, image);
    return out;
  }
  const double cost_before = map.cost();
  NewtonSystem system;
  system.evaluate = [&](const Eigen::VectorXd& z, Eigen::VectorXd& residual, Eigen::MatrixXd* derivative) {
    ReturnMap::Image here = map.image(z, derivative != nullptr);
    const bool returned = here.end == ReturnMap::End::returned;
    if (returned) {
      if (out.first.size() == 0) out.first = here.z;
      residual = here.z - z;
      if (derivative) *derivative = here.derivative - Eigen::MatrixXd::Identity(z.size(), z.size());
    }
    image = std::move(here);
    return returned;
  };
  system.stopped = [&] { return image.end == ReturnMap::End::interrupted; };
  system.derivative_cost = map.derivative_cost();
  system.magnitude = std::max(system.magnitude, map.section().magnitude());
  system.run_on = true;
  const NewtonOutcome newton = solve_in_family(system, guess, enough, [&] { return image.uncertain; });
  out.periods = newton.evaluations;
  out.derivatives = newton.derivatives;
  out.residual = newton.residual;
  out.cost = map.cost() - cost_before;
  out.end = image.end;
  if (newton.found) {
    out.take(newton.x, image);
    if (out.neutral() || !out.derivative.allFinite()) return out;
    // Where round-off ends the search; the residual alone is 1 − μ of it.
    const Eigen::VectorXd left =
        Lu(out.derivative - Eigen::MatrixXd::Identity(out.z.size(), out.z.size())).solve(out.z - image.z);
    if (left.allFinite() && left.cwiseAbs().maxCoeff() > enough) out.to_come = left;
  } else if (image.end != ReturnMap::End::returned) {
    out.why = trial_ended(newton, image.why);
  } else {
    out.end = ReturnMap::End::failed;
    out.why = newton.why +
              ": there may be no steady cycle of this period near the guess. Try another start speed, --periods 2, or "
              "a long kurbel run";
  }
  return out;
}

void SteadyPoint::find(const ReturnMap::Image& image) {
  found = image.missed <= most_missed;
  why = found ? "" : "what sticks at the beginning of the period slips at its end";
}

void SteadyPoint::take(const Eigen::VectorXd& at, const ReturnMap::Image& image) {
  find(image);
  z = at;
  derivative = image.derivative;
  multipliers = multipliers_of(derivative);
  if (derivative.size() > 0) multiplier_error = condition_of_largest(derivative) * image.uncertain;
  time = image.time, turned = image.turned;
  grazed = image.grazed;
}

// Iterates z, P(z), P(P(z)) … converge with the ratio q: the distance remaining after the last one is r q/(1 − q).
SteadyPoint find_by_periods(ReturnMap& map, const Eigen::VectorXd& guess, double enough) {
  SteadyPoint out;
  const double cost_before = map.cost();
  out.z = guess;
  std::vector<double> changes;
  Eigen::VectorXd change = Eigen::VectorXd::Zero(guess.size());
  ReturnMap::Image image;
  for (int i = 0; i < periods_examined; ++i) {
    image = map.image(out.z, false);
    ++out.periods;
    out.cost = map.cost() - cost_before;
    out.end = image.end;
    out.why = image.why;
    if (image.end != ReturnMap::End::returned) return out;
    const Eigen::VectorXd along = map.along_the_motion(out.z);
    change = image.z - out.z;
    if (along.squaredNorm() > 0) change -= along * along.dot(change) / along.squaredNorm();
    out.residual = change.size() > 0 ? change.cwiseAbs().maxCoeff() : 0;
    out.time = image.time, out.turned = image.turned;
    out.z = image.z;
    if (out.first.size() == 0) out.first = image.z;
    changes.push_back(out.residual);
    const bool begins_loose = i == 0;  // with the errors of the run that led here
    if ((out.residual > enough && !begins_loose) || out.residual <= floor_of_change) break;
  }
  if (out.residual > enough) {
    out.why = "cycles still change";
    return out;
  }
  double shrinking = 0;
  for (std::size_t i = 0; i + 1 < changes.size(); ++i) shrinking = std::max(shrinking, changes[i + 1] / changes[i]);
  shrinking = std::max(out.residual <= floor_of_change ? 0.5 : 0, std::min(shrinking, slowest_shrinking));
  out.to_come = change * shrinking / (1 - shrinking);
  out.find(image);
  return out;
}

std::shared_ptr<ReturnMap> looser_map(const ReturnMap& map, double tolerance, std::shared_ptr<const Model> model) {
  ReturnMapOptions options = map.options();
  options.tolerance = tolerance;
  auto loose = std::make_shared<ReturnMap>(model ? std::move(model) : map.shared_model(), options);
  loose->follow(map);
  return loose;
}

SteadyTwin looser_twin(const ReturnMap& map, const SteadyPoint& point, double tolerance,
                       std::shared_ptr<const Model> model) {
  SteadyTwin twin{looser_map(map, tolerance, std::move(model)), point};
  SteadyPoint& other = twin.point;
  const bool by_run = point.to_come.size() > 0 && point.derivative.size() == 0;
  if (by_run || point.grazed || point.neutral()) {
    if (point.to_come.size() > 0) other.z += point.to_come;
    return twin;
  }
  other = find_steady(*twin.map, point.z, looser_residual * tolerance);
  if (!other.found) return twin;
  // The search may end where it begins; the fixed point of the looser map is by the residual over 1 − μ away.
  if (other.derivative.size() > 0 && !other.neutral()) {
    const ReturnMap::Image image = twin.map->image(other.z, false);
    const Eigen::MatrixXd system = other.derivative - Eigen::MatrixXd::Identity(other.z.size(), other.z.size());
    if (image.end == ReturnMap::End::returned) other.z -= Lu(system).solve(image.z - other.z);
  }
  for (Eigen::Index i = 0; i < point.to_come.size(); ++i)  // counted beside the difference, which it must not cancel
    other.z[i] += std::copysign(point.to_come[i], other.z[i] - point.z[i]);
  const double apart = point.z.size() > 0 ? (other.z - point.z).cwiseAbs().maxCoeff() : 0;
  if (apart <= same_motion && std::abs(other.time - point.time) <= same_motion * point.time) return twin;
  other.found = false;
  other.why = "with looser tolerances the search comes to another motion";
  return twin;
}

}  // namespace kurbel
