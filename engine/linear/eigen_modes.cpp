// eigen_modes.cpp — undamped: dense for small drives; for large ones a block Krylov space of (K + s M)⁻¹ M, checked by counting.
#include "engine/linear/eigen_modes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include "engine/matrices/linear_algebra.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Eigen::VectorXi;

constexpr int block = 4;                 // vectors a step of the Krylov space
constexpr double converged = 1e-10;      // residual of (A + s)⁻¹ x = θ x over θ
constexpr double good_enough = 1e-10;    // backward error that is handed out at all
constexpr double rounding = 1e-15;       // of a frequency by its energies
constexpr double shift_of_free = 1e-12;  // s over the largest eigenvalue, where rigid motions make K singular

// A = M^(−½) K M^(−½)
SparseMatrix scaled_stiffness(const LinearDrive& drive) {
  const VectorXd scale = drive.inertia.cwiseSqrt().cwiseInverse();
  SparseMatrix a = scale.asDiagonal() * drive.stiffness * scale.asDiagonal();
  a.makeCompressed();
  return a;
}

// Upper bound of all eigenvalues (Gershgorin).
double largest_row_sum(const SparseMatrix& a) {
  double largest = 0;
  for (Index c = 0; c < a.outerSize(); ++c) {
    double sum = 0;
    for (SparseMatrix::InnerIterator it(a, c); it; ++it) sum += std::abs(it.value());
    largest = std::max(largest, sum);
  }
  return largest;
}

SparseMatrix shifted(const SparseMatrix& a, double shift) {
  SparseMatrix identity(a.rows(), a.cols());
  identity.setIdentity();
  return a + shift * identity;
}

// Negative pivots of A − σ.
int count_below(const SparseMatrix& a, double sigma) {
  SparseLdlt ldlt;
  for (int attempt = 0; attempt < 8; ++attempt) {  // a pivot of exactly zero: σ is a little moved
    if (!ldlt.factorise(shifted(a, -sigma * (1 + attempt * 1e-13)))) continue;
    const VectorXd pivots = ldlt.pivots();
    if (pivots.allFinite()) return static_cast<int>((pivots.array() < 0).count());
  }
  throw std::runtime_error("the modes below a frequency could not be counted: the stiffness matrix has no finite LDLᵀ");
}

// Motions without twist, orthonormal in √J q.
MatrixXd rigid_motions(const LinearDrive& drive) {
  std::vector<Eigen::Triplet<double>> entries;
  int row = 0;
  for (std::size_t j = 0; j < drive.joints.size(); ++j) {
    if (drive.joints[j].stiffness == 0) continue;
    for (SparseRows::InnerIterator it(drive.twists, static_cast<Index>(j)); it; ++it)
      entries.emplace_back(row, static_cast<int>(it.col()), it.value());
    ++row;
  }
  SparseMatrix springs(row, drive.size());
  springs.setFromTriplets(entries.begin(), entries.end());
  MatrixXd motions = drive.inertia.cwiseSqrt().asDiagonal() * motions_without_twist(springs);
  motions.colwise().normalize();
  bool apart = true;  // parts of the drive that do not touch
  for (Index i = 0; apart && i < motions.rows(); ++i) apart = (motions.row(i).array() != 0).count() <= 1;
  if (apart) return motions;
  return orthonormalised(motions);
}

// ω² = Σ k θ²/Σ J q²: the energies know low frequencies beside stiff springs to more digits than the matrix does.
double frequency(const LinearDrive& drive, const VectorXd& q) {
  const double potential = drive.spring_work(drive.twists * q).sum();
  return std::sqrt(std::max(0.0, potential) / drive.inertia.dot(q.cwiseAbs2()));
}

// Of ω = √(ω²), behind `rigid` ones that are exact: ω² lies within the residual, or within its square over the gap.
VectorXd errors(const VectorXd& omega, const VectorXd& residual, Index rigid) {
  VectorXd error = VectorXd::Zero(omega.size());
  for (Index i = rigid; i < omega.size(); ++i) {
    const double square = omega[i] * omega[i], r = residual[i - rigid];
    double gap = i > 0 ? square - std::pow(omega[i - 1], 2) : square;
    if (i + 1 < omega.size()) gap = std::min(gap, std::pow(omega[i + 1], 2) - square);
    const double of_square = gap > r ? std::min(r, r * r / gap) : r;
    error[i] = omega[i] > 0 ? of_square / (2 * omega[i]) + rounding * omega[i] : std::sqrt(r);
  }
  return error;
}

