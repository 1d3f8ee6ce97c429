// newton.h — damped Newton method for systems whose derivative is much more expensive than the residual.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

namespace kurbel {

// r(x) = 0 with as many unknowns as residuals, all of order one.
struct NewtonSystem {
  // Residual, and its derivative if requested; false if there is none.
  std::function<bool(const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* derivative)> evaluate;
  std::function<bool()> stopped = {};  // by the user
  double derivative_cost = 1;          // in evaluations without derivative
  double magnitude = 0.2;              // of the state from which x deviates: steps are at most half of it and of x
  bool run_on = false;                 // for maps: x + r(x) is a useful step if Newton's method has none
};
struct NewtonOutcome {
  bool found = false;
  std::string why;
  Eigen::VectorXd x;  // the last evaluation was at x with derivative
  double residual = 0;
  int evaluations = 0, derivatives = 0;
};
// Damped Newton method; derivatives are reused as long as they are good enough.
NewtonOutcome solve(const NewtonSystem& system, const Eigen::VectorXd& guess, double enough);

}  // namespace kurbel
