// coordinates.cpp — null space of the ties, by groups of tied shafts.
#include "engine/linear/coordinates.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/numerics/index.h"

namespace kurbel {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double says_nothing_new = 1e-10;  // of a row, over the largest
constexpr double closes = 1e-9;             // of a speed: tolerance for the closure of a loop

class Maker {
 public:
  Maker(const Model& model, const Ties& ties, const Eigen::VectorXd& inertia)
      : m_(model), ties_(ties), inertia_(inertia), group_(model.shafts.size()) {}

  Coordinates coordinates() {
    join();
    for (std::size_t s = 0; s < m_.free_shafts; ++s)
      if (moves(static_cast<int>(s)) && root(static_cast<int>(s)) == static_cast<int>(s)) add(members_[s]);
    out_.motion = SparseMatrix(static_cast<Index>(m_.shafts.size()), static_cast<Index>(out_.shaft.size()));
    out_.motion.setFromTriplets(entries_.begin(), entries_.end());
    return std::move(out_);
  }

 private:
  bool moves(int s) const { return at(s) < m_.free_shafts && !ties_.stands(at(s)); }
  int root(int s) {
    while (group_[at(s)] != s) s = group_[at(s)] = group_[at(group_[at(s)])];
    return s;
  }
  // Groups of shafts that rows tie; rows by the root of their group.
  void join() {
    std::iota(group_.begin(), group_.end(), 0);
    for (const ConstraintRow& row : ties_.rows()) {
      int first = -1;
      for (const ShaftGain& g : row.motion) {
        if (g.gain == 0 || !moves(g.shaft)) continue;
        if (first < 0) first = g.shaft;
        group_[at(root(g.shaft))] = root(first);
      }
    }
    members_.resize(m_.shafts.size());
    rows_.resize(m_.shafts.size());
    for (std::size_t s = 0; s < m_.free_shafts; ++s)
      if (moves(static_cast<int>(s))) members_[at(root(static_cast<int>(s)))].push_back(static_cast<int>(s));
    for (const ConstraintRow& row : ties_.rows())
      for (const ShaftGain& g : row.motion)
        if (g.gain != 0 && moves(g.shaft)) {
          rows_[at(root(g.shaft))].push_back(&row);
          break;
        }
  }
  void add(const std::vector<int>& shafts) {
    const std::vector<const ConstraintRow*>& rows = rows_[at(root(shafts.front()))];
    if (rows.empty()) return add_column(shafts, Eigen::VectorXd::Ones(1));
    const auto n = static_cast<Index>(shafts.size());
    MatrixXd g = MatrixXd::Zero(static_cast<Index>(rows.size()), n);
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (const ShaftGain& entry : rows[r]->motion) {
        const auto place = std::find(shafts.begin(), shafts.end(), entry.shaft);
        if (place != shafts.end()) g(static_cast<Index>(r), place - shafts.begin()) += entry.gain;
      }
    const Svd svd = full_v_svd(g);
    Index rank = 0;
    while (rank < svd.values.size() && svd.values[rank] > says_nothing_new * svd.values[0]) ++rank;
    if (rank == n) return;  // tied to the frame
    const MatrixXd basis = svd.v.rightCols(n - rank);
    Eigen::VectorXd inertia(n);
    for (Index i = 0; i < n; ++i) inertia[i] = inertia_[shafts[at(static_cast<int>(i))]];
    const Cholesky mass = cholesky(transposed_product(basis, inertia.asDiagonal() * basis));
    const MatrixXd motion = solve_lower(mass.lower, basis.transpose()).transpose();
    for (Index k = 0; k < motion.cols(); ++k) add_column(shafts, motion.col(k));
  }
  void add_column(const std::vector<int>& shafts, Eigen::VectorXd motion) {
    Index leader = 0;
    double most = -1;
    for (Index i = 0; i < motion.size(); ++i) {
      const double energy = inertia_[shafts[static_cast<std::size_t>(i)]] * motion[i] * motion[i];
      if (energy > most) most = energy, leader = i;
    }
    motion /= motion[leader];
    const auto column = static_cast<int>(out_.shaft.size());
    for (Index i = 0; i < motion.size(); ++i)
      if (motion[i] != 0) entries_.emplace_back(shafts[static_cast<std::size_t>(i)], column, motion[i]);
    out_.shaft.push_back(shafts[static_cast<std::size_t>(leader)]);
  }

