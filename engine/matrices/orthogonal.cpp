// orthogonal.cpp — QR, least squares, singular values.
#include <Eigen/QR>
#include <Eigen/SVD>

#include "engine/matrices/linear_algebra.h"

namespace kurbel {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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

// --- singular values ---

Svd thin_svd(const MatrixXd& a) {
  const Eigen::JacobiSVD<MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.matrixU(), svd.matrixV(), svd.singularValues()};
}
Svd full_v_svd(const MatrixXd& a) {
  const Eigen::JacobiSVD<MatrixXd> svd(a, Eigen::ComputeFullV);
  return {{}, svd.matrixV(), svd.singularValues()};
}

}  // namespace kurbel
