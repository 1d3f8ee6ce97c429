// eigen_solutions.h — linear equations and eigenvalues by Eigen, compiled once: each of its decompositions takes a source
// that instantiates it ten seconds and more.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace kurbel::test {

// a V = V diag(λ); the vectors are columns.
struct EigenSolution {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
EigenSolution eigen_solution(const Eigen::MatrixXd& a);
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
std::vector<std::complex<double>> eigenvalues_of(const LongMatrix& a);
// K V = M V diag(λ) for symmetric K and positive definite M; λ ascending, Vᵀ M V = 1.
struct PairSolution {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
PairSolution solution_of_pair(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);
Eigen::VectorXd solved(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::VectorXcd solved_complex(const Eigen::MatrixXcd& a, const Eigen::VectorXcd& b);
// x of the least |a x − b|.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace kurbel::test
