// mean_balance.cpp — averages along the base motion: derivatives, and twists and internal states with which the means balance.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/linear/linearise.h"
#include "engine/matrices/linear_algebra.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Triplets = std::vector<Eigen::Triplet<double>>;

constexpr int most_steps = 25, most_halvings = 6;
constexpr double balanced_within = 1e-11;    // of torque scale, of internal states' scales over the time of a radian
constexpr double near_enough_to_end = 1e-7;  // where Newton's steps cannot come nearer
constexpr Index dense_below = 200;           // unknowns

SparseMatrix matrix(Index rows, Index columns, const Triplets& entries) {
  SparseMatrix m(rows, columns);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

// Of a square system of many unknowns by LU; small or odd ones by an orthogonal decomposition, which leaves alone what no
// equation fixes. Empty: there is no solution.
VectorXd solved(const SparseMatrix& a, const VectorXd& right) {
  if (a.cols() <= dense_below || a.rows() != a.cols()) return shortest_solution(Eigen::MatrixXd(a), right);
  SparseLu lu;
  if (!lu.factorise(a)) return {};
  VectorXd x = lu.solve(right);
  return x.allFinite() ? x : VectorXd();
}

}  // namespace

MeanDerivatives BaseMotion::mean_derivatives() {
  const SparsityPattern& pattern = equations_.jacobian_pattern();
  std::vector<double> values(pattern.row.size()), sum(pattern.row.size(), 0.0);
  const std::size_t speeds = equations_.speed_index(0), twists = equations_.twist_index(0),
                    own = equations_.internal_begin();
  const double share = 1.0 / static_cast<double>(positions_.size());
  for (const Position& position : positions_) {
    at(position);
    equations_.jacobian(time(position), y_, values);
    const std::span<const double> inertia = equations_.effective_inertia();
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto row = static_cast<std::size_t>(pattern.row[k]);
      if (row >= speeds) sum[k] += share * values[k] * (row < own ? inertia[row - speeds] : 1);
    }
  }
  Triplets by_angle[2], by_twist[2], by_speed[2], by_internal[2];  // of torques, of rates of internal states
  for (std::size_t c = 0; c < m_.state_count(); ++c)
    for (auto k = kurbel::at(pattern.column_start[c]); k < kurbel::at(pattern.column_start[c + 1]); ++k) {
      const auto row = static_cast<std::size_t>(pattern.row[k]);
      if (row < speeds || sum[k] == 0) continue;
      if (!std::isfinite(sum[k]))
        throw std::runtime_error("the machine has no derivatives at its operating point: its friction jams there");
      const std::size_t of = row < own ? 0 : 1;
      const auto r = static_cast<int>(row - (row < own ? speeds : own));
      if (c >= own) {
        by_internal[of].emplace_back(r, static_cast<int>(c - own), sum[k]);
      } else if (c >= speeds) {
        by_speed[of].emplace_back(r, static_cast<int>(c - speeds), sum[k]);
      } else if (c >= twists) {
        by_twist[of].emplace_back(r, static_cast<int>(c - twists), sum[k]);
      } else if (point_.angle) {
        by_angle[of].emplace_back(r, m_.angles[c].shaft, sum[k] * m_.angles[c].gain);
      }
    }
  const auto shafts = static_cast<Index>(m_.shafts.size()), joints = static_cast<Index>(m_.elastic.size()),
             states = static_cast<Index>(m_.internal_states.size());
  const SparseMatrix &z = coordinates_.motion, across = z.transpose();
  return {.torque_by_twist = across * matrix(shafts, joints, by_twist[0]),
          .torque_by_speed = across * matrix(shafts, shafts, by_speed[0]) * z,
          .torque_by_internal = across * matrix(shafts, states, by_internal[0]),
          .internal_by_twist = matrix(states, joints, by_twist[1]),
          .internal_by_speed = matrix(states, shafts, by_speed[1]) * z,
          .internal_by_internal = matrix(states, states, by_internal[1]),
          .torque_by_angle = across * matrix(shafts, shafts, by_angle[0]) * z,
          .internal_by_angle = matrix(states, shafts, by_angle[1]) * z};
}

