// constraint_system.cpp — accelerations and transmitted torques of shafts that move together.
#include "engine/equations/constraint_system.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/numerics/index.h"

namespace kurbel {
namespace {

Eigen::Index ix(std::size_t index) { return static_cast<Eigen::Index>(index); }

constexpr int binades = 8, most_magnitude = 60;  // inertias within 2⁸ of each other count as of one size
constexpr double none = 1e-13;                   // of the largest entry of I_f^-½ (Yᵀ I Z) I_i^-½: no determinant
constexpr double plainly = 1e-10;                // a residue below this part of its terms needs no further look
constexpr double is_lost = 1e-7;                 // above this part of all that went into its terms it is no round-off

int magnitude_of(double inertia) {
  if (inertia == 0) return -most_magnitude;
  const int exponent = std::isfinite(inertia) ? std::ilogb(inertia) : binades * most_magnitude;  // of a lost trial
  return std::clamp(exponent >= 0 ? exponent / binades : -((binades - 1 - exponent) / binades), -most_magnitude,
                    most_magnitude);
}
double root_inverse(int magnitude) { return std::ldexp(1.0, -binades / 2 * magnitude); }

std::vector<std::size_t> others(std::size_t count, const std::vector<std::size_t>& taken) {
  std::vector<std::size_t> rest;
  for (std::size_t k = 0; k < count; ++k)
    if (std::find(taken.begin(), taken.end(), k) == taken.end()) rest.push_back(k);
  return rest;
}

}  // namespace

void Constraints::System::set(const std::vector<ConstraintRow>& rows) {
  if (rows == rows_) return;
  rows_ = rows;
  capacity_.clear();
  for (const ConstraintRow& row : rows) capacity_.push_back(row.capacity);
  list_shafts();
}

void Constraints::System::share_by(const std::vector<double>& capacity) {
  if (capacity == capacity_) return;
  capacity_ = capacity;
  if (!repeating_.empty() && !magnitude_.empty()) share();
}

void Constraints::System::list_shafts() {
  int count = static_cast<int>(free_);
  for (const ConstraintRow& row : rows_)
    for (const auto* side : {&row.motion, &row.torque})
      for (const ShaftGain& g : *side) count = std::max(count, g.shaft + 1);
  place_.assign(at(count), -1);
  tied_.clear(), given_.clear(), loose_.clear();
  for (const ConstraintRow& row : rows_)
    for (const auto* side : {&row.motion, &row.torque})
      for (const ShaftGain& g : *side) place_[at(g.shaft)] = 0;
  for (int s = 0; s < count; ++s) {
    auto& list = at(s) >= free_ ? given_ : place_[at(s)] < 0 ? loose_ : tied_;
    if (at(s) < free_ || place_[at(s)] == 0) {
      place_[at(s)] = static_cast<int>(list.size());
      list.push_back(s);
    }
  }
  motion_.setZero(ix(rows_.size()), ix(tied_.size() + given_.size()));
  torque_.setZero(ix(rows_.size()), ix(tied_.size()));
  lossy_.assign(rows_.size(), 0);
  strength_.assign(rows_.size(), 0);
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    for (const ShaftGain& g : rows_[k].motion)
      motion_(ix(k), place_[at(g.shaft)] + (at(g.shaft) < free_ ? 0 : ix(tied_.size()))) += g.gain;
    for (const ShaftGain& t : rows_[k].torque)
      if (at(t.shaft) < free_) torque_(ix(k), place_[at(t.shaft)]) -= t.gain;
    const auto free_part = motion_.row(ix(k)).head(ix(tied_.size()));
    const double size = tied_.empty() ? 0 : free_part.cwiseAbs().maxCoeff();
    strength_[k] = rows_[k].capacity * size * size;
    if (size > 0) lossy_[k] = (torque_.row(ix(k)) - free_part).cwiseAbs().maxCoeff() / size;
  }
  magnitude_.clear();
  inertia_.clear();
  for (auto* per_shaft : {&tied_torque_, &alpha_, &shift_, &right_, &rest_, &size_}) per_shaft->assign(tied_.size(), 0);
  lambda_.assign(rows_.size(), 0);
  locked_ = false;
  if (tied_.empty() && !rows_.empty()) choose_leaders();  // nothing to lead: the rows can only be checked
}

