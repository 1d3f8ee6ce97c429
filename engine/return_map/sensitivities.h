// sensitivities.h — derivatives of a run by its initial state: variational equations along the motion, jumps at events.
//
//     Ẏ = ∂f/∂y · Y                                              between events, with the exact sparse Jacobian
//     Y⁺ = Y⁻ + (f⁺ − f⁻) (∇g·Y⁻)/(∇g·f⁻ + ∂g/∂t)                where guard g falls through zero (saltation)
// Aizerman & Gantmacher 1958; Leine & Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems, 2004.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/run/run.h"

namespace kurbel {

class Sensitivities final : public RunExtension {
 public:
  // The equations must have no audit. columns: number of directions; `looser`: their tolerance over that of the motion; in
  // Newton's method their errors do not affect the result.
  Sensitivities(Equations& equations, std::size_t columns, double looser);

  // [ y | Y row by row ]; Y₀ = ∂y₀/∂z, states × columns.
  std::vector<double> start(std::span<const double> y, const Eigen::MatrixXd& first) const;
  Eigen::MatrixXd matrix(std::span<const double> extended) const;
  // A guard was touched tangentially: the derivative does not exist there.
  bool grazed() const { return grazed_; }

  std::size_t size() const override { return states_ * (1 + columns_); }
  void flow(double t, std::span<const double> y, std::span<double> ydot) override;
  // For implicit steps: the Jacobian of the motion repeated per direction; the terms of the directions by the curvature of
  // f are omitted, which costs an iteration of Newton's method but no accuracy.
  const SparsityPattern& jacobian_pattern() override;
  void jacobian(double t, std::span<const double> y, std::span<double> values) override;
  ErrorControl error_control(double tolerance) const override;
  void before_event(double t, std::span<const double> y, const std::vector<std::size_t>& fired) override;
  void after_event(double t, std::span<double> y) override;

 private:
  Equations& equations_;
  std::size_t states_, columns_;
  double looser_;
  std::vector<double> scale_, values_, flow_before_, flow_after_, gradient_;
  double guard_rate_ = 0;
  bool grazed_ = false;
  SparsityPattern pattern_;
};

}  // namespace kurbel