VectorXd BaseMotion::mean_joint_torques() {
  VectorXd sum = VectorXd::Zero(static_cast<Index>(m_.elastic.size()));
  for (const Position& position : positions_) {
    at(position);
    const Snapshot& s = equations_.snapshot(time(position), y_);
    sum += Eigen::Map<const VectorXd>(s.sums.connection_torque, sum.size());
  }
  return sum / static_cast<double>(positions_.size());
}

// Unknowns: twists of springs, accelerations of what turns freely as a whole, internal states.
class BaseMotion::Balance {
 public:
  explicit Balance(BaseMotion& base)
      : b_(base), m_(base.m_), n_(base.coordinates_.size()), states_(static_cast<Index>(m_.internal_states.size())) {
    Triplets kept;
    const SparseRows twists = b_.twists_;
    for (std::size_t j = 0; j < m_.elastic.size(); ++j)
      if (b_.has_spring(j) && twists.row(static_cast<Index>(j)).norm() > 0) springs_.push_back(static_cast<int>(j));
    for (std::size_t k = 0; k < springs_.size(); ++k) kept.emplace_back(static_cast<int>(k), springs_[k], 1.0);
    spring_twists_ = matrix(static_cast<Index>(springs_.size()), twists.rows(), kept) * twists;
    free_ = motions_without_twist(spring_twists_);
    find_loops();
    free_alpha_ = VectorXd::Zero(free_.cols());
    is_held_.assign(static_cast<std::size_t>(states_), 0);
  }

  void find() {
    const std::vector<double> begin = b_.begin_;
    if (!b_.point_.orbit) guess_twists();
    if (!newton()) {
      b_.begin_ = begin;
      if (!b_.point_.orbit) guess_twists();
      const int held = hold_states_of_elements();
      const bool found = newton();
      if (held > 0)
        b_.words_ =
            "internal states of motors and loads have no balance at this speed: they keep their previous values";
      if (!found)
        b_.words_ = "no twists and internal states were found with which the mean torques balance exactly here";
    }
    b_.acceleration_ = free_ * free_alpha_;
    report_left_over();
  }

 private:
  VectorXd mean(bool with_acceleration = true) {
    VectorXd sum = VectorXd::Zero(n_ + states_);
    b_.acceleration_ = VectorXd::Zero(n_);
    for (const Position& position : b_.positions_) {
      const Residual r = b_.residual(position);
      sum.head(n_) += r.torque;
      sum.tail(states_) += r.own;
    }
    sum /= static_cast<double>(b_.positions_.size());
    if (b_.point_.added) sum.head(n_) += *b_.point_.added;
    if (with_acceleration) sum.head(n_) -= b_.inertia_.cwiseProduct(free_ * free_alpha_);
    for (Index k = 0; k < states_; ++k)
      if (is_held_[static_cast<std::size_t>(k)]) sum[n_ + k] = 0;
    return sum;
  }

  // Twists that no motion brings: sums over closed loops, which keep what is locked in. Orthogonal to the springs' image.
  void find_loops() {
    const auto springs = static_cast<Index>(springs_.size());
    const Index count = springs + free_.cols() - n_;
    loops_ = Eigen::MatrixXd(0, springs);
    if (count <= 0) return;
    loops_ = FullLu(Eigen::MatrixXd(spring_twists_.transpose())).kernel().transpose();
  }
  // Rows below the balance of the coordinates: twists of loops, or torques over the springs' stiffness.
  void add_loops(int row, const VectorXd& factor, Triplets& to) const {
    for (Index l = 0; l < loops_.rows(); ++l)
      for (Index k = 0; k < loops_.cols(); ++k)
        if (loops_(l, k) != 0)
          to.emplace_back(row + static_cast<int>(l), static_cast<int>(k), loops_(l, k) * factor[k]);
  }