// From orthonormal vectors of A to modes of K, M, sorted; rigid motions first.
UndampedModes collect(const LinearDrive& drive, const SparseMatrix& a, const MatrixXd& rigid, const MatrixXd& found) {
  const VectorXd scale = drive.inertia.cwiseSqrt().cwiseInverse();
  const Index r = rigid.cols(), m = found.cols();
  VectorXd omega(m);
  for (Index i = 0; i < m; ++i) omega[i] = frequency(drive, scale.cwiseProduct(found.col(i)));
  std::vector<Index> order(at(m));
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index x, Index y) { return omega[x] < omega[y]; });
  const double norm = largest_row_sum(a);
  UndampedModes modes;
  modes.rigid = static_cast<int>(r);
  modes.omega = VectorXd::Zero(r + m);
  modes.shapes.resize(drive.size(), r + m);
  for (Index i = 0; i < r; ++i) modes.shapes.col(i) = scale.cwiseProduct(rigid.col(i));
  VectorXd residual(m);
  for (Index i = 0; i < m; ++i) {
    const VectorXd x = found.col(order[at(i)]);
    const double w = omega[order[at(i)]];
    modes.omega[r + i] = w;
    modes.shapes.col(r + i) = scale.cwiseProduct(x);
    residual[i] = (a * x - w * w * x).norm() / x.norm();
    modes.residual = std::max(modes.residual, residual[i] / norm);
  }
  modes.error = errors(modes.omega, residual, r);
  modes.complete = r + m == drive.size();
  return modes;
}

UndampedModes dense_modes(const LinearDrive& drive, const SparseMatrix& a, const MatrixXd& rigid) {
  // Rigid motions are known exactly; the rest is found in the space across them.
  const Index n = a.rows(), r = rigid.cols();
  MatrixXd across = MatrixXd::Identity(n, n);
  if (r > 0) across = full_basis(rigid).rightCols(n - r);
  if (n == r) return collect(drive, a, rigid, MatrixXd(n, 0));
  return collect(drive, a, rigid, product(across, symmetric_eigen(transposed_product(across, a * across)).vectors));
}

// Block Krylov space of (A + s)⁻¹ with full orthogonalisation, Rayleigh–Ritz on it; random vectors are added where the
// count says that a mode of a multiple frequency is missing.
class KrylovSearch {
 public:
  KrylovSearch(const LinearDrive& drive, const SparseMatrix& a, MatrixXd rigid)
      : drive_(drive), a_(a), rigid_(std::move(rigid)), n_(a.rows()), v_(n_, 0), image_(n_, 0) {
    const double shift = rigid_.cols() > 0 ? shift_of_free * largest_row_sum(a) : 0;
    if (!solver_.factorise(shifted(a, shift)))
      throw std::runtime_error("the stiffness matrix of the drive could not be factorised");
  }

  UndampedModes lowest(int wanted) {
    const Index most = n_ - rigid_.cols();
    const Index count = std::min<Index>(wanted, most);
    MatrixXd next = random_block(std::min<Index>(block, most));
    for (;;) {
      Deadline::check();
      extend(next);
      const bool full = basis_ >= most;
      if (full || basis_ >= 2 * count) {
        ritz();
        if (full || has_converged(count)) {
          const int missing = miss(count);
          if (missing == 0 || full) break;
          next = random_block(std::min<Index>(std::max(missing, block), most - basis_));
          continue;
        }
      }
      next = orthogonal(last_image_);
      if (next.cols() == 0) next = random_block(std::min<Index>(block, most - basis_));
    }
    UndampedModes modes = collect(drive_, a_, rigid_, vectors_.leftCols(std::min(count, vectors_.cols())));
    modes.basis = static_cast<int>(basis_);
    return modes;
  }

 private:
  MatrixXd random_block(Index columns) {
    std::normal_distribution<double> normal;
    return orthogonal(MatrixXd::NullaryExpr(n_, columns, [&]() { return normal(random_); }));
  }

  // What lies along the basis.
  static void take_out(const MatrixView& basis, MatrixXd& x) { x -= product(basis, transposed_product(basis, x)); }

  // Twice is enough (Kahan, Parlett): orthogonal to the rigid motions and to the basis, then within itself.
  MatrixXd orthogonal(MatrixXd x) const {
    x.colwise().normalize();
    for (int pass = 0; pass < 2; ++pass) {
      take_out(rigid_, x);
      take_out(v_.leftCols(basis_), x);
    }
    const PivotedQr qr = pivoted_qr(x);
    Index rank = 0;
    while (rank < x.cols() && std::abs(qr.diagonal[rank]) > 1e-10) ++rank;
    MatrixXd q = qr.q.leftCols(rank);
    take_out(rigid_, q);
    take_out(v_.leftCols(basis_), q);
    q.colwise().normalize();
    return q.leftCols(std::min(rank, n_ - rigid_.cols() - basis_));
  }

