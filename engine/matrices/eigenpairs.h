// eigenpairs.h — eigenvalues and eigenvectors of a full real matrix: A v = λ v.
//
// In one place, as the solver is a costly template to compile, and as nobody may take what did not converge for a result.
#pragma once

#include <Eigen/Core>

namespace kurbel {

struct Eigenpairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;  // columns, of length one
};
// Throws std::runtime_error where an entry is no number, or the iteration does not converge (QR algorithm; Golub, Van Loan
// 2013, 7.5).
Eigenpairs eigenpairs(const Eigen::MatrixXd& a);
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a);

}  // namespace kurbel
