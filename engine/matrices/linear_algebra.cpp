// linear_algebra.cpp — Eigen's algorithms, instantiated here and nowhere else.
#include "engine/matrices/linear_algebra.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <stdexcept>

namespace kurbel {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

MatrixXd product(const MatrixView& a, const MatrixView& b) { return a * b; }
MatrixXd transposed_product(const MatrixView& a, const MatrixView& b) { return a.transpose() * b; }
MatrixXd product_transposed(const MatrixView& a, const MatrixView& b) { return a * b.transpose(); }
MatrixXcd complex_product(const ComplexMatrixView& a, const ComplexMatrixView& b) { return a * b; }
MatrixXcd complex_product_adjoint(const ComplexMatrixView& a, const ComplexMatrixView& b) { return a * b.adjoint(); }
VectorXcd complex_image(const MatrixXd& a, const VectorXcd& b) { return a * b; }
SparseMatrix product(const SparseMatrix& a, const SparseMatrix& b) { return a * b; }

// --- LU ---

template <class Scalar>
struct LuOf<Scalar>::Factors {
  Eigen::PartialPivLU<Matrix> lu;
};
template <class Scalar>
LuOf<Scalar>::LuOf(const Matrix& a) : factors_(new Factors{Eigen::PartialPivLU<Matrix>(a)}) {}
template <class Scalar>
typename LuOf<Scalar>::Vector LuOf<Scalar>::solve(const Vector& right) const {
  return factors_->lu.solve(right);
}
template <class Scalar>
typename LuOf<Scalar>::Vector LuOf<Scalar>::solve_transposed(const Vector& right) const {
  return factors_->lu.transpose().solve(right);
}
template <class Scalar>
typename LuOf<Scalar>::Matrix LuOf<Scalar>::solve_all(const Matrix& right) const {
  return factors_->lu.solve(right);
}
template <class Scalar>
typename LuOf<Scalar>::Matrix LuOf<Scalar>::inverse() const {
  return factors_->lu.inverse();
}
template class LuOf<double>;
template class LuOf<std::complex<double>>;

struct FullLu::Factors {
  Eigen::FullPivLU<MatrixXd> lu;
};
FullLu::FullLu(const MatrixXd& a, double threshold) {
  auto factors = std::make_shared<Factors>(Factors{Eigen::FullPivLU<MatrixXd>(a)});
  if (threshold > 0) factors->lu.setThreshold(threshold);
  factors_ = std::move(factors);
}
Index FullLu::rank() const { return factors_->lu.rank(); }
bool FullLu::invertible() const { return factors_->lu.isInvertible(); }
MatrixXd FullLu::kernel() const {
  if (factors_->lu.dimensionOfKernel() == 0) return MatrixXd(factors_->lu.cols(), 0);
  return factors_->lu.kernel();
}
MatrixXd FullLu::solve(const MatrixXd& right) const { return factors_->lu.solve(right); }
MatrixXd FullLu::inverse() const { return factors_->lu.inverse(); }

// --- least squares ---

VectorXd shortest_solution(const MatrixXd& a, const VectorXd& right) {
  return Eigen::CompleteOrthogonalDecomposition<MatrixXd>(a).solve(right);
}
VectorXd least_squares(const MatrixXd& a, const VectorXd& right) {
  return Eigen::ColPivHouseholderQR<MatrixXd>(a).solve(right);
}
Index rank_by_columns(const MatrixXd& a) { return Eigen::ColPivHouseholderQR<MatrixXd>(a).rank(); }
// By the real matrix [Re A, −Im A; Im A, Re A], whose pseudo-inverse is made of that of A in the same way.
MatrixXcd pseudo_inverse(const MatrixXcd& a) {
  const Index m = a.rows(), n = a.cols();
  MatrixXd real(2 * m, 2 * n);
  real << a.real(), -a.imag(), a.imag(), a.real();
  const MatrixXd inverse = Eigen::CompleteOrthogonalDecomposition<MatrixXd>(real).pseudoInverse();
  MatrixXcd result(n, m);
  result.real() = inverse.topLeftCorner(n, m);
  result.imag() = inverse.bottomLeftCorner(n, m);
  return result;
}

// --- QR ---

MatrixXd full_basis(const MatrixXd& a) { return Eigen::HouseholderQR<MatrixXd>(a).householderQ(); }
MatrixXd orthonormalised(const MatrixXd& a) {
  return Eigen::HouseholderQR<MatrixXd>(a).householderQ() * MatrixXd::Identity(a.rows(), a.cols());
}
PivotedQr pivoted_qr(const MatrixXd& a) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(a);
  return {qr.householderQ() * MatrixXd::Identity(a.rows(), a.cols()), qr.matrixR().diagonal()};
}
Qr qr(const MatrixXd& a) {
  const Eigen::HouseholderQR<MatrixXd> qr(a);
  return {qr.householderQ(), qr.matrixQR().triangularView<Eigen::Upper>()};
}

