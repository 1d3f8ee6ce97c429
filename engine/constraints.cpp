// constraints.cpp — accelerations and transmitted torques of shafts that move together.
#include "engine/constraints.h"

#include <algorithm>
#include <cmath>

namespace kurbel {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }
Eigen::Index ix(std::size_t index) { return static_cast<Eigen::Index>(index); }

constexpr double dependent = 1e-10;  // rows nearer to each other than this, in direction, say the same

}  // namespace

void Constraints::set(std::vector<ConstraintRow> rows) {
  rows_ = std::move(rows);
  factorised_for_.clear();
}

void Constraints::factorise(std::span<const double> inertia, bool symmetric) {
  const std::size_t m = rows_.size();
  bool same = !factorised_for_.empty() && !symmetric;
  for (std::size_t k = 0, place = 0; same && k < m; ++k)
    for (const ShaftGain& g : rows_[k].motion) same = factorised_for_[place++] == inertia[at(g.shaft)];
  if (same) return;
  factorised_for_.clear();
  for (const ConstraintRow& row : rows_)
    for (const ShaftGain& g : row.motion) factorised_for_.push_back(inertia[at(g.shaft)]);
  schur_.setZero(ix(m), ix(m));
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < m; ++j)
      for (const ShaftGain& g : rows_[i].motion) {
        if (at(g.shaft) >= free_) continue;
        for (const ShaftGain& t : symmetric ? rows_[j].motion : rows_[j].torque)
          if (t.shaft == g.shaft) schur_(ix(i), ix(j)) += (symmetric ? -1 : 1) * g.gain * t.gain / inertia[at(g.shaft)];
      }
  if (symmetric) factorised_for_.clear();
  // Rows and columns of like size, so that a rank can be told.
  root_capacity_.resize(ix(m));
  for (std::size_t k = 0; k < m; ++k) root_capacity_[ix(k)] = std::sqrt(rows_[k].capacity);
  const auto inverse = [](const Eigen::VectorXd& norm) {
    return Eigen::VectorXd(norm.unaryExpr([](double x) { return x > 0 ? 1 / x : 1.0; }));
  };
  const Eigen::VectorXd of_row = inverse(schur_.rowwise().norm());
  const Eigen::MatrixXd rows_scaled = of_row.asDiagonal() * schur_;
  const Eigen::MatrixXd scaled = rows_scaled * inverse(rows_scaled.colwise().norm().transpose()).asDiagonal();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> rank;
  rank.setThreshold(dependent);
  rank.compute(scaled);
  singular_ = rank.rank() < ix(m);
  if (!singular_) {
    regular_.compute(schur_);
    return;
  }
  least_.setThreshold(dependent);
  least_.compute(rows_scaled * root_capacity_.asDiagonal());
  right_ = of_row;
}

Eigen::VectorXd Constraints::multipliers(const Eigen::VectorXd& right) const {
  if (!singular_) return regular_.solve(right);
  return root_capacity_.asDiagonal() * least_.solve(Eigen::VectorXd(right_.asDiagonal() * right));
}

// One row alone, the usual case of a gear with losses, needs no matrix. False where it has no diagonal.
bool Constraints::solve_one(std::span<const double> inertia, std::span<double> alpha, double& multiplier) const {
  const ConstraintRow& row = rows_.front();
  double diagonal = 0;
  for (const ShaftGain& g : row.motion)
    if (at(g.shaft) < free_)
      for (const ShaftGain& t : row.torque)
        if (t.shaft == g.shaft) diagonal += g.gain * t.gain / inertia[at(g.shaft)];
  if (diagonal == 0) return false;
  multiplier = 0;
  for (int pass = 0; pass < 2; ++pass) {  // twice: see below
    double sum = 0;
    for (const ShaftGain& g : row.motion) sum += g.gain * alpha[at(g.shaft)];
    const double lambda = -sum / diagonal;
    multiplier += lambda;
    for (const ShaftGain& t : row.torque)
      if (at(t.shaft) < free_) alpha[at(t.shaft)] += t.gain * lambda / inertia[at(t.shaft)];
  }
  return true;
}

void Constraints::solve(std::span<const double> inertia, std::span<const double> torque, std::span<double> alpha,
                        std::span<double> multiplier) {
  for (std::size_t s = 0; s < free_; ++s) alpha[s] = torque[s] / inertia[s];
  if (rows_.empty()) return;
  if (rows_.size() == 1 && solve_one(inertia, alpha, multiplier[0])) return;
  factorise(inertia);
  std::fill_n(multiplier.begin(), rows_.size(), 0.0);
  right_side_.resize(ix(rows_.size()));
  // Twice: a light shaft's acceleration is the difference of two large ones, and what round-off leaves of it would
  // make noise that small steps cannot get under. The second pass takes the residue out.
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      double sum = 0;
      for (const ShaftGain& g : rows_[k].motion) sum += g.gain * alpha[at(g.shaft)];
      right_side_[ix(k)] = -sum;
    }
    const Eigen::VectorXd lambda = multipliers(right_side_);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      multiplier[k] += lambda[ix(k)];
      for (const ShaftGain& t : rows_[k].torque)
        if (at(t.shaft) < free_) alpha[at(t.shaft)] += t.gain * lambda[ix(k)] / inertia[at(t.shaft)];
    }
  }
}

void Constraints::project(std::span<const double> inertia, std::span<double> speed) {
  if (rows_.empty()) return;
  factorise(inertia, true);
  Eigen::VectorXd right(ix(rows_.size()));
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    double sum = 0;
    for (const ShaftGain& g : rows_[k].motion) sum += g.gain * speed[at(g.shaft)];
    right[ix(k)] = -sum;
  }
  const Eigen::VectorXd impulse = multipliers(right);
  factorised_for_.clear();
  for (std::size_t k = 0; k < rows_.size(); ++k)
    for (const ShaftGain& g : rows_[k].motion)
      if (at(g.shaft) < free_) speed[at(g.shaft)] -= g.gain * impulse[ix(k)] / inertia[at(g.shaft)];
}

Eigen::MatrixXd Constraints::mobility(std::span<const double> inertia, std::span<const int> shafts) {
  const std::size_t n = shafts.size(), m = rows_.size();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(ix(n), ix(n));
  for (std::size_t i = 0; i < n; ++i) result(ix(i), ix(i)) = 1 / inertia[at(shafts[i])];
  if (m == 0) return result;
  factorise(inertia);
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(ix(m), ix(n)), t = Eigen::MatrixXd::Zero(ix(n), ix(m));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < m; ++k) {
      for (const ShaftGain& entry : rows_[k].motion)
        if (entry.shaft == shafts[i]) g(ix(k), ix(i)) += entry.gain / inertia[at(shafts[i])];
      for (const ShaftGain& entry : rows_[k].torque)
        if (entry.shaft == shafts[i]) t(ix(i), ix(k)) += entry.gain / inertia[at(shafts[i])];
    }
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::VectorXd lambda = multipliers(-g.col(ix(i)));
    result.col(ix(i)) += t * lambda;
  }
  return result;
}

}  // namespace kurbel
