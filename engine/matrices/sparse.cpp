// sparse.cpp — LU and L D Lᵀ of sparse matrices.
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

#include "engine/matrices/linear_algebra.h"

namespace kurbel {

using Eigen::MatrixXd;
using Eigen::VectorXd;

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
