// fixed_points.cpp — fixed points of the return map by Newton's method, and their Floquet multipliers.
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "engine/analysis/return_map.h"

namespace kurbel {

std::vector<std::complex<double>> multipliers_of(const Eigen::MatrixXd& derivative) {
  if (derivative.rows() == 0) return {};
  const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(derivative, false).eigenvalues();
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
    out.rounds = 1;
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
  const NewtonOutcome newton = solve(system, guess, enough);
  out.rounds = newton.rounds;
  out.derivatives = newton.derivatives;
  out.residual = newton.residual;
  out.cost = map.cost() - cost_before;
  out.end = image.end;
  if (newton.found) {
    out.take(newton.x, image);
  } else if (image.end != ReturnMap::End::returned) {
    out.why = image.why;
  } else {
    out.end = ReturnMap::End::failed;
    out.why =
        newton.why +
        ": there may be no steady cycle of this period near the guess. Try another start speed, --periods 2, or a "
        "long kurbel run";
  }
  return out;
}

void SteadyPoint::take(const Eigen::VectorXd& at, const ReturnMap::Image& image) {
  found = true;
  z = at;
  derivative = image.derivative;
  multipliers = multipliers_of(derivative);
  time = image.time;
  grazed = image.grazed;
}

}  // namespace kurbel
