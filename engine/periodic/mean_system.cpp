// mean_system.cpp — quadrature of the Jacobian over the steps of a run; eigenvectors and what they see of a motion.
#include "engine/periodic/mean_system.h"

#include "engine/base/gauss.h"
#include "engine/matrices/linear_algebra.h"

namespace kurbel {
namespace {

using Eigen::Index;

constexpr double only_angles = 1e-9;  // share of a mode that is not

}  // namespace

MeanJacobian::MeanJacobian(Equations& equations)
    : pattern_(equations.jacobian_pattern()),
      states_(equations.state_count()),
      values_(pattern_.row.size()),
      sum_(values_.size(), 0.0) {}

// Three nodes a step: steps are short beside all that varies.
void MeanJacobian::step(StepView& view) {
  const double from = view.t_previous(), length = view.t() - from;
  gauss<3>.over(from, length, [&](double t, double weight) {
    const std::span<const double> here = view.at(t).first(view.equations().size());
    y_.assign(here.begin(), here.end());
    view.equations().jacobian(t, y_, values_);
    for (std::size_t k = 0; k < sum_.size(); ++k) sum_[k] += weight * values_[k];
  });
  time_ += length;
}

Eigen::MatrixXd MeanJacobian::mean() const {
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(static_cast<Index>(states_), static_cast<Index>(states_));
  for (std::size_t c = 0; c < states_; ++c)
    for (auto k = static_cast<std::size_t>(pattern_.column_start[c]);
         k < static_cast<std::size_t>(pattern_.column_start[c + 1]); ++k)
      if (pattern_.row[k] < full.rows()) full(pattern_.row[k], static_cast<Index>(c)) = sum_[k] / time_;
  return full;
}

std::vector<MeanMode> modes_of(const Eigen::MatrixXd& mean, const Eigen::VectorXd& scale) {
  const Eigen::MatrixXd scaled = scale.cwiseInverse().asDiagonal() * mean * scale.asDiagonal();
  std::vector<MeanMode> modes;
  if (scaled.rows() == 0 || !scaled.allFinite()) return modes;
  const Eigenpairs found = eigenpairs(scaled);
  for (Index j = 0; j < scaled.rows(); ++j)
    modes.push_back({found.values[j], scale.asDiagonal() * found.vectors.col(j)});
  return modes;
}

ModeFilter::ModeFilter(const std::vector<MeanMode>& modes, const Eigen::VectorXd& scale, std::size_t angles)
    : angles_(static_cast<Index>(angles)) {
  Eigen::MatrixXcd shapes(scale.size(), static_cast<Index>(modes.size()));
  Eigen::VectorXd seen = Eigen::VectorXd::Ones(shapes.cols());
  for (Index j = 0; j < shapes.cols(); ++j) {
    const Eigen::VectorXcd shape = scale.cwiseInverse().asDiagonal() * modes[static_cast<std::size_t>(j)].shape;
    const double whole = shape.norm(), without_angles = length(shape);
    const bool nothing_else = without_angles <= only_angles * whole;
    if (nothing_else) seen[j] = 0;
    const double over = nothing_else ? whole : without_angles;
    shapes.col(j) = over > 0 ? Eigen::VectorXcd(shape / over) : shape;
  }
  by_motion_ = seen.asDiagonal() * pseudo_inverse(shapes);
}

double ModeFilter::length(const Eigen::VectorXcd& scaled) const { return scaled.tail(scaled.size() - angles_).norm(); }

}  // namespace kurbel
