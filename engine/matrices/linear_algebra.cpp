// linear_algebra.cpp — products, LU, Cholesky. Each source of this folder instantiates some of Eigen's algorithms, and
// nobody else does: together they would take a third longer to compile.
#include "engine/matrices/linear_algebra.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

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
bool FullLu::invertible() const { return factors_->lu.isInvertible(); }
MatrixXd FullLu::kernel() const {
  if (factors_->lu.dimensionOfKernel() == 0) return MatrixXd(factors_->lu.cols(), 0);
  return factors_->lu.kernel();
}
MatrixXd FullLu::solve(const MatrixXd& right) const { return factors_->lu.solve(right); }
MatrixXd FullLu::inverse() const { return factors_->lu.inverse(); }

// --- Cholesky ---

Cholesky cholesky(const MatrixXd& a) {
  const Eigen::LLT<MatrixXd> factors(a);
  if (factors.info() != Eigen::Success) return {};
  return {factors.matrixL()};
}
MatrixXd solve_lower(const MatrixXd& lower, const MatrixXd& right) {
  return lower.triangularView<Eigen::Lower>().solve(right);
}

}  // namespace kurbel
