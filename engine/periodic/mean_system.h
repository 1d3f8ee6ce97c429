// mean_system.h — the mean of the Jacobian over a cycle, and its modes.
//
//     Ā = (1/T) ∫ ∂f/∂y dt along the motion,   Ā r = λ r
// What linear theory with constant coefficients says of a machine whose coefficients vary round by round: modes to compare
// the exponents of the periodic system with. Jumps at events are no part of it.
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

// Sees a run and takes the mean of its Jacobian.
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

// All modes of a matrix, of states with these scales.
std::vector<MeanMode> modes_of(const Eigen::MatrixXd& mean, const Eigen::VectorXd& scale);

// How much of each mode a motion has: coefficients of the modes whose sum is nearest to it.
class ModeFilter {
 public:
  // Angles, which come first, tell no mode from another: a mode that is nothing but angles is one that no motion has.
  ModeFilter(const std::vector<MeanMode>& modes, const Eigen::VectorXd& scale, std::size_t angles);
  // Of a motion δy over the scales.
  Eigen::VectorXcd operator()(const Eigen::VectorXcd& scaled) const { return by_motion_ * scaled; }
  double length(const Eigen::VectorXcd& scaled) const;  // without angles

 private:
  Eigen::MatrixXcd by_motion_;
  Eigen::Index angles_;
};

}  // namespace kurbel