void Constraints::System::factorise(std::span<const double> inertia) {
  const std::size_t n = tied_.size();
  bool same = inertia_.size() == n;
  for (std::size_t s = 0; same && s < n; ++s) same = inertia_[s] == inertia[at(tied_[s])];
  if (same) return;
  bool alike = magnitude_.size() == n;
  inertia_.resize(n), magnitude_.resize(n);
  for (std::size_t s = 0; s < n; ++s) {
    inertia_[s] = inertia[at(tied_[s])];
    const int magnitude = magnitude_of(inertia_[s]);
    alike = alike && magnitude == magnitude_[s];
    magnitude_[s] = magnitude;
  }
  if (!alike) choose_leaders();
  locked_ = bear_.size() < basic_.size() || !reduce(torque_free_, free_of_, reduced_inverse_);
  if (!repeating_.empty() && !locked_ && is_lossy()) respond_to_repeating();
}

Eigen::VectorXd Constraints::System::shaft_weights() const {
  Eigen::VectorXd weight(ix(tied_.size()));
  for (std::size_t s = 0; s < tied_.size(); ++s) weight[ix(s)] = root_inverse(magnitude_[s]);
  return weight;
}

// Which shafts lead and which follow, and the rows that say something new: of repeating ones those that can carry most.
void Constraints::System::choose_leaders() {
  const std::size_t n = tied_.size(), m = rows_.size();
  std::vector<std::size_t> strongest_first(m);
  std::iota(strongest_first.begin(), strongest_first.end(), std::size_t{0});
  std::stable_sort(strongest_first.begin(), strongest_first.end(),
                   [&](std::size_t a, std::size_t b) { return strength_[a] > strength_[b]; });
  const Eliminated by_motion = eliminate(motion_, strongest_first, shaft_weights());
  const std::size_t r = by_motion.rank();
  basic_.assign(by_motion.row.begin(), by_motion.row.end());
  follow_.assign(by_motion.column.begin(), by_motion.column.end());
  repeating_ = others(m, basic_);
  lead_ = others(n, follow_);
  allowed_.setZero(ix(n), ix(lead_.size()));
  by_given_.setZero(ix(n), ix(given_.size()));
  follow_inverse_.resize(ix(r), ix(r));
  for (std::size_t j = 0; j < lead_.size(); ++j) allowed_(ix(lead_[j]), ix(j)) = 1;
  for (std::size_t p = 0; p < r; ++p) {
    const auto row = by_motion.rows.row(ix(basic_[p]));
    for (std::size_t j = 0; j < lead_.size(); ++j) allowed_(ix(follow_[p]), ix(j)) = -row[ix(lead_[j])];
    by_given_.row(ix(follow_[p])) = -row.tail(ix(given_.size()));
    for (std::size_t b = 0; b < r; ++b)
      follow_inverse_(ix(p), ix(b)) = by_motion.combination(ix(basic_[p]), ix(basic_[b]));
  }
  share_alpha_.setZero(ix(n), ix(repeating_.size()));
  share_multiplier_.resize(ix(r), ix(repeating_.size()));
  for (std::size_t k = 0; k < repeating_.size(); ++k)
    for (std::size_t b = 0; b < r; ++b)
      share_multiplier_(ix(b), ix(k)) = by_motion.combination(ix(repeating_[k]), ix(basic_[b]));
  share();
  find_torque_space();
}