  const Model& m_;
  const Ties& ties_;
  const Eigen::VectorXd& inertia_;
  std::vector<int> group_;
  std::vector<std::vector<int>> members_;
  std::vector<std::vector<const ConstraintRow*>> rows_;
  std::vector<Eigen::Triplet<double>> entries_;
  Coordinates out_;
};

// Rows of at most two coordinates: connected parts turn by their gear ratios.
class Traversal {
 public:
  explicit Traversal(const SparseMatrix& twists)
      : by_row_(twists), by_column_(twists), value_(at(twists.cols()), 0.0), part_(at(twists.cols()), -1) {}

  MatrixXd motions() {
    const Index n = by_column_.cols();
    int parts = 0;
    std::vector<int> kept;
    for (Index i = 0; i < n; ++i) {
      if (part_[at(i)] >= 0) continue;
      if (is_free(i, parts)) kept.push_back(parts);
      ++parts;
    }
    MatrixXd motions = MatrixXd::Zero(n, static_cast<Index>(kept.size()));
    for (Index i = 0; i < n; ++i) {
      const auto k = std::lower_bound(kept.begin(), kept.end(), part_[at(i)]);
      if (k != kept.end() && *k == part_[at(i)]) motions(i, k - kept.begin()) = value_[at(i)];
    }
    for (Index k = 0; k < motions.cols(); ++k) {
      Index largest = 0;
      motions.col(k).cwiseAbs().maxCoeff(&largest);
      motions.col(k) /= motions(largest, k);
    }
    return motions;
  }

 private:
  using ByRow = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  // Outwards from one coordinate; false if the part is held.
  bool is_free(Index first, int part) {
    bool free = true;
    std::vector<Index> queue = {first};
    part_[at(first)] = part;
    value_[at(first)] = 1;
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (SparseMatrix::InnerIterator j(by_column_, queue[next]); j; ++j) {
        if (j.value() == 0) continue;
        Index other = -1;
        double gain = 0;
        for (ByRow::InnerIterator k(by_row_, j.row()); k; ++k)
          if (k.col() != queue[next] && k.value() != 0) other = k.col(), gain = k.value();
        if (other < 0) {
          free = false;
        } else if (const double value = -j.value() * value_[at(queue[next])] / gain; part_[at(other)] < 0) {
          part_[at(other)] = part;
          value_[at(other)] = value;
          queue.push_back(other);
        } else if (std::abs(value - value_[at(other)]) > closes * std::abs(value)) {
          free = false;  // springs preload each other in a closed loop
        }
      }
    return free;
  }

  ByRow by_row_;
  SparseMatrix by_column_;
  std::vector<double> value_;
  std::vector<int> part_;
};

}  // namespace

MatrixXd motions_without_twist(const SparseMatrix& twists) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> rows(twists);
  bool pairs = true;
  for (Index r = 0; r < rows.outerSize(); ++r) {
    int entries = 0;
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(rows, r); it; ++it) entries += it.value() != 0;
    pairs = pairs && entries <= 2;
  }
  if (pairs) return Traversal(twists).motions();
  MatrixXd kernel = FullLu(MatrixXd(twists)).kernel();
  for (Index k = 0; k < kernel.cols(); ++k) {
    Index largest = 0;
    kernel.col(k).cwiseAbs().maxCoeff(&largest);
    kernel.col(k) /= kernel(largest, k);
  }
  return kernel;
}

Coordinates coordinates_of(const Model& model, const Ties& ties, const Eigen::VectorXd& inertia) {
  return Maker(model, ties, inertia).coordinates();
}

Eigen::VectorXd Coordinates::rates(std::span<const double> speed, const Eigen::VectorXd& inertia) const {
  const Eigen::Map<const Eigen::VectorXd> omega(speed.data(), static_cast<Index>(speed.size()));
  Eigen::VectorXd q(size());
  for (Index k = 0; k < size(); ++k) {
    double momentum = 0, mass = 0;
    for (SparseMatrix::InnerIterator it(motion, k); it; ++it) {
      const double part = it.value() * inertia[it.row()];
      momentum += part * omega[it.row()];
      mass += part * it.value();
    }
    q[k] = mass > 0 ? momentum / mass : omega[shaft[static_cast<std::size_t>(k)]];
  }
  return q;
}

}  // namespace kurbel