  void extend(const MatrixXd& x) {
    const Index m = x.cols();
    if (v_.cols() < basis_ + m) {
      const Index room = std::min(n_, std::max<Index>(2 * v_.cols(), basis_ + m + 64));
      v_.conservativeResize(n_, room);
      image_.conservativeResize(n_, room);
      h_.conservativeResize(room, room);
    }
    v_.middleCols(basis_, m) = x;
    last_image_ = solver_.solve(x);
    take_out(rigid_, last_image_);
    image_.middleCols(basis_, m) = last_image_;
    h_.block(0, basis_, basis_ + m, m) = transposed_product(v_.leftCols(basis_ + m), last_image_);
    h_.block(basis_, 0, m, basis_) = h_.block(0, basis_, basis_, m).transpose();
    basis_ += m;
  }

  void ritz() {
    const MatrixXd h = h_.topLeftCorner(basis_, basis_);
    const SymmetricEigen found = symmetric_eigen(0.5 * (h + h.transpose()));
    theta_ = found.values.reverse();
    weights_ = found.vectors.rowwise().reverse();
  }

  bool has_converged(Index count) {
    const Index m = std::min(count + 1, basis_);  // one more: the count needs to know where the next one lies
    // The slowest one first: most checks end there.
    const auto residual = [&](Index first, Index columns) {
      const MatrixXd w = weights_.middleCols(first, columns);
      const MatrixXd r = product(image_.leftCols(basis_), w) -
                         product(v_.leftCols(basis_), w) * theta_.segment(first, columns).asDiagonal();
      return (r.colwise().norm().transpose().array() / theta_.segment(first, columns).array()).maxCoeff();
    };
    return residual(count - 1, 1) < converged && residual(0, count) < converged &&
           (m == count || residual(count, 1) < 1e-2);
  }

  // Modes that the count finds up to the last wanted one and the search did not; where more of the last frequency may
  // follow, up to just below it.
  int miss(Index count) {
    vectors_ = product(v_.leftCols(basis_), weights_.leftCols(std::min(count + 1, basis_)));
    const auto lambda = [&](Index i) {
      return vectors_.col(i).dot(a_ * vectors_.col(i)) / vectors_.col(i).squaredNorm();
    };
    const double last = lambda(count - 1), next = vectors_.cols() > count ? lambda(count) : 2 * last;
    const double above = next > last * (1 + 1e-6) ? 0.5 * (last + next) : last * (1 - 1e-6);
    Index found = rigid_.cols();
    for (Index i = 0; i < vectors_.cols(); ++i) found += lambda(i) < above;
    return static_cast<int>(std::max<Index>(0, count_below(a_, above) - found));
  }

  const LinearDrive& drive_;
  const SparseMatrix& a_;
  MatrixXd rigid_;
  Index n_ = 0, basis_ = 0;
  SparseLdlt solver_;
  MatrixXd v_, image_, h_, last_image_, weights_, vectors_;
  VectorXd theta_;
  std::mt19937_64 random_{20240607};
};

}  // namespace

UndampedModes undamped_modes(const LinearDrive& drive, const ModesWanted& wanted) {
  if (wanted.count < 1) throw std::invalid_argument("the number of modes wanted must be ≥ 1");
  const SparseMatrix a = scaled_stiffness(drive);
  const MatrixXd rigid = rigid_motions(drive);
  UndampedModes modes;
  if (drive.size() <= wanted.dense_below || 3 * wanted.count > drive.size()) {
    modes = dense_modes(drive, a, rigid);
  } else {
    modes = KrylovSearch(drive, a, rigid).lowest(wanted.count);
  }
  const Index found = modes.omega.size();
  const double last = modes.omega[found - 1];
  modes.counted_below =
      modes.complete || last == 0 ? static_cast<int>(found) : count_below(a, std::pow(last * (1 + 1e-9), 2));
  if (!(modes.residual < good_enough))
    throw std::runtime_error(
        "the modes were not found to a backward error of 1e-10: the springs' stiffnesses lie too far apart");
  return modes;
}

EnergyShares energy_shares(const LinearDrive& drive, const VectorXd& shape) {
  const auto shares = [](const VectorXd& energy) {
    const double sum = energy.sum();
    std::vector<double> share(energy.begin(), energy.end());
    for (double& s : share) s = sum > 0 ? s / sum : 0;
    return share;
  };
  return {shares(drive.spring_work(drive.twists * shape)),
          shares(drive.shaft_inertia.cwiseProduct((drive.motion * shape).cwiseAbs2()))};
}

}  // namespace kurbel