// Which equations of motion give λ, and the combinations of all that are free of it.
void Constraints::System::find_torque_space() {
  const std::size_t n = tied_.size(), r = basic_.size();
  if (!is_lossy()) {
    bear_ = follow_, free_of_ = lead_;
    torque_free_ = allowed_, bear_inverse_ = follow_inverse_;
    return;
  }
  Matrix torques(ix(r), ix(n));
  std::vector<std::size_t> any_order(r);
  std::iota(any_order.begin(), any_order.end(), std::size_t{0});
  for (std::size_t b = 0; b < r; ++b) torques.row(ix(b)) = torque_.row(ix(basic_[b]));
  const Eliminated by_torque = eliminate(torques, any_order, shaft_weights());
  bear_.assign(by_torque.column.begin(), by_torque.column.end());
  free_of_ = others(n, bear_);
  if (bear_.size() < r) return;  // locked
  torque_free_.setZero(ix(n), ix(free_of_.size()));
  bear_inverse_.resize(ix(r), ix(r));
  for (std::size_t j = 0; j < free_of_.size(); ++j) torque_free_(ix(free_of_[j]), ix(j)) = 1;
  for (std::size_t p = 0; p < r; ++p) {
    for (std::size_t j = 0; j < free_of_.size(); ++j)
      torque_free_(ix(bear_[p]), ix(j)) = -by_torque.rows(by_torque.row[p], ix(free_of_[j]));
    bear_inverse_.row(ix(p)) = by_torque.combination.row(by_torque.row[p]);
  }
}

// (leftᵀ I Z)⁻¹. For the inversion rows and columns are brought to like size by the inertias of their shafts. With
// losses terms may cancel.
bool Constraints::System::reduce(const Matrix& left, const std::vector<std::size_t>& unit, Matrix& inverse) const {
  const Eigen::Index k = allowed_.cols();
  inverse.setZero(k, k);
  for (std::size_t s = 0; s < tied_.size(); ++s) {
    const double *l = left.data() + ix(s) * k, *z = allowed_.data() + ix(s) * k;
    for (Eigen::Index i = 0; i < k; ++i)
      if (const double factor = inertia_[s] * l[i]; factor != 0)
        for (Eigen::Index j = 0; j < k; ++j) inverse(i, j) += factor * z[j];
  }
  const auto root = [&](const std::vector<std::size_t>& shaft, Eigen::Index j) {
    return root_inverse(magnitude_[shaft[static_cast<std::size_t>(j)]]);
  };
  double size = 0;
  for (Eigen::Index i = 0; i < k; ++i)
    for (Eigen::Index j = 0; j < k; ++j) {
      const double factor = root(unit, i) * root(lead_, j);
      inverse(i, j) *= factor;
      size = std::max(size, std::abs(inverse(i, j)));
      if (!is_lossy()) continue;
      for (std::size_t s = 0; s < tied_.size(); ++s)
        size = std::max(size, std::abs(inertia_[s] * left(ix(s), i) * allowed_(ix(s), j)) * factor);
    }
  if (!invert(inverse, none * size)) return false;
  for (Eigen::Index i = 0; i < k; ++i)
    for (Eigen::Index j = 0; j < k; ++j) inverse(i, j) *= root(lead_, i) * root(unit, j);
  return true;
}

// With losses a repeating row's torque is not what basic rows can take without an acceleration.
void Constraints::System::respond_to_repeating() {
  const std::size_t n = tied_.size(), r = basic_.size();
  const std::vector<double> no_shift(n, 0.0);
  std::vector<double> unit(n), alpha(n), lambda(r);
  for (std::size_t k = 0; k < repeating_.size(); ++k) {
    for (std::size_t s = 0; s < n; ++s) unit[s] = -torque_(ix(repeating_[k]), ix(s));
    accelerate(unit.data(), no_shift.data(), alpha.data(), lambda.data());
    for (std::size_t b = 0; b < r; ++b) {
      double size = 0;
      for (std::size_t p = 0; p < r; ++p)
        size += std::abs(bear_inverse_(ix(p), ix(b))) *
                (std::abs(unit[bear_[p]]) + std::abs(inertia_[bear_[p]] * alpha[bear_[p]]));
      share_multiplier_(ix(b), ix(k)) = std::abs(lambda[b]) > none * size ? lambda[b] : 0;
    }
    for (std::size_t s = 0; s < n; ++s) share_alpha_(ix(s), ix(k)) = alpha[s];
  }
  share();
}

