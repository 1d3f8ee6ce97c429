// linear_algebra.h — products, factorisations and eigenvalues of matrices, compiled once.
//
// Eigen's algorithms are templates that take seconds to compile in every source. Sources with this header compile only
// Eigen's types; no other source includes Eigen's algorithms (a test checks the includes).
// Matrices are dense and of run-time size unless the name contains sparse; blocks and columns are passed without a copy.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>
#include <memory>

namespace kurbel {

using SparseMatrix = Eigen::SparseMatrix<double>;
using ComplexSparseMatrix = Eigen::SparseMatrix<std::complex<double>>;
using MatrixView = Eigen::Ref<const Eigen::MatrixXd>;
using ComplexMatrixView = Eigen::Ref<const Eigen::MatrixXcd>;

// A B, Aᵀ B, A Bᵀ.
Eigen::MatrixXd product(const MatrixView& a, const MatrixView& b);
Eigen::MatrixXd transposed_product(const MatrixView& a, const MatrixView& b);
Eigen::MatrixXd product_transposed(const MatrixView& a, const MatrixView& b);
Eigen::MatrixXcd complex_product(const ComplexMatrixView& a, const ComplexMatrixView& b);
Eigen::MatrixXcd complex_product_adjoint(const ComplexMatrixView& a, const ComplexMatrixView& b);  // A Bᴴ
Eigen::VectorXcd complex_image(const Eigen::MatrixXd& a, const Eigen::VectorXcd& b);
SparseMatrix product(const SparseMatrix& a, const SparseMatrix& b);

// LU with partial pivoting of a square matrix. A singular matrix gives infinities and NaN.
template <class Scalar>
class LuOf {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  LuOf() = default;
  explicit LuOf(const Matrix& a);
  Vector solve(const Vector& right) const;
  Matrix solve_all(const Matrix& right) const;
  Matrix inverse() const;

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;
};
using Lu = LuOf<double>;
using ComplexLu = LuOf<std::complex<double>>;

// LU by full pivots. Pivots up to `threshold` of the largest count as zero; 0: as rounding makes them.
class FullLu {
 public:
  explicit FullLu(const Eigen::MatrixXd& a, double threshold = 0);
  bool invertible() const;
  Eigen::MatrixXd kernel() const;  // columns; empty: the matrix has full column rank
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  Eigen::MatrixXd inverse() const;

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;
};

// Least squares: by complete orthogonal decomposition (the shortest of all solutions), and by QR with column pivoting.
Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& right);
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& right);
Eigen::Index rank_by_columns(const Eigen::MatrixXd& a);
Eigen::MatrixXcd pseudo_inverse(const Eigen::MatrixXcd& a);

// A = Q R by Householder reflections.
Eigen::MatrixXd full_basis(const Eigen::MatrixXd& a);       // Q, square
Eigen::MatrixXd orthonormalised(const Eigen::MatrixXd& a);  // Q's first columns, as many as A has
struct PivotedQr {
  Eigen::MatrixXd q;         // as many columns as A
  Eigen::VectorXd diagonal;  // of R, magnitudes descending
};
PivotedQr pivoted_qr(const Eigen::MatrixXd& a);
struct Qr {
  Eigen::MatrixXd q, r;  // both square
};
Qr qr(const Eigen::MatrixXd& a);

// A = L Lᵀ; empty where A is not positive definite.
struct Cholesky {
  Eigen::MatrixXd lower;
};
Cholesky cholesky(const Eigen::MatrixXd& a);
Eigen::MatrixXd solve_lower(const Eigen::MatrixXd& lower, const Eigen::MatrixXd& right);  // L⁻¹ B

// A = U diag(values) Vᵀ by Jacobi rotations, values descending.
struct Svd {
  Eigen::MatrixXd u, v;
  Eigen::VectorXd values;
};
Svd thin_svd(const Eigen::MatrixXd& a);
Svd full_v_svd(const Eigen::MatrixXd& a);  // V square, no U

// A = X diag(values) Xᵀ of a symmetric matrix, values ascending. Throws std::runtime_error without convergence.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& a);
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a);

// A v = λ v of a dense real matrix (QR algorithm; Golub, Van Loan 2013, 7.5). Throws std::runtime_error if an entry is not
// finite or the iteration does not converge.
struct Eigenpairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;  // columns, of length one
};
Eigenpairs eigenpairs(const Eigen::MatrixXd& a);
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a);

// LU of sparse square matrices. The first factorise() analyses the pattern, which must be the same for later matrices.
template <class Scalar>
class SparseLuOf {
 public:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  SparseLuOf();
  bool factorise(const Eigen::SparseMatrix<Scalar>& a);  // false: singular
  Vector solve(const Vector& right) const;

 private:
  struct Factors;
  std::shared_ptr<Factors> factors_;
};
using SparseLu = SparseLuOf<double>;
using ComplexSparseLu = SparseLuOf<std::complex<double>>;

// L D Lᵀ of sparse symmetric matrices, with the same rule.
class SparseLdlt {
 public:
  SparseLdlt();
  bool factorise(const SparseMatrix& a);  // false: a pivot is zero
  Eigen::VectorXd pivots() const;         // D
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

 private:
  struct Factors;
  std::shared_ptr<Factors> factors_;
};

}  // namespace kurbel
