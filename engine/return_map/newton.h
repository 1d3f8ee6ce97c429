// newton.h — Newton's method with damping, for systems whose derivative costs many times what the residual costs.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

namespace kurbel {

// r(x) = 0 for as many unknowns as residuals, all of order one.
struct NewtonSystem {
  // Residual, and its derivative where asked for; false where there is none.
  std::function<bool(const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* derivative)> evaluate;
  std::function<bool()> stopped = {};  // by the user
  double derivative_cost = 1;          // in evaluations without
  double magnitude = 0.2;              // of what x deviates from: steps are at most half of that and of x
  bool run_on = false;                 // x + r(x) is a sensible step where Newton has none: for maps
};
struct NewtonOutcome {
  bool found = false;
  std::string why;
  Eigen::VectorXd x;  // the last evaluation was at x and with derivative
  double residual = 0;
  int rounds = 0, derivatives = 0;
};
// Newton with damping, derivatives kept while they serve.
NewtonOutcome solve(const NewtonSystem& system, const Eigen::VectorXd& guess, double enough);

}  // namespace kurbel