  // What the joints must carry, and the twists at which they do.
  void guess_twists() {
    const VectorXd torque_now = b_.mean_joint_torques();
    VectorXd needed = mean(false).head(n_);
    for (std::size_t k = 0; k < springs_.size(); ++k)
      needed += spring_twists_.row(static_cast<Index>(k)).transpose() * torque_now[springs_[k]];
    SparseMatrix system(n_ + loops_.rows(), static_cast<Index>(springs_.size()) + free_.cols());
    Triplets entries;
    add(spring_twists_.transpose(), 0, 0, 1, entries);
    add_free(static_cast<int>(springs_.size()), 1, entries);
    VectorXd compliance = VectorXd::Zero(static_cast<Index>(springs_.size())),
             gape = VectorXd::Zero(n_ + loops_.rows());
    for (Index k = 0; loops_.rows() > 0 && k < compliance.size(); ++k) {
      const auto joint = static_cast<std::size_t>(springs_[kurbel::at(k)]);
      const double stiffness = m_.network.joints[kurbel::at(m_.elastic[joint].joint)].element->stiffness;
      compliance[k] = stiffness > 0 ? 1 / stiffness : 0;
      for (Index l = 0; l < loops_.rows(); ++l)
        gape[n_ + l] += loops_(l, k) * b_.begin_[b_.equations_.twist_index(springs_[kurbel::at(k)])];
    }
    gape.head(n_) = needed;
    add_loops(static_cast<int>(n_), compliance, entries);
    system.setFromTriplets(entries.begin(), entries.end());
    const VectorXd x = solved(system, gape);
    if (x.size() == 0) return;
    for (std::size_t k = 0; k < springs_.size(); ++k) {
      const auto joint = static_cast<std::size_t>(springs_[k]);
      b_.begin_[b_.equations_.twist_index(springs_[k])] =
          m_.network.joints[kurbel::at(m_.elastic[joint].joint)].element->twist_at(x[static_cast<Index>(k)]);
    }
    free_alpha_ = x.tail(free_.cols());
  }

  bool newton() {
    VectorXd residual = mean();
    double size = measure(residual);
    for (int step = 0; step < most_steps; ++step) {
      if (size <= balanced_within) return true;
      Deadline::check();
      VectorXd right = VectorXd::Zero(residual.size() + loops_.rows());  // loops keep what they have
      right.head(residual.size()) = residual;
      const VectorXd change = solved(system(), right);
      if (change.size() == 0 || !change.allFinite()) return size <= near_enough_to_end;
      bool better = false;
      double part = 1;
      for (int i = 0; i < most_halvings && !better; ++i, part *= 0.5) {
        go(-part * change);
        const VectorXd next = mean();
        const double next_size = measure(next);
        better = next_size < size;
        if (!better) go(part * change);
        if (better) residual = next, size = next_size;
      }
      if (!better) return size <= near_enough_to_end;
    }
    return size <= near_enough_to_end;
  }

  // Derivatives of the residual by [θ, α, z].
  SparseMatrix system() {
    const MeanDerivatives j = b_.mean_derivatives();
    const auto springs = static_cast<int>(springs_.size()), free = static_cast<int>(free_.cols());
    std::vector<int> place(m_.elastic.size(), -1);
    for (int k = 0; k < springs; ++k) place[kurbel::at(springs_[kurbel::at(k)])] = k;
    Triplets entries;
    const auto add_twists = [&](const SparseMatrix& by_twist, int row) {
      for (Index c = 0; c < by_twist.outerSize(); ++c)
        for (SparseMatrix::InnerIterator it(by_twist, c); it; ++it)
          if (place[kurbel::at(c)] >= 0 && !is_held(row, it.row()))
            entries.emplace_back(row + static_cast<int>(it.row()), place[kurbel::at(c)], it.value());
    };
    add_twists(j.torque_by_twist, 0);
    add_twists(j.internal_by_twist, static_cast<int>(n_));
    add_free(springs, -1, entries);
    for (Index c = 0; c < states_; ++c) {
      const int column = springs + free + static_cast<int>(c);
      if (is_held_[kurbel::at(c)]) {
        entries.emplace_back(static_cast<int>(n_ + c), column, 1.0);
        continue;
      }
      for (SparseMatrix::InnerIterator it(j.torque_by_internal, c); it; ++it)
        entries.emplace_back(static_cast<int>(it.row()), column, it.value());
      for (SparseMatrix::InnerIterator it(j.internal_by_internal, c); it; ++it)
        if (!is_held_[kurbel::at(it.row())]) entries.emplace_back(static_cast<int>(n_ + it.row()), column, it.value());
    }
    add_loops(static_cast<int>(n_ + states_), VectorXd::Ones(springs), entries);
    return matrix(n_ + states_ + loops_.rows(), springs + free + states_, entries);
  }
  bool is_held(int block, Index row) const { return block > 0 && is_held_[kurbel::at(row)]; }

