// eigen_solutions.h — linear equations and eigenvalues by Eigen, compiled once: each of its decompositions takes a source
// that instantiates it ten seconds and more.
#pragma once

#include <Eigen/Core>

namespace kurbel::test {

// a V = V diag(λ); the vectors are columns.
struct EigenSolution {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
EigenSolution eigen_solution(const Eigen::MatrixXd& a);
// λ of K x = λ M x for symmetric K and positive definite M, ascending.
Eigen::VectorXd eigenvalues_of_pair(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m);
Eigen::VectorXd solved(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::VectorXcd solved_complex(const Eigen::MatrixXcd& a, const Eigen::VectorXcd& b);

}  // namespace kurbel::test
