// mean_system.h — the mean of the Jacobian over a cycle, and its modes.
//
//     Ā = (1/T) ∫ ∂f/∂y dt along the motion,   Ā r = λ r
// Approximation with constant coefficients of a machine with periodic coefficients: modes for comparison with the Floquet
// exponents. Jumps at events are not included.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "engine/run/run.h"

namespace kurbel {

struct MeanMode {
  std::complex<double> exponent;  // λ [1/s]
  Eigen::VectorXcd shape;         // of the state y, each in its own unit
};

// Observer of a run that averages its Jacobian.
class MeanJacobian final : public Observer {
 public:
  explicit MeanJacobian(Equations& equations);
  void step(StepView& view) override;
  Eigen::MatrixXd mean() const;

 private:
  SparsityPattern pattern_;
  std::size_t states_;
  std::vector<double> values_, sum_, y_;
  double time_ = 0;
};

// All modes of a matrix, for states with these scales.
std::vector<MeanMode> modes_of(const Eigen::MatrixXd& mean, const Eigen::VectorXd& scale);

// Shares of the modes in a motion: coefficients of the combination of modes nearest to it.
class ModeFilter {
 public:
  // Angles, which come first, are ignored; a mode that consists only of angles gets the coefficient zero.
  ModeFilter(const std::vector<MeanMode>& modes, const Eigen::VectorXd& scale, std::size_t angles);
  // Coefficients of a motion δy over the scales.
  Eigen::VectorXcd operator()(const Eigen::VectorXcd& scaled) const { return by_motion_ * scaled; }
  double length(const Eigen::VectorXcd& scaled) const;  // without angles

 private:
  Eigen::MatrixXcd by_motion_;
  Eigen::Index angles_;
};

}  // namespace kurbel