// --- Cholesky ---

VectorXd Cholesky::solve(const VectorXd& right) const {
  VectorXd x = lower.triangularView<Eigen::Lower>().solve(right);
  lower.triangularView<Eigen::Lower>().transpose().solveInPlace(x);
  return x;
}
Cholesky cholesky(const MatrixXd& a) {
  const Eigen::LLT<MatrixXd> factors(a);
  if (factors.info() != Eigen::Success) return {};
  return {factors.matrixL(), factors.rcond()};
}
MatrixXd solve_lower(const MatrixXd& lower, const MatrixXd& right) {
  return lower.triangularView<Eigen::Lower>().solve(right);
}

// --- singular values, eigenvalues ---

Svd thin_svd(const MatrixXd& a) {
  const Eigen::JacobiSVD<MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.matrixU(), svd.matrixV(), svd.singularValues()};
}
Svd full_v_svd(const MatrixXd& a) {
  const Eigen::JacobiSVD<MatrixXd> svd(a, Eigen::ComputeFullV);
  return {{}, svd.matrixV(), svd.singularValues()};
}

namespace {

Eigen::SelfAdjointEigenSolver<MatrixXd> solved_symmetric(const MatrixXd& a, int options) {
  Eigen::SelfAdjointEigenSolver<MatrixXd> solver(a, options);
  if (solver.info() != Eigen::Success) throw std::runtime_error("the dense eigenvalue solver did not converge");
  return solver;
}

Eigen::EigenSolver<MatrixXd> solved(const MatrixXd& a, bool with_vectors) {
  if (!a.allFinite())  // the solver may not notice, and hand out what looks like a result
    throw std::runtime_error(
        fmt::format("the eigenvalues of a matrix of {} rows were asked for that holds no numbers", a.rows()));
  const Eigen::EigenSolver<MatrixXd> solver(a, with_vectors);
  if (solver.info() != Eigen::Success)
    throw std::runtime_error(
        fmt::format("the eigenvalues of a matrix of {} rows were not found: the iteration did not converge", a.rows()));
  return solver;
}

}  // namespace

SymmetricEigen symmetric_eigen(const MatrixXd& a) {
  const auto solver = solved_symmetric(a, Eigen::ComputeEigenvectors);
  return {solver.eigenvalues(), solver.eigenvectors()};
}
VectorXd symmetric_eigenvalues(const MatrixXd& a) { return solved_symmetric(a, Eigen::EigenvaluesOnly).eigenvalues(); }

Eigenpairs eigenpairs(const MatrixXd& a) {
  if (a.rows() == 0) return {};
  const auto solver = solved(a, true);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

VectorXcd eigenvalues(const MatrixXd& a) {
  if (a.rows() == 0) return {};
  return solved(a, false).eigenvalues();
}

// --- sparse ---

template <class Scalar>
struct SparseLuOf<Scalar>::Factors {
  Eigen::SparseLU<Eigen::SparseMatrix<Scalar>> lu;
  bool analysed = false;
};
template <class Scalar>
SparseLuOf<Scalar>::SparseLuOf() : factors_(std::make_shared<Factors>()) {}
template <class Scalar>
bool SparseLuOf<Scalar>::factorise(const Eigen::SparseMatrix<Scalar>& a) {
  if (!factors_->analysed) factors_->lu.analyzePattern(a);
  factors_->analysed = true;
  factors_->lu.factorize(a);
  return factors_->lu.info() == Eigen::Success;
}
template <class Scalar>
typename SparseLuOf<Scalar>::Vector SparseLuOf<Scalar>::solve(const Vector& right) const {
  return factors_->lu.solve(right);
}
template class SparseLuOf<double>;
template class SparseLuOf<std::complex<double>>;

struct SparseLdlt::Factors {
  Eigen::SimplicialLDLT<SparseMatrix> ldlt;
  bool analysed = false;
};
SparseLdlt::SparseLdlt() : factors_(std::make_shared<Factors>()) {}
bool SparseLdlt::factorise(const SparseMatrix& a) {
  if (!factors_->analysed) factors_->ldlt.analyzePattern(a);
  factors_->analysed = true;
  factors_->ldlt.factorize(a);
  return factors_->ldlt.info() == Eigen::Success;
}
VectorXd SparseLdlt::pivots() const { return factors_->ldlt.vectorD(); }
MatrixXd SparseLdlt::solve(const MatrixXd& right) const { return factors_->ldlt.solve(right); }

}  // namespace kurbel