// What is free in λ where rows repeat: z, the λ of the repeating rows. λ = λ₀ + R z has the least Σ λ²/capacity where
// (C⁻¹ + Rᵀ C_b⁻¹ R) z = −Rᵀ C_b⁻¹ λ₀. Repeating rows are the weakest, so that this is well determined.
void Constraints::System::share() {
  const auto r = ix(basic_.size()), q = ix(repeating_.size());
  Matrix root(r, q), scaled = share_multiplier_;  // C_b^-½ C^½, C_b^-½ R C^½
  for (Eigen::Index b = 0; b < r; ++b)
    for (Eigen::Index k = 0; k < q; ++k) {
      const std::size_t row = repeating_[static_cast<std::size_t>(k)], basic = basic_[static_cast<std::size_t>(b)];
      const bool counts = rows_[row].unlimited || !rows_[basic].unlimited;
      root(b, k) = counts ? std::sqrt(capacity_[row] / capacity_[basic]) : 0;
    }
  scaled.array() *= root.array();
  Matrix inverse = Matrix::Identity(q, q) + scaled.transpose() * scaled;
  invert(inverse, none);
  shares_ = -inverse * scaled.transpose();
  shares_.array() *= root.transpose().array();
}

bool Constraints::System::is_lossy() const {
  return std::any_of(lossy_.begin(), lossy_.end(), [](double part) { return part != 0; });
}

// α of the tied shafts and λ of the basic rows, the others' λ being 0. `shift` is what the given accelerations add to
// α.
void Constraints::System::accelerate(const double* torque, const double* shift, double* alpha, double* lambda) {
  const std::size_t n = tied_.size(), k = lead_.size(), r = basic_.size();
  for (std::size_t j = 0; j < k; ++j) right_[j] = 0;
  for (std::size_t s = 0; s < n; ++s) {
    const double rest = torque[s] - inertia_[s] * shift[s];
    const double* y = torque_free_.data() + s * k;
    for (std::size_t j = 0; j < k; ++j) right_[j] += y[j] * rest;
    alpha[s] = shift[s];
  }
  for (std::size_t i = 0; i < k; ++i) {
    const double* row = reduced_inverse_.data() + i * k;
    double own = 0;
    for (std::size_t j = 0; j < k; ++j) own += row[j] * right_[j];
    for (std::size_t s = 0; s < n; ++s) alpha[s] += allowed_.data()[s * k + i] * own;
  }
  std::fill_n(lambda, r, 0.0);
  for (std::size_t p = 0; p < r; ++p) {
    const std::size_t s = bear_[p];
    const double rest = torque[s] - inertia_[s] * alpha[s];
    const double* row = bear_inverse_.data() + p * r;
    for (std::size_t b = 0; b < r; ++b) lambda[b] += row[b] * rest;
  }
}

void Constraints::System::solve(std::span<const double> inertia, std::span<const double> torque,
                                std::span<double> alpha, std::span<double> multiplier) {
  trouble_.reset();
  for (const int s : loose_) alpha[at(s)] = torque[at(s)] / inertia[at(s)];
  if (rows_.empty()) return;
  factorise(inertia);
  const std::size_t n = tied_.size(), r = basic_.size();
  if (locked_) {
    trouble_ = {Trouble::Cause::locked, lossiest()};
    for (const int s : tied_) alpha[at(s)] = 0;
    std::fill_n(multiplier.begin(), rows_.size(), 0.0);
    return;
  }
  for (std::size_t s = 0; s < n; ++s) {
    tied_torque_[s] = torque[at(tied_[s])];
    shift_[s] = 0;
    for (std::size_t g = 0; g < given_.size(); ++g)
      shift_[s] += by_given_.data()[s * given_.size() + g] * alpha[at(given_[g])];
  }
  accelerate(tied_torque_.data(), shift_.data(), alpha_.data(), lambda_.data());
  for (std::size_t k = 0; k < repeating_.size(); ++k) {
    double z = 0;
    for (std::size_t b = 0; b < r; ++b) z += shares_(ix(k), ix(b)) * lambda_[b];
    multiplier[repeating_[k]] = z;
  }
  for (std::size_t k = 0; k < repeating_.size(); ++k) {
    const double z = multiplier[repeating_[k]];
    for (std::size_t b = 0; b < r; ++b) lambda_[b] += share_multiplier_(ix(b), ix(k)) * z;
    for (std::size_t s = 0; s < n; ++s) alpha_[s] += share_alpha_(ix(s), ix(k)) * z;
  }
  for (std::size_t b = 0; b < r; ++b) multiplier[basic_[b]] = lambda_[b];
  for (std::size_t s = 0; s < n; ++s) alpha[at(tied_[s])] = alpha_[s];
  if (!is_kept(alpha, multiplier)) look_for_trouble(alpha, multiplier);
}