  static void add(const SparseMatrix& m, int row, int column, double factor, Triplets& to) {
    for (Index c = 0; c < m.outerSize(); ++c)
      for (SparseMatrix::InnerIterator it(m, c); it; ++it)
        to.emplace_back(row + static_cast<int>(it.row()), column + static_cast<int>(c), factor * it.value());
  }
  // The accelerating torque M q̈ of what turns freely.
  void add_free(int column, double sign, Triplets& to) const {
    for (Index c = 0; c < free_.cols(); ++c)
      for (Index i = 0; i < n_; ++i)
        if (free_(i, c) != 0)
          to.emplace_back(static_cast<int>(i), column + static_cast<int>(c), sign * b_.inertia_[i] * free_(i, c));
  }

  void go(const VectorXd& change) {
    for (std::size_t k = 0; k < springs_.size(); ++k)
      b_.begin_[b_.equations_.twist_index(springs_[k])] += change[static_cast<Index>(k)];
    free_alpha_ += change.segment(static_cast<Index>(springs_.size()), free_.cols());
    for (Index k = 0; k < states_; ++k)
      b_.begin_[b_.equations_.internal_begin() + kurbel::at(k)] += change[change.size() - states_ + k];
  }
  double measure(const VectorXd& residual) const {
    double largest = 0;
    for (Index k = 0; k < n_; ++k)
      largest = std::max(
          largest, std::abs(residual[k]) / m_.shafts[kurbel::at(b_.coordinates_.shaft[kurbel::at(k)])].torque_scale);
    for (Index k = 0; k < states_; ++k)
      largest = std::max(largest, std::abs(residual[n_ + k]) /
                                      (m_.internal_states[kurbel::at(k)].state.scale * std::max(1.0, m_.speed_scale)));
    return std::isfinite(residual.sum()) ? largest : HUGE_VAL;
  }

  // All but those of elastic joints.
  int hold_states_of_elements() {
    int held = 0;
    for (Index k = 0; k < states_; ++k) {
      const std::string& component = m_.internal_states[kurbel::at(k)].component;
      const bool of_joint = std::any_of(m_.elastic.begin(), m_.elastic.end(), [&](const ElasticJoint& e) {
        const Network::Joint& joint = m_.network.joints[kurbel::at(e.joint)];
        return joint.component == component && joint.element->is.states > 0;
      });
      if (!of_joint) is_held_[kurbel::at(k)] = 1, ++held;
    }
    return held;
  }

  void report_left_over() {
    std::vector<double> geared;
    for (const Shaft& shaft : m_.shafts) geared.push_back(m_.node_ratio[kurbel::at(shaft.reference)]);
    const VectorXd ratio = b_.coordinates_.rates(geared, b_.shaft_inertia_);
    b_.left_over_ = ratio.cwiseProduct(b_.inertia_).dot(b_.acceleration_);
  }

  BaseMotion& b_;
  const Model& m_;
  Index n_, states_;
  std::vector<int> springs_;  // elastic joints
  SparseRows spring_twists_;  // row by row: a row of a SparseMatrix takes a visit to each column
  Eigen::MatrixXd free_;      // motions without twist
  Eigen::MatrixXd loops_;     // per row: the twists of springs that add up to what a loop has locked in
  VectorXd free_alpha_;
  std::vector<char> is_held_;  // per internal state
};

// Without a steady motion it is found here which flanks of gears with losses carry; with one, which pieces of laws hold.
void BaseMotion::balance() {
  constexpr int most_changes = 4;
  for (int i = 0; i < most_changes; ++i) {
    const std::vector<double> before = begin_;
    Balance(*this).find();
    if (!(point_.orbit ? pass_pieces(before) : turn_flanks())) return;
  }
}

bool BaseMotion::turn_flanks() {
  residual(positions_.front());
  bool turned = false;
  for (const int r : equations_.ties().lossy()) {
    if (!(equations_.ties().flank_margin(kurbel::at(r)) < 0)) continue;
    equations_.changing_modes().loss_sign[kurbel::at(r)] *= -1;
    turned = true;
  }
  if (turned) equations_.ties().make_rows();
  return turned;
}

}  // namespace kurbel
