// sensitivities.cpp — the variational equations as an extension of a run.
#include "engine/return_map/sensitivities.h"

#include <algorithm>
#include <cmath>

namespace kurbel {
namespace {

constexpr double guard_step = 1e-6;  // over the scale of a state, for guards

}  // namespace

Sensitivities::Sensitivities(Equations& equations, std::size_t columns, double looser)
    : equations_(equations), states_(equations.size()), columns_(columns), looser_(looser) {
  scale_ = equations.error_control(1).scale;
  values_.resize(equations.jacobian_pattern().row.size());
  flow_before_.resize(states_);
  flow_after_.resize(states_);
  gradient_.resize(states_);
}

std::vector<double> Sensitivities::start(std::span<const double> y, const Eigen::MatrixXd& first) const {
  std::vector<double> extended(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(states_));
  for (Eigen::Index i = 0; i < first.rows(); ++i)
    for (Eigen::Index j = 0; j < first.cols(); ++j) extended.push_back(first(i, j));
  return extended;
}

Eigen::MatrixXd Sensitivities::matrix(std::span<const double> extended) const {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(extended.data() + states_, static_cast<Eigen::Index>(states_),
                                    static_cast<Eigen::Index>(columns_));
}

void Sensitivities::flow(double t, std::span<const double> y, std::span<double> ydot) {
  equations_.flow(t, y.first(states_), ydot.first(states_));
  equations_.jacobian(t, y.first(states_), values_);
  const SparsityPattern& p = equations_.jacobian_pattern();
  const double* const from = y.data() + states_;
  double* const to = ydot.data() + states_;
  std::fill(to, to + states_ * columns_, 0.0);
  for (std::size_t c = 0; c < states_; ++c)
    for (auto k = static_cast<std::size_t>(p.column_start[c]); k < static_cast<std::size_t>(p.column_start[c + 1]);
         ++k) {
      const double value = values_[k];
      if (value == 0) continue;
      const double* const source = from + c * columns_;
      double* const target = to + static_cast<std::size_t>(p.row[k]) * columns_;
      for (std::size_t j = 0; j < columns_; ++j) target[j] += value * source[j];
    }
}

const SparsityPattern& Sensitivities::jacobian_pattern() {
  if (pattern_.size == size()) return pattern_;
  const SparsityPattern& p = equations_.jacobian_pattern();
  pattern_ = p;
  pattern_.size = size();
  for (std::size_t c = 0; c < states_; ++c)
    for (std::size_t j = 0; j < columns_; ++j) {
      for (auto k = static_cast<std::size_t>(p.column_start[c]); k < static_cast<std::size_t>(p.column_start[c + 1]);
           ++k)
        pattern_.row.push_back(static_cast<std::int64_t>(states_ + static_cast<std::size_t>(p.row[k]) * columns_ + j));
      pattern_.column_start.push_back(static_cast<std::int64_t>(pattern_.row.size()));
    }
  return pattern_;
}

void Sensitivities::jacobian(double t, std::span<const double> y, std::span<double> values) {
  const SparsityPattern& p = equations_.jacobian_pattern();
  equations_.jacobian(t, y.first(states_), values_);
  std::size_t next = values_.size();
  std::copy(values_.begin(), values_.end(), values.begin());
  for (std::size_t c = 0; c < states_; ++c)
    for (std::size_t j = 0; j < columns_; ++j)
      for (auto k = static_cast<std::size_t>(p.column_start[c]); k < static_cast<std::size_t>(p.column_start[c + 1]);
           ++k)
        values[next++] = values_[k];
}

ErrorControl Sensitivities::error_control(double tolerance) const {
  ErrorControl control{tolerance, scale_};
  for (std::size_t i = 0; i < states_; ++i) control.scale.insert(control.scale.end(), columns_, looser_ * scale_[i]);
  return control;
}

// The guard's gradient by central differences: guards are smooth up to their zero and cost little.
void Sensitivities::before_event(double t, std::span<const double> y, const std::vector<std::size_t>& fired) {
  equations_.flow(t, y.first(states_), flow_before_);
  std::vector<double> moved(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(states_)),
      above(equations_.guard_count()), below(above.size());
  const std::size_t guard = fired.front();
  double rate = 0;
  for (std::size_t i = 0; i < states_; ++i) {
    const double step = guard_step * scale_[i], here = moved[i];
    moved[i] = here + step;
    equations_.guards(t, moved, above);
    moved[i] = here - step;
    equations_.guards(t, moved, below);
    moved[i] = here;
    gradient_[i] = (above[guard] - below[guard]) / (2 * step);
    rate += gradient_[i] * flow_before_[i];
  }
  const double fastest = *std::max_element(scale_.begin(), scale_.end());
  const double dt = guard_step / std::max(fastest, 1.0);
  equations_.guards(t + dt, moved, above);
  equations_.guards(t - dt, moved, below);
  guard_rate_ = rate + (above[guard] - below[guard]) / (2 * dt);
}

void Sensitivities::after_event(double t, std::span<double> y) {
  equations_.flow(t, y.first(states_), flow_after_);
  double jump = 0, rate = 0;
  for (std::size_t i = 0; i < states_; ++i) {
    if (scale_[i] == 0) continue;
    jump = std::max(jump, std::abs(flow_after_[i] - flow_before_[i]) / scale_[i]);
    rate = std::max(rate, std::abs(flow_before_[i]) / scale_[i]);
  }
  if (jump <= 1e-10 * rate) return;  // a knot of a continuous law
  if (std::abs(guard_rate_) < 1e-6) {
    grazed_ = true;
    return;
  }
  double* const directions = y.data() + states_;
  for (std::size_t j = 0; j < columns_; ++j) {
    double moved = 0;
    for (std::size_t i = 0; i < states_; ++i) moved += gradient_[i] * directions[i * columns_ + j];
    const double later = moved / guard_rate_;
    for (std::size_t i = 0; i < states_; ++i)
      directions[i * columns_ + j] += (flow_after_[i] - flow_before_[i]) * later;
  }
}

}  // namespace kurbel