// I α = M + T λ and G α = 0, each to a small part of its terms.
bool Constraints::System::is_kept(std::span<const double> alpha, std::span<const double> multiplier) {
  bool kept = true;
  for (std::size_t s = 0; s < tied_.size(); ++s) {
    const double own = inertia_[s] * alpha_[s];
    rest_[s] = tied_torque_[s] - own;
    size_[s] = std::abs(tied_torque_[s]) + std::abs(own);
  }
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    double sum = 0, size = 0;
    for (const ShaftGain& g : rows_[k].motion) {
      const double part = g.gain * alpha[at(g.shaft)];
      sum += part, size += std::abs(part);
    }
    kept = kept && std::abs(sum) <= plainly * size;
    for (const ShaftGain& t : rows_[k].torque) {
      if (at(t.shaft) >= free_) continue;
      const double part = t.gain * multiplier[k];
      rest_[at(place_[at(t.shaft)])] += part, size_[at(place_[at(t.shaft)])] += std::abs(part);
    }
  }
  for (std::size_t s = 0; s < tied_.size(); ++s) kept = kept && std::abs(rest_[s]) <= plainly * size_[s];
  return kept;
}

// A residue that is large beside its own terms may yet be round-off of what went into them: measured by that.
void Constraints::System::look_for_trouble(std::span<const double> alpha, std::span<const double> multiplier) {
  const std::size_t n = tied_.size(), r = basic_.size(), k = lead_.size();
  Eigen::VectorXd reach(ix(n)), torque(ix(n)), lambda(ix(rows_.size()));
  for (std::size_t s = 0; s < n; ++s) {
    reach[ix(s)] = 0;
    for (std::size_t g = 0; g < given_.size(); ++g)
      reach[ix(s)] += std::abs(by_given_(ix(s), ix(g)) * alpha[at(given_[g])]);
    for (std::size_t j = 0; j < k; ++j) reach[ix(s)] += std::abs(allowed_(ix(s), ix(j)) * alpha_[lead_[j]]);
    torque[ix(s)] = std::abs(tied_torque_[s]) + std::abs(inertia_[s]) * reach[ix(s)];
  }
  for (std::size_t row = 0; row < rows_.size(); ++row) lambda[ix(row)] = std::abs(multiplier[row]);
  for (std::size_t b = 0; b < r; ++b)
    for (std::size_t p = 0; p < r; ++p)
      lambda[ix(basic_[b])] += std::abs(bear_inverse_(ix(p), ix(b))) * torque[ix(bear_[p])];
  if (!reach.allFinite() || !lambda.allFinite()) return;  // a value was lost before: not here
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    double sum = 0, size = 0;
    for (const ShaftGain& g : rows_[row].motion) {
      const bool is_free = at(g.shaft) < free_;
      sum += g.gain * alpha[at(g.shaft)];
      size += std::abs(g.gain) * (is_free ? reach[place_[at(g.shaft)]] : std::abs(alpha[at(g.shaft)]));
    }
    if (std::abs(sum) <= is_lost * size) continue;
    trouble_ = {given_.empty() ? Trouble::Cause::lost : Trouble::Cause::contradicted, row};
    return;
  }
  for (std::size_t s = 0; s < n; ++s) size_[s] = torque[ix(s)] + torque_.col(ix(s)).cwiseAbs().dot(lambda);
  for (std::size_t j = 0; j < free_of_.size(); ++j)
    size_[free_of_[j]] += torque_free_.col(ix(j)).cwiseAbs().dot(torque);
  for (std::size_t s = 0; s < n; ++s)
    if (std::abs(rest_[s]) > is_lost * size_[s]) trouble_ = {Trouble::Cause::lost, lossiest()};
}

std::size_t Constraints::System::lossiest() const {
  return static_cast<std::size_t>(std::max_element(lossy_.begin(), lossy_.end()) - lossy_.begin());
}

void Constraints::System::project(std::span<const double> inertia, std::span<double> speed) {
  if (rows_.empty()) return;
  factorise(inertia);
  const std::size_t r = basic_.size();
  Matrix inverse;  // of Zᵀ I Z: kinetic energy knows no losses
  if (!reduce(allowed_, lead_, inverse)) return;
  Eigen::VectorXd violation(ix(r)), right = Eigen::VectorXd::Zero(ix(lead_.size()));
  for (std::size_t b = 0; b < r; ++b) {
    double sum = 0;
    for (const ShaftGain& g : rows_[basic_[b]].motion) sum += g.gain * speed[at(g.shaft)];
    violation[ix(b)] = sum;
  }
  // Corrected by those that follow alone, then shared with those that lead.
  const Eigen::VectorXd alone = -follow_inverse_ * violation;
  for (std::size_t p = 0; p < r; ++p)
    right += inertia_[follow_[p]] * alone[ix(p)] * allowed_.row(ix(follow_[p])).transpose();
  const Eigen::VectorXd change = inverse * right;
  for (std::size_t j = 0; j < lead_.size(); ++j) speed[at(tied_[lead_[j]])] -= change[ix(j)];
  for (const std::size_t s : follow_) {
    double own = 0;
    for (std::size_t j = 0; j < lead_.size(); ++j) own += allowed_(ix(s), ix(j)) * speed[at(tied_[lead_[j]])];
    for (std::size_t g = 0; g < given_.size(); ++g) own += by_given_(ix(s), ix(g)) * speed[at(given_[g])];
    speed[at(tied_[s])] = own;
  }
}

std::vector<double> Constraints::System::mobility(std::span<const double> inertia, std::span<const int> shafts) {
  const std::size_t n = tied_.size();
  std::vector<double> result(shafts.size() * shafts.size(), 0.0);
  if (!rows_.empty()) factorise(inertia);
  Matrix tied = Matrix::Zero(ix(n), ix(n));
  if (!rows_.empty() && !locked_) {
    tied = allowed_ * (reduced_inverse_ * torque_free_.transpose());
    if (!repeating_.empty() && share_alpha_.any()) {  // with losses shared torques accelerate
      Matrix borne(ix(basic_.size()), ix(n));
      for (std::size_t p = 0; p < bear_.size(); ++p) {
        borne.row(ix(p)) = -inertia_[bear_[p]] * tied.row(ix(bear_[p]));
        borne(ix(p), ix(bear_[p])) += 1;
      }
      tied += share_alpha_ * (shares_ * (bear_inverse_.transpose() * borne));
    }
  }
  const auto is_tied = [&](int shaft) {
    const auto p = place_[at(shaft)];
    return at(p) < n && tied_[at(p)] == shaft;
  };
  for (std::size_t i = 0; i < shafts.size(); ++i) {
    if (!is_tied(shafts[i])) {
      result[i * shafts.size() + i] = 1 / inertia[at(shafts[i])];
      continue;
    }
    for (std::size_t j = 0; j < shafts.size(); ++j)
      if (is_tied(shafts[j])) result[i * shafts.size() + j] = tied(place_[at(shafts[i])], place_[at(shafts[j])]);
  }
  return result;
}

double Constraints::System::mobility(std::span<const double> inertia, std::span<const ShaftGain> motion,
                                     std::span<const ShaftGain> torque) {
  std::vector<int> shafts;
  for (const auto side : {motion, torque})
    for (const ShaftGain& g : side)
      if (at(g.shaft) < free_ && std::find(shafts.begin(), shafts.end(), g.shaft) == shafts.end())
        shafts.push_back(g.shaft);
  const std::vector<double> w = mobility(inertia, shafts);
  const Eigen::Map<const RowMatrix> by_torque(w.data(), ix(shafts.size()), ix(shafts.size()));
  const auto over = [&](std::span<const ShaftGain> side) {
    Eigen::VectorXd gain = Eigen::VectorXd::Zero(ix(shafts.size()));
    for (const ShaftGain& g : side)
      for (std::size_t i = 0; i < shafts.size(); ++i)
        if (shafts[i] == g.shaft) gain[ix(i)] += g.gain;
    return gain;
  };
  return over(motion).dot(by_torque * over(torque));
}

}  // namespace kurbel
